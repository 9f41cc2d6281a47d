#pragma once
// Ward's irradiance cache: where indirect irradiance was computed, how far each value holds, and what it says nearby.
// Ward, Rubinstein and Clear 1988; gradients: Ward and Heckbert 1992; neighbour clamping: Krivanek et al. 2006.
// Reading of thesis 6.1: MODEL 6.1 and README ("Where we read the thesis differently").

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "engine/base/color.h"
#include "render/gather.h"

namespace aleph {

struct IrradianceRecord {
    glm::vec3 position{0.0f};  ///< m, relative to the frame's anchor
    glm::vec3 normal{0.0f};    ///< unit
    Rgb irradiance{0.0f};
    float radius = 0.0f;           ///< R_i (6.5), m; positive and finite; neighbour clamping may shrink it later
    float smallest_radius = 0.0f;  ///< neighbour clamping stops here
    std::array<glm::vec3, 3> rotation_gradient{};
    std::array<glm::vec3, 3> translation_gradient{};
    glm::vec3 tangent{0.0f};  ///< of make_basis(normal), for the sectors of `clearance`
    /// How far it reaches along its tangent plane by sectors, m: not behind the wall that stands there, however its
    /// radius was set (HARD_CASES IC-08, IC-09).
    std::array<float, 16> clearance = unlimited_clearance();
    /// How far it reaches up from its tangent plane, m: not past what hangs over it.
    float headroom = std::numeric_limits<float>::infinity();
};

/// Where irradiance is asked for.
struct CacheQuery {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit
    float accuracy = 0.0f;   ///< alpha, this pixel's own; above 1 counts as 1
};

/// Bounds for R_i, m.
struct RadiusBounds {
    float smallest = 0.0f;  ///< from the pixel's footprint
    float largest = 0.0f;   ///< from the scene's size
};

/// A record of a gathered value: radius within bounds, gradients limited so that |gradient| R <= E (HARD_CASES IC-07).
IrradianceRecord make_record(const glm::vec3& position, const glm::vec3& normal, const IrradianceSample& sample,
                             const RadiusBounds& bounds);

/// Error term of (6.2), the inverse of the weight: |P - P_i| / R_i + |N - N_i| / sqrt 2. The second is
/// sqrt(1 - N.N_i) without its cancellation (HARD_CASES IC-01, IC-02). Infinite where the record must not be used:
/// its normal faces away (IC-09), it lies in front of the point (IC-08), or something may stand between.
float interpolation_error(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal);

/// What a record says about a place: its value, moved by its gradients, within [0, 2 E_i].
Rgb extrapolate(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal);

class IrradianceCache {
  public:
    /// @param bounds_low, bounds_high  box that holds every record, m; records outside are clamped into it for the
    /// index
    IrradianceCache(const glm::vec3& bounds_low, const glm::vec3& bounds_high);

    /// Adds a record. Its radius is clamped by its neighbours' and theirs by its own.
    void insert(IrradianceRecord record);

    /// True if some record holds at the query (6.6): what filling asks.
    bool covers(const CacheQuery& query) const;

    /// The weighted mean of all records that hold (6.1), or nothing.
    std::optional<Rgb> interpolate(const CacheQuery& query) const;

    /// The largest radius that neighbour clamping would leave a record here, if it asked for `largest`.
    float radius_bound(const glm::vec3& position, const glm::vec3& normal, float largest) const;

    /// Cells and records that a look-up touches: what its time is proportional to.
    std::size_t look_up_cost(const CacheQuery& query) const;

    const std::vector<IrradianceRecord>& records() const { return records_; }

  private:
    struct Cell {
        glm::vec3 center{0.0f};
        float half_size = 0.0f;
        std::array<int, 8> children;
        float largest_radius = 0.0f;  ///< of all records in it and below; never too small
        int first_record = -1;        ///< list through next_
    };

    int find_or_add_cell(const glm::vec3& position, float radius);
    void clamp_to_neighbours(IrradianceRecord& record);
    template <class VisitRecord, class VisitCell>
    void visit(const glm::vec3& position, float reach_factor, float extra_reach, const VisitRecord& visit_record,
               const VisitCell& visit_cell) const;
    template <class VisitRecord>
    void visit(const glm::vec3& position, float reach_factor, float extra_reach, const VisitRecord& visit_record) const;

    std::vector<IrradianceRecord> records_;
    std::vector<int> next_;
    std::vector<Cell> cells_;
};

}  // namespace aleph
