#pragma once
// Ward's irradiance cache: records (irradiance_record.h), and interpolation between them.
//
// Weights: record i with the error e_i < alpha has the weight 1 - e_i / alpha, which falls to 0 where the record ceases
// to be used, so that it leaves no visible rim.
//
// Two records that are near each other correct one another when the later one is inserted:
// - Neighbour clamping. What is near one of them is near the other: their radii differ by no more than their distance
//   (Krivanek et al. 2006, "Making Radiance and Irradiance Caching Practical").
// - Each is compared with what the other extrapolates to its place. A difference beyond their noise shortens S_i.

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/base/color.h"
#include "render/cache/irradiance_record.h"
#include "render/cache/record_index.h"
#include "render/cache/record_lists.h"

namespace aleph {

struct RayTask;

/// The records that look-ups used, added up.
struct RecordUse {
    float count = 0.0f;
    float weights = 0.0f;
    float reaches = 0.0f;  ///< m, by weight: how far they may be used at the query's accuracy (RecordReach)

    void add(const RecordUse& other) {
        count += other.count;
        weights += other.weights;
        reaches += other.reaches;
    }
};

/// A record as those around it let expect it.
struct ExpectedRecord {
    float irradiance = 0.0f;    ///< luminance
    float ray_variance = 0.0f;  ///< of a single gather ray, relative
    float radius = 0.0f;        ///< m
};

/// A place where irradiance is needed.
struct CacheQuery {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit
    float accuracy = 0.0f;   ///< alpha of this pixel; values above 1 count as 1
    /// Casts a ray to a record where something may stand in between; null: such records are not used.
    RayTask* task = nullptr;
    glm::vec3 ray_shift{0.0f};  ///< m, from the records' coordinates to those of `task`
    RecordUse* used = nullptr;  ///< `interpolate` adds the records that it uses; may be null
};

/// Look-ups may run in parallel while nothing is inserted.
class IrradianceCache {
  public:
    /// @param low, high  m, of a box; records outside of it are found too, but more slowly
    IrradianceCache(const glm::vec3& low, const glm::vec3& high) : index_(low, high) {}

    /// Adds a record, and corrects it and its neighbours by each other.
    void insert(IrradianceRecord record);

    /// True if at least one record has an error below the query's accuracy, and was computed for about that accuracy.
    bool covers(const CacheQuery& query) const;

    /// Calls visit(number, weight) for all records whose error is below the query's accuracy.
    template <class Visit>
    void visit_usable(const CacheQuery& query, const Visit& visit) const {
        const float accuracy = std::min(query.accuracy, 1.0f);
        const auto take = [&](int i, float error) {
            if (const float weight = weigh(records_[i], query, error, accuracy); weight > 0.0f) visit(i, weight);
        };
        for (const RecordLists& lists : lists_) {
            if (accuracy <= lists.accuracy()) return lists.visit(query.position, query.normal, accuracy, take);
        }
        index_.visit_reaching(query.position, accuracy, [&](int i) {
            take(i, interpolation_error(records_[i], query.position, query.normal));
            return true;
        });
    }

    /// The weighted mean of all records whose error is below the query's accuracy, or nothing if there is none.
    std::optional<Rgb> interpolate(const CacheQuery& query) const;

    /// The radius, at most `max_radius`, that neighbour clamping would leave a record here.
    float radius_bound(const glm::vec3& position, const glm::vec3& normal, float max_radius) const;

    /// Means of the records around, or of all where none is near; the radius is that of neighbour clamping. Nothing
    /// while there are no records.
    std::optional<ExpectedRecord> expect(const CacheQuery& query, float max_radius) const;

    /// Replaces each record's value and gradients by the mean of what it and the records around it extrapolate to its
    /// place, of those that differ by no more than noise: less noise without more rays. Rare light of records is shared
    /// out among those around that face about the same way, by what each of them has, so that it is no blotch and the
    /// dark stays dark. Nothing is inserted afterwards.
    /// @param kept       so many of the first records stay as they are
    /// @param leave_out  whether records that stand out are left out: samples then find the light of their places
    void finish(std::size_t kept = 0, bool leave_out = false);

    /// Replaces all records by those of another cache after finish(), as they are.
    void restore(std::vector<IrradianceRecord> records);

    /// Makes the look-ups of shading fast, until the records change.
    void prepare();

    const std::vector<IrradianceRecord>& records() const { return records_; }

  private:
    static float weigh(const IrradianceRecord& record, const CacheQuery& query, float error, float accuracy);
    void clamp_to_neighbours(IrradianceRecord& record);
    void compare_with_neighbours(IrradianceRecord& record);
    IrradianceRecord smoothed(const IrradianceRecord& record) const;
    /// Calls visit(number, luminance) for the records within `reach`, m, whose normals are within a cosine of this
    /// one's.
    template <class Visit>
    void visit_alike(const IrradianceRecord& record, float reach, float cosine, const Visit& visit) const;
    /// A record's share of another's rare light.
    struct Share {
        int to;
        float share;
    };
    std::vector<Share> find_shares(const std::vector<std::uint8_t>& takes, std::size_t from) const;
    /// Returns whether a record has far more light than those around, and a reach that cannot shrink.
    bool stands_out(int number) const;
    void share_rare_light(std::size_t kept, const std::vector<std::uint8_t>& takes,
                          std::vector<IrradianceRecord>& smooth) const;

    std::vector<IrradianceRecord> records_;
    RecordIndex index_;
    std::vector<RecordLists> lists_;
    float max_accuracy_ = 0.0f;                       ///< of the records
    double ray_variances_ = 0.0, irradiances_ = 0.0;  ///< sums over the records
};

}  // namespace aleph
