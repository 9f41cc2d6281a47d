#pragma once
// The limit surface as patches, and the weights that make their control points from a cage's points, all in double.
// Internal to limit_surface.cpp and its parts.

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/surface/topology.h"

namespace aleph {

/// A point of the limit surface: face of the parametrisation (OpenSubdiv's ptex faces: a quad or Loop triangle is one,
/// an n-gon is n) and place on it. Where places lie on a grid of a power of two, float holds them exactly.
struct LimitLocation {
    int face = 0;
    float s = 0.0f, t = 0.0f;

    bool operator==(const LimitLocation&) const = default;
};

/// A location whose patch and weights are known.
struct LimitSample {
    int first_point = 0;  ///< into the patches' list of control points
    int basis = 0;
};

/// Row r makes point targets[r] of points made before it.
struct RefinedPoints {
    std::vector<int> targets, row_begins, sources;
    std::vector<double> weights;
};

struct Tangents {
    glm::dvec3 ds{0.0}, dt{0.0};
};

class LimitPatches {
  public:
    /// Refines `refiner` about its features.
    /// @param crowding  of the cage (measure_crowding)
    LimitPatches(Far::TopologyRefiner& refiner, std::size_t crowding);

    /// The cage's points, then the refined ones: sums only.
    std::vector<glm::dvec3> make_control_points(std::span<const glm::dvec3> cage_points) const;

    /// Finds patch and weights of a location. Only while the surface is built.
    LimitSample make_sample(const LimitLocation& location);
    /// Ends the building: no more samples can be made, and the memory for that is freed.
    void finish_samples() { known_bases_ = {}; }

    glm::dvec3 position(std::span<const glm::dvec3> control, const LimitSample& sample) const;
    Tangents tangents(std::span<const glm::dvec3> control, const LimitSample& sample) const;

    /// At any location; s and t are clamped to the face.
    glm::dvec3 evaluate(std::span<const glm::dvec3> control, int face, double s, double t,
                        Tangents* tangents = nullptr) const;

    /// Face-varying values of channel 0 at places, from the cage's.
    std::vector<glm::vec2> evaluate_uv(const std::vector<glm::vec2>& values,
                                       const std::vector<LimitLocation>& locations) const;

  private:
    static constexpr int max_patch_points = 20;
    /// Weights of a patch's points.
    struct Basis {
        int count = 0;
        double weights[3][max_patch_points] = {};  ///< position, ds, dt
    };

    const Far::PatchTable::PatchHandle& find_patch(int face, double& s, double& t) const;
    void record_stencils();

    const Far::TopologyRefiner& refiner_;
    bool triangular_ = false;
    int cage_point_count_ = 0;
    int point_count_ = 0;
    std::unique_ptr<const Far::PatchTable> table_;
    std::unique_ptr<const Far::PatchMap> map_;
    RefinedPoints refined_;
    /// Samples on a grid share few sets of weights.
    std::vector<Basis> bases_;
    std::unordered_multimap<std::uint64_t, int> known_bases_;
};

}  // namespace aleph
