#pragma once
// Indirect light alone, from pictures and from dense gathers, in scenes of Lambert surfaces.

#include "render/cache/cache_fill.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {

/// The light that surfaces reflect of their indirect irradiance: a picture less the same picture's direct light.
struct IndirectPicture {
    Image<Rgb> all;       ///< with direct light
    Image<Rgb> indirect;  ///< without
    FrameCounts counts;
};

inline IndirectPicture shade_indirect(const Stage& stage, RenderSettings settings) {
    settings.light.light_samples = 1;
    const ShadedFrame all = shade(stage, settings);
    settings.light.bounces = 0;
    IndirectPicture out{all.color, shade(stage, settings).color, all.counts};
    for (std::size_t i = 0; i < out.all.size(); ++i)
        out.indirect.pixels[i] = out.all.pixels[i] - out.indirect.pixels[i];
    return out;
}

/// A scene whose light is gathered.
struct Gathering {
    explicit Gathering(Scene scene) : stage(std::move(scene)), task(stage.rays) {}

    IrradianceSample gather(const SurfacePoint& point, const GatherPattern& pattern,
                            const GatherOptions& options = {}) {
        return gather_irradiance(stage.lighting(), task, point, pattern, scratch, options);
    }
    IrradianceSample at(const glm::vec3& position, const glm::vec3& normal, int samples, std::uint32_t seed = 0) {
        return gather(make_point(position, normal), {choose_strata(samples), {seed, 0, 0, 0}});
    }

    Stage stage;
    RayTask task;
    GatherScratch scratch;
};

/// The light that a surface reflects of the irradiance of a gather with so many strata and random numbers of its own.
inline Rgb gather_indirect(const Stage& stage, const PixelSurface& surface, int strata) {
    RayTask task(stage.rays);
    GatherScratch scratch;
    const RandomKey key{0x72656665u, 0, surface.pixel, 0};
    const Rgb irradiance =
        gather_irradiance(stage.lighting(), task, surface.point, {choose_strata(strata), key}, scratch).irradiance;
    return surface.material.diffuse * irradiance / std::numbers::pi_v<float>;
}

/// A closed white room, 4 m by 3 m by 4 m about the origin, with a lamp.
inline Scene make_lamp_room(const glm::dvec3& lamp, double intensity = 60.0) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true);
    add_mesh(scene, make_box({4.0, 3.0, 4.0}, white));
    add_light(scene, Light::Kind::point, glm::dvec3(intensity), lamp);
    return scene;
}

/// A scene that is ready for its indirect light to be computed: first hits of its picture and one accuracy everywhere.
struct IndirectStage {
    IndirectStage(Scene scene, int width, int height, double accuracy, int gather = 64)
        : stage(std::move(scene), width, height),
          lighting(stage.lighting()),
          settings(plain_settings(accuracy, gather)),
          alpha(width, height, static_cast<float>(accuracy)),
          centers(cast_centers(stage.rays, stage.view, nullptr)),
          context{.lighting = lighting,
                  .view = stage.view,
                  .settings = settings,
                  .accuracy = alpha,
                  .max_radius = scene_radius(stage.shading),
                  .progress = {}} {}

    /// A cache with the picture's records, and what filling it took.
    struct Filled {
        IrradianceCache cache;
        FrameTally tally;
    };
    Filled fill() const {
        const Image<float> zero(stage.view.width, stage.view.height);
        Filled filled{make_cache(stage.shading), {zero, zero, {}}};
        fill_cache(filled.cache, context, centers, filled.tally);
        return filled;
    }

    Stage stage;
    LightingContext lighting;
    RenderSettings settings;
    Image<float> alpha;
    SampleHits centers;
    IndirectContext context;
};

}  // namespace aleph
