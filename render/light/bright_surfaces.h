#pragma once
// Surfaces that reflect so much light that they are sampled like lights (README.md). Rays towards them join those over
// the hemisphere, weighted by the balance heuristic (Veach and Guibas 1995, "Optimally Combining Sampling Techniques
// for Monte Carlo Rendering"): without bias, whatever was taken for bright.

#include <array>
#include <span>
#include <vector>

#include "render/light/light_choice.h"

namespace aleph {

struct BrightSurfaces {
    static constexpr std::size_t most = 512;  ///< a multiple of LightBounds::step
    /// From all lights together, counted as RayCounts::gather: to see whether there are any, and then to find them all.
    static constexpr std::size_t light_rays = 32768, more_light_rays = 131072;

    /// A triangle, or one of four parts of a part (barycentric coordinates halved).
    struct Part {
        int patch = no_index;
        int quarters = no_index;  ///< the first of its four parts
        bool behind = false;      ///< bright is the side that the triangle's normal points away from
    };

    LightSet patches;                       ///< one emitter of one triangle each, shining on its bright side
    std::vector<std::vector<int>> part_of;  ///< per instance: by triangle, or empty
    std::vector<Part> parts;

    bool empty() const { return patches.emitters.empty(); }
    /// The patch that a ray met on its bright side, or no_index.
    int find(const Hit& hit, const glm::vec3& direction) const;
};

/// Triangles and parts of them that reflect far more than others, if most of the noise of rays over a hemisphere is
/// theirs; else none.
/// @param places  where light is wanted: what faces none of them does not count. None: nothing is bright
BrightSurfaces find_bright_surfaces(const LightingContext& context, std::span<const Receiver> places,
                                    RayCounts& counts);

/// Rays from a point, most of them over its hemisphere by cosine, the others towards bright surfaces.
class BrightSampler {
  public:
    /// Keeps a reference to the surfaces, of which there is at least one.
    /// @param around, towards  numbers of rays over the hemisphere and towards bright surfaces
    BrightSampler(const BrightSurfaces& surfaces, const Receiver& receiver, int around, int towards);

    struct Aim {
        glm::vec3 direction{0.0f};  ///< unit
        int patch = no_index;       ///< no_index: none can be seen from here
        glm::vec3 normal{0.0f};     ///< of the patch
    };
    /// A direction towards a bright surface, chosen by about what each brings without obstacles.
    Aim aim(const LightNumbers& numbers) const;

    /// Weight of the radiance that a ray found, at most 1: pi / around times the sum over all rays estimates the
    /// irradiance.
    /// @param patch  that the ray was aimed at; no_index: one over the hemisphere
    float weigh(const Hit& hit, const glm::vec3& direction, int patch) const;

  private:
    float density(int patch, const glm::vec3& direction, float distance) const;

    const BrightSurfaces& surfaces_;
    const Receiver receiver_;
    const float aimed_per_around_;
    std::array<float, BrightSurfaces::most> ends_;  ///< sums of what the patches bring, up to and including each
    float total_ = 0.0f;
};

}  // namespace aleph
