#pragma once
// Numbers of rays by purpose. Their sum equals the number that RayScene counted (RayScene::rays_traced).

#include <cstdint>

namespace aleph {

struct RayCounts {
    std::uint64_t primary = 0;       ///< through pixels
    std::uint64_t shadow = 0;        ///< towards lights, from pixels and from the hits of gather rays
    std::uint64_t gather = 0;        ///< over hemispheres, for irradiance values
    std::uint64_t glossy = 0;        ///< sampled from glossy lobes, coats, sheen and rough glass
    std::uint64_t specular = 0;      ///< reflected by mirrors, refracted and passed by smooth glass
    std::uint64_t path = 0;          ///< sampled from Lambert layers along paths
    std::uint64_t multi_bounce = 0;  ///< from hits of gather rays, where no cache knows the light of further bounces

    std::uint64_t total() const { return primary + shadow + gather + glossy + specular + path + multi_bounce; }
    RayCounts& operator+=(const RayCounts& o) {
        primary += o.primary;
        shadow += o.shadow;
        gather += o.gather;
        glossy += o.glossy;
        specular += o.specular;
        path += o.path;
        multi_bounce += o.multi_bounce;
        return *this;
    }
};

/// Counted where rays are traced.
struct TracedRays {
    std::uint64_t all = 0;      ///< together with `invalid`: RayCounts::total()
    std::uint64_t invalid = 0;  ///< not traced, because they were not finite
    TracedRays operator+(const TracedRays& o) const { return {all + o.all, invalid + o.invalid}; }
    TracedRays operator-(const TracedRays& o) const { return {all - o.all, invalid - o.invalid}; }
};

}  // namespace aleph
