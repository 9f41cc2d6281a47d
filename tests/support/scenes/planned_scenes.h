// Tiny scenes for the tests of the effects plan.

#pragma once

#include <set>
#include <string>

#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {

/// A camera 3 m in front of the origin that looks along -z.
inline Scene make_empty_view() {
    Scene scene;
    scene.film.exposure = 1.0;
    scene.film.range = FrameRange{0, 4};
    add_camera(scene, {0.0, 0.0, 3.0}, glm::dvec3(0.0));
    return scene;
}

/// The same before a square of albedo .5 that a point light in front of it lights: the only effect is direct light.
inline Scene make_lit_square() {
    Scene scene = make_empty_view();
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.5))));
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {0.3, 0.2, 2.0});
    return scene;
}

/// 24x16 pixels, one sample; every frame by itself, without a model of vision.
inline RenderSettings planned_settings() {
    RenderSettings settings = plain_settings(0.3, 64);
    set_size(settings, 24, 16);
    return settings;
}

inline int add_material(Scene& scene, double metallic, double roughness) {
    scene.materials.push_back({.base_color = glm::dvec3(metallic > 0.0 ? 0.8 : 0.0),
                               .gloss = {.metallic = metallic, .roughness = roughness}});
    return static_cast<int>(scene.materials.size()) - 1;
}

/// Texels of one colour.
inline TextureRef add_texture(Scene& scene, const glm::u8vec4& texel) {
    SceneImage image{.bytes = Image<glm::u8vec4>(2, 2, texel)};
    scene.images.push_back(image);
    TextureRef texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    return texture;
}

inline void make_surroundings(Scene& scene, double radiance) {
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(radiance));
}

/// Names of the effects that a plan does not skip.
inline std::set<std::string> simulated(const EffectsPlan& plan) {
    std::set<std::string> names;
    for (const PlannedEffect& effect : plan.effects) {
        if (effect.decision != Decision::skip) names.insert(effect.name);
    }
    return names;
}

/// Every effect, or all but these.
inline EffectSet all_effects(const std::set<std::string>& but = {}) {
    EffectSet effects;
    for (const EffectName& effect : effect_list) {
        if (!but.contains(effect.name)) effects.add(effect.id);
    }
    return effects;
}

/// Largest difference of luminance between two pictures, cd/m2.
inline double largest_difference(const Scene& scene, const FrameOutput& a, const FrameOutput& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.shaded.color.size(); ++i) {
        const double difference = luminance(a.shaded.color.pixels[i]) - luminance(b.shaded.color.pixels[i]);
        largest = std::max(largest, std::abs(difference) * scene.film.viewing.display_white);
    }
    return largest;
}

}  // namespace aleph
