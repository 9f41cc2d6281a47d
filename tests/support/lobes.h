#pragma once
// Surfaces and directions for the tests of the surface model.

#include "render/surface/scatter.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/trial.h"

namespace aleph {

inline glm::vec3 direction_of(float cosine, float azimuth = 0.7f) {
    const float sine = std::sqrt(std::max(0.0f, (1.0f - cosine) * (1.0f + cosine)));
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

/// A surface in the xy plane that is seen from above.
inline ViewedSurface make_viewed(const SurfaceMaterial& material, const glm::vec3& view) {
    ViewedSurface surface;
    surface.point = make_point(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f});
    surface.material = material;
    surface.view = view;
    return surface;
}

/// A square with this material that faces +z, and the point in its middle.
struct MaterialStage {
    explicit MaterialStage(Material material, std::vector<SceneImage> images = {})
        : stage([&] {
              Scene scene;
              scene.images = std::move(images);
              scene.materials.push_back(std::move(material));
              add_mesh(scene, make_quad(1.0, 1.0, 0));
              return scene;
          }()) {
        point.material = 0;
    }
    SurfaceMaterial evaluate() const { return evaluate_material(stage.shading, point, {}); }

    Stage stage;
    SurfacePoint point = make_point(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f});
};

/// The surface material of a scene's material without textures.
/// @param front  seen from its front side
/// @param color  of the vertices
inline SurfaceMaterial evaluate_plain(Material material, bool front = true, const glm::vec4& color = glm::vec4(1.0f)) {
    MaterialStage square(std::move(material));
    square.point.front = front;
    square.point.color = color;
    return square.evaluate();
}

inline SurfaceMaterial make_white_plastic(float alpha, float f0 = 0.04f, float f90 = 1.0f) {
    SurfaceMaterial material = make_lambert(1.0f);
    material.gloss.f0 = Rgb(f0);
    material.gloss.f0_max = f0;
    material.gloss.f90 = material.gloss.f90_max = f90;
    material.gloss.alpha = alpha;
    return material;
}

/// @param ratio  index of refraction of the far side over that of the viewer's
inline SurfaceMaterial make_glass(float alpha, float ratio, bool volume) {
    SurfaceMaterial material{.gloss = {.alpha = alpha}, .glass = {.share = 1.0f}};
    material.glass.ior = material.glass.ior_ratio = ratio;
    material.glass.volume = volume;
    return material;
}

/// Half of the light is lost over the attenuation distance, m; 0: none.
inline int add_glass(Scene& scene, double ior, double thickness, double attenuation_distance = 0.0,
                     double roughness = 0.0) {
    scene.materials.push_back({.gloss = {.metallic = 0.0, .roughness = roughness, .ior = ior},
                               .glass = {.transmission = 1.0,
                                         .thickness = thickness,
                                         .attenuation_distance = attenuation_distance,
                                         .attenuation_color = glm::dvec3(0.5)}});
    return static_cast<int>(scene.materials.size()) - 1;
}

inline SurfaceMaterial with_coat(SurfaceMaterial material, float alpha, float strength = 1.0f) {
    material.coat.strength = strength;
    material.coat.alpha = alpha;
    return material;
}

inline SurfaceMaterial with_sheen(SurfaceMaterial material, float roughness, float color = 1.0f) {
    material.sheen.color = Rgb(color);
    material.sheen.alpha = std::max(roughness * roughness, 1e-3f);
    return material;
}

inline ScatterSample sample_scatter(const LitSurface& lit, const LobeShares& shares, RandomStream& random) {
    const float pick = random.next();
    const glm::vec2 u = random.next_2d();
    return sample_scatter(lit, shares, pick, u, random.next());
}

/// The mean of sample_scatter's red weights.
/// @param check  is called with each sample that has a weight
inline Mean mean_scattered(const LitSurface& lit, int count, std::uint32_t seed, LobeSet lobes = LobeSet::all,
                           const std::function<void(const ScatterSample&)>& check = {}) {
    const LobeShares shares = share_lobes(lit, lobes);
    RandomStream random({seed, 0, 0, 0});
    Mean mean;
    for (int i = 0; i < count; ++i) {
        const ScatterSample sample = sample_scatter(lit, shares, random);
        mean.add(sample.weight.x);
        if (check && sample.weight.x > 0.0f) check(sample);
    }
    return mean;
}

/// Integrates f(light) over the upper hemisphere along half vectors spread like the lobe of this width, so that narrow
/// lobes are resolved: tan = width sqrt(u / (1 - u)).
template <class F>
double integrate_around_lobe(float width, const glm::vec3& view, const F& f, int steps = 512) {
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double u = (i + 0.5) / steps, ratio = std::sqrt(u / (1.0 - u)), tangent = width * ratio;
        const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent), sine = tangent * cosine;
        // d tan / du = width / (2 ratio (1 - u)^2); d theta = cos^2 d tan
        const double ring = sine * cosine * cosine * width / (2.0 * ratio * (1.0 - u) * (1.0 - u)) / steps;
        for (int k = 0; k < steps; ++k) {
            const double azimuth = 2.0 * pi * (k + 0.5) / steps;
            const glm::dvec3 h(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine), v(view);
            const double vh = glm::dot(v, h);
            if (vh <= 0.0) continue;
            const glm::dvec3 light = 2.0 * vh * h - v;
            if (light.z <= 0.0) continue;
            sum += f(glm::vec3(light)) * 4.0 * vh * ring * 2.0 * pi / steps;
        }
    }
    return sum;
}

}  // namespace aleph
