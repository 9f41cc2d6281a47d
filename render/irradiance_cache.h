#pragma once
// Ward's irradiance cache. Indirect irradiance changes slowly over diffuse surfaces, so it is computed at few points,
// the records, and interpolated in between (cache_fill.h says where records are placed).
//
// Weights: at a point P with normal N, record i has the weight 1 / e_i, where
//     e_i = |P - P_i| / R_i + sqrt(1 - N.N_i)
// estimates the relative error of using it there. It is used where e_i < alpha, the accuracy of the pixel.
// R_i is the harmonic mean of the distances that the record's gather rays travelled: short next to a wall, long in the
// open. (Ward, Rubinstein and Clear 1988, "A Ray Tracing Solution for Diffuse Interreflection"; Yee 2000,
// eqs. 6.1, 6.2, 6.5 and 6.6.)
//
// Gradients: a record's value is moved to P and N by its translation and rotation gradients before it is averaged, so
// that sparse records leave no visible patches (Ward and Heckbert 1992, "Irradiance Gradients").
//
// Neighbour clamping: R_i is an average over all directions and can miss a small object nearby. The radii of two
// records may therefore differ by no more than their distance: what shortened one radius is near the other record too
// (Krivanek et al. 2006, "Making Radiance and Irradiance Caching Practical").
//
// Clearance (not in these papers): a thin wall shortens R_i too little, and light would leak behind it. A record also
// stores how far the nearest obstacle along its tangent plane is, in sixteen sectors of azimuth, and how high the
// lowest surface over it hangs. It is not used beyond them.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/base/color.h"
#include "render/gather.h"

namespace aleph {

struct IrradianceRecord {
    glm::vec3 position{0.0f};  ///< m, relative to the frame's anchor
    glm::vec3 normal{0.0f};    ///< unit
    Rgb irradiance{0.0f};
    float radius = 0.0f;      ///< R_i, m; positive and finite; neighbour clamping may shrink it later
    float min_radius = 0.0f;  ///< m; neighbour clamping stops here
    std::array<glm::vec3, 3> rotation_gradient{};
    std::array<glm::vec3, 3> translation_gradient{};
    glm::vec3 tangent{0.0f};  ///< of make_basis(normal), for the sectors of `clearance`
    /// m along the tangent plane, by sector_of: the record is not used farther away, whatever its radius.
    Clearance clearance = unlimited_clearance();
    /// m above the tangent plane: the record is not used higher up.
    float headroom = std::numeric_limits<float>::infinity();
};

/// A place where irradiance is needed.
struct CacheQuery {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit
    float accuracy = 0.0f;   ///< alpha of this pixel; values above 1 count as 1
};

/// Bounds for R_i, m.
struct RadiusBounds {
    float min = 0.0f;  ///< from the pixel's footprint
    float max = 0.0f;  ///< from the scene's size
};

/// A record of a gathered value: radius within the bounds, gradients limited so that |gradient| R <= E (near a wall
/// their terms grow without bound). Nothing if the irradiance is not finite: one such record would spoil every pixel
/// that uses it.
std::optional<IrradianceRecord> make_record(const glm::vec3& position, const glm::vec3& normal,
                                            const IrradianceSample& sample, const RadiusBounds& bounds);

/// e_i above. The second term is computed as |N - N_i| / sqrt 2, which is equal but does not cancel for small angles.
/// Infinite where the record must not be used: its normal faces away, it lies in front of the point (Ward's rule
/// against light from over an edge), or the point is beyond its clearance or headroom.
float interpolation_error(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal);

/// A record's irradiance moved to another place by its gradients, within [0, 2 E_i].
Rgb extrapolate(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal);

/// Records with an octree over them. Look-ups may run in parallel while nothing is inserted.
class IrradianceCache {
  public:
    /// @param bounds_low, bounds_high  box of the octree, m; records outside of it are found too, but more slowly
    IrradianceCache(const glm::vec3& bounds_low, const glm::vec3& bounds_high);

    /// Adds a record. Neighbour clamping limits its radius by those of its neighbours, and theirs by its own.
    void insert(IrradianceRecord record);

    /// True if at least one record has an error below the query's accuracy.
    bool covers(const CacheQuery& query) const;

    /// The weighted mean of all records whose error is below the query's accuracy, or nothing if there is none.
    std::optional<Rgb> interpolate(const CacheQuery& query) const;

    /// The radius, at most `max_radius`, that neighbour clamping would leave a record here.
    float radius_bound(const glm::vec3& position, const glm::vec3& normal, float max_radius) const;

    const std::vector<IrradianceRecord>& records() const { return records_; }

  private:
    struct Cell {
        glm::vec3 center{0.0f};
        float half_size = 0.0f;
        std::array<int, 8> children;
        float max_radius = 0.0f;  ///< of all records in it and below; not lowered when clamping shrinks records
        int first_record = -1;    ///< head of a list through next_
    };

    int find_or_add_cell(const glm::vec3& position, float radius);
    void clamp_to_neighbours(IrradianceRecord& record);
    template <class VisitRecord>
    void visit(const glm::vec3& position, float reach_factor, float extra_reach, const VisitRecord& visit_record) const;

    std::vector<IrradianceRecord> records_;
    std::vector<int> next_;
    std::vector<Cell> cells_;
};

}  // namespace aleph
