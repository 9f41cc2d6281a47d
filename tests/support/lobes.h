#pragma once
// Surfaces and directions for the tests of the surface model.

#include "render/surface/scatter.h"
#include "tests/support/render_scenes.h"
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

}  // namespace aleph
