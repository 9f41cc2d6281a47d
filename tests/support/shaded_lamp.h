#pragma once
// A lamp in a shade above a floor, and what is bright there.

#include "render/cache/aimed_rays.h"
#include "tests/support/indirect_pictures.h"

namespace aleph {

/// Places of a floor.
inline std::vector<Receiver> make_floor_places(float y) {
    std::vector<Receiver> places;
    for (const float x : {-0.9f, 0.0f, 0.9f}) {
        for (const float z : {-0.9f, 0.0f, 0.9f}) places.push_back({{x, y, z}, up});
    }
    return places;
}

inline BrightSurfaces find_bright(const Stage& stage, const std::vector<Receiver>& places, RayCounts& counts) {
    return find_bright_surfaces(stage.lighting(), places, counts);
}

struct ShadedLamp {
    static constexpr float side = 0.2f, height = 1.0f;  // m

    /// A lamp that closes the top of a square tube, as wide as it is high, above a grey floor. The tube is white, with
    /// its front side inside.
    static Scene make_scene() {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
        const int grey = add_lambert(scene, glm::dvec3(0.5));
        add_mesh(scene, make_quad(6.0, 6.0, grey), glm::dvec3(0.0), z_to_up);
        add_lamp(scene, side, glm::dvec3(100.0), {0.0, height + side, 0.0});
        for (int i = 0; i < 4; ++i) {
            const double angle = i * std::numbers::pi / 2;
            add_mesh(scene, make_quad(side, side, white),
                     {-0.5 * side * std::sin(angle), height + 0.5 * side, -0.5 * side * std::cos(angle)},
                     turn_about_y(angle));
        }
        return scene;
    }

    ShadedLamp() : gathering(make_scene()) {
        RayCounts counts;
        surfaces = find_bright(gathering.stage, make_floor_places(0.0f), counts);
        light_rays = counts.gather;
    }
    IrradianceSample gather(const glm::vec3& position, const glm::vec3& normal, int rays, std::uint32_t seed,
                            bool aims = true) {
        return gathering.gather(make_point(position, normal), {choose_strata(rays), {seed, 0, 0, 0}},
                                {.bright = aims ? &surfaces : nullptr});
    }

    Gathering gathering;
    BrightSurfaces surfaces;
    std::uint64_t light_rays = 0;
};
}  // namespace aleph
