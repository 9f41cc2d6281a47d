#pragma once
// A plate whose light is asked for at another time than the frame's.

#include "render/time/shutter_light.h"
#include "tests/support/scenes/shot_scenes.h"

namespace aleph {

/// Answers with the place that it is asked for, from records that reach so far.
struct AskedPlace : CarriedLight {
    std::optional<Rgb> find(const PixelSurface& surface, float, RayTask&, RecordUse* used) const override {
        if (used != nullptr) used->add({1.0f, 2.0f, 2.0f * reach});
        return surface.point.position;
    }
    float reach = 1.0f;
};

/// A floor, over it a plate about the origin (node 1) seen from above, and a box far away (node 2). The camera is
/// node 3.
struct Plate {
    Plate() {
        add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, -0.5, 0.0}, z_to_up);
        add_mesh(scene, make_quad(1.0, 1.0, 0), glm::dvec3(0.0), z_to_up);
        add_mesh(scene, make_box(glm::dvec3(0.2), 0), {8.0, 1.0, 0.0});
        add_camera(scene, {0.0, 5.0, 0.0}, glm::dvec3(0.0), 0.2);
    }
    Scene scene;
};

/// The irradiance of the surface in the middle of the picture, one second after the frame. Everything lies far from the
/// world's origin.
inline std::optional<Rgb> find_middle(Scene scene, float accuracy, float reach = 1.0f) {
    const glm::dvec3 far(160.0, 32.0, -48.0);
    for (Node& node : scene.nodes)
        for (glm::dvec3& place : node.transform.translation.values) place += far;
    const Stage frame(scene), sample(scene, 32, 24, 1.0);
    const SampleHits hits = cast_centers(sample.rays, sample.view, nullptr);
    const PixelSurface surface = make_pixel_surface(sample.shading, sample.view, hits, 16, 12);
    AskedPlace light;
    light.reach = reach;
    RayTask task(frame.rays);
    std::optional<Rgb> found =
        ShutterLight(frame.shading, sample.shading, &light, nullptr).find(surface, accuracy, task);
    if (found) *found += glm::vec3(frame.shading.anchor - far);
    return found;
}

}  // namespace aleph
