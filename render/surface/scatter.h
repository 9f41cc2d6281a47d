#pragma once
// All layers of a surface together, one lobe for each: what they scatter towards a direction, and directions sampled
// from them. Each lobe is sampled by itself, and is weighted by itself against the sampling of lights (Veach 1997).
// Radiance is divided by the square of the index of refraction of its medium, which refraction leaves unchanged.

#include <array>

#include "engine/base/sampling.h"
#include "render/surface/bsdf.h"
#include "render/surface/layers.h"

namespace aleph {

enum class Lobe : std::uint8_t { diffuse, gloss, coat, sheen, glass };
inline constexpr int lobe_count = 5;

/// Which lobes directions are sampled from.
enum class LobeSet : std::uint8_t {
    all,
    specular,  ///< all but the Lambert layer
};

/// A surface with its shading frames.
struct LitSurface {
    explicit LitSurface(const ViewedSurface& surface);

    /// Above both the shading normal's and the geometric normal's horizon, or below both.
    bool is_reached(const glm::vec3& direction) const {
        const float side = glm::dot(point.geometric, direction);
        return side * glm::dot(basis.normal, direction) > 0.0f && (side > 0.0f || material.has_glass());
    }
    /// Origin of a ray that leaves in a direction.
    glm::vec3 ray_origin(const glm::vec3& direction) const {
        const bool front = glm::dot(point.geometric, direction) >= 0.0f;
        return point.position + point.geometric * (front ? point.offset : -point.offset);
    }

    /// Share of light from a direction that the coat and the sheen leave to lobes that depend on the view.
    float below_both(const glm::vec3& direction) const { return std::min(below_sheen, layers.below_all(direction)); }

    const SurfacePoint& point;
    const SurfaceMaterial& material;
    Basis basis;     ///< z along the shading normal, x along the tangent of anisotropy
    glm::vec3 view;  ///< in it
    float cos_view;  ///< view.z, at least 0
    Basis coat_basis;
    glm::vec3 coat_view;
    UpperLayers layers;
    float below_coat, below_sheen;  ///< share of light that the layers above leave, by view
};

/// Probability of each lobe; they sum to 1, or are all 0 where nothing scatters.
using LobeShares = std::array<float, lobe_count>;

/// All directions from one lobe.
constexpr LobeShares only_lobe(Lobe lobe) {
    LobeShares shares{};
    shares[static_cast<int>(lobe)] = 1.0f;
    return shares;
}

/// Shares in proportion to the lobes' approximate albedos.
LobeShares share_lobes(const LitSurface& lit, LobeSet set);

/// f times the cosine of the light, summed over all lobes, each weighted by the power heuristic against being sampled.
/// @param direction  unit, world, for which is_reached
/// @param pdf_light  density of the light's sample per steradian; 0: nothing else can find this light
/// @param shares     of the lobes that are sampled; those of share 0 are not, and have full weight
Rgb scatter_towards(const LitSurface& lit, const glm::vec3& direction, float pdf_light, const LobeShares& shares);

/// A sampled direction.
struct ScatterSample {
    glm::vec3 direction{0.0f};  ///< unit, world
    Rgb weight{0.0f};           ///< f cos / density; 0: nothing is scattered
    float share = 0.0f;         ///< probability of its lobe
    float pdf = 0.0f;  ///< per steradian, of this lobe times its share; 0 for a mirror, glass without roughness
    Lobe lobe = Lobe::diffuse;
    bool passes = false;    ///< through the surface
    bool straight = false;  ///< through a smooth sheet, without a turn
};

/// The numbers, all in [0,1), choose the lobe, its direction, and whether light is reflected by glass or passes it.
ScatterSample sample_scatter(const LitSurface& lit, const LobeShares& shares, float pick, const glm::vec2& u,
                             float side);

/// Share of light that a smooth sheet passes along `view`, with the layers above it.
Rgb sheet_transmittance(const LitSurface& lit);

}  // namespace aleph
