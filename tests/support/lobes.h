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

/// The surface material of a scene's material without textures.
/// @param front  seen from its front side
/// @param color  of the vertices
inline SurfaceMaterial evaluate_plain(Material material, bool front = true, const glm::vec4& color = glm::vec4(1.0f)) {
    Scene scene;
    scene.materials.push_back(std::move(material));
    add_mesh(scene, make_quad(1.0, 1.0, 0));
    const Stage stage(std::move(scene));
    SurfacePoint point = make_point(glm::vec3(0.0f), {0.0f, 0.0f, 1.0f});
    point.material = 0;
    point.front = front;
    point.color = color;
    return evaluate_material(stage.shading, point, {});
}

inline SurfaceMaterial make_white_plastic(float alpha, float f0 = 0.04f, float f90 = 1.0f) {
    SurfaceMaterial material = make_lambert(1.0f);
    material.f0 = Rgb(f0);
    material.f0_max = f0;
    material.f90 = material.f90_max = f90;
    material.alpha = alpha;
    return material;
}

/// @param ratio  index of refraction of the far side over that of the viewer's
inline SurfaceMaterial make_glass(float alpha, float ratio, bool volume) {
    SurfaceMaterial material;
    material.glass = 1.0f;
    material.alpha = alpha;
    material.ior = material.ior_ratio = ratio;
    material.volume = volume;
    return material;
}

inline SurfaceMaterial with_coat(SurfaceMaterial material, float alpha, float strength = 1.0f) {
    material.coat = strength;
    material.coat_alpha = alpha;
    return material;
}

inline SurfaceMaterial with_sheen(SurfaceMaterial material, float roughness, float color = 1.0f) {
    material.sheen = Rgb(color);
    material.sheen_alpha = std::max(roughness * roughness, 1e-3f);
    return material;
}

/// Means of sample_scatter's red weights times g(direction).
template <class G>
Mean mean_scattered(const LitSurface& lit, int count, std::uint32_t seed, const G& g) {
    const LobeShares shares = share_lobes(lit, LobeSet::all);
    RandomStream random({seed, 0, 0, 0});
    Mean mean;
    for (int i = 0; i < count; ++i) {
        const float pick = random.next();
        const glm::vec2 u = random.next_2d();
        const ScatterSample sample = sample_scatter(lit, shares, pick, u, random.next());
        mean.add(sample.weight.x > 0.0f ? sample.weight.x * g(sample) : 0.0);
    }
    return mean;
}

}  // namespace aleph
