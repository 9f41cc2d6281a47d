#pragma once
// Numbers of rays by purpose. Their sum equals the number that RayScene counted (RayScene::rays_traced).

#include <cstdint>

namespace aleph {

struct RayCounts {
    std::uint64_t primary = 0;   ///< through pixels
    std::uint64_t shadow = 0;    ///< towards lights, from pixels and from the hits of gather rays
    std::uint64_t gather = 0;    ///< over hemispheres, for irradiance values
    std::uint64_t glossy = 0;    ///< sampled from the glossy lobe, to find lights
    std::uint64_t specular = 0;  ///< 0 in this version
    std::uint64_t path = 0;      ///< 0 in this version

    std::uint64_t total() const { return primary + shadow + gather + glossy + specular + path; }
    RayCounts& operator+=(const RayCounts& o) {
        primary += o.primary;
        shadow += o.shadow;
        gather += o.gather;
        glossy += o.glossy;
        specular += o.specular;
        path += o.path;
        return *this;
    }
};

}  // namespace aleph
