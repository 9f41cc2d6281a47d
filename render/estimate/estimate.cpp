#include "render/estimate/estimate.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

/// Points per light: fewer if there are many lights, so that the estimate stays quick. A single point of a window shows
/// all of its light or none, whatever share of it glazing bars hide.
int points_per_light(const LightSet& lights) {
    constexpr int most_points = 16, most_per_light = 4;
    return std::clamp(most_points / std::max(1, lights.count()), 1, most_per_light);
}

}  // namespace

Rgb estimate_radiance(const LightingContext& context, RayTask& task, const PixelSurface& surface, EstimateKind kind) {
    const SurfaceMaterial& material = surface.material;
    if (kind == EstimateKind::flat) return material.emission + (material.diffuse + material.gloss.f0);
    return material.emission + estimate_direct_light(context, task, surface, points_per_light(context.lights));
}

Image<Rgb> compute_estimate(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                            const EstimateOptions& options, RayCounts& counts) {
    const EstimateKind kind = options.kind;
    Image<Rgb> estimate(view.width, view.height);
    const float scale = static_cast<float>(options.exposure);
    Image<DiffuseSurface> surfaces;
    if (options.indirect != nullptr && kind == EstimateKind::direct)
        surfaces = Image<DiffuseSurface>(view.width, view.height);
    const auto estimate_row = [&](int y, RayTask& task) {
        for (int x = 0; x < view.width; ++x) {
            Rgb radiance = Rgb(1.0f);
            const bool hit = centers.hits(x, y).instance != no_index;
            if (!hit && kind == EstimateKind::direct) {
                radiance =
                    environment_radiance(context.shading, glm::vec3(make_camera_ray(view, x + 0.5, y + 0.5).direction));
            }
            if (hit) {
                const PixelSurface s = make_pixel_surface(context.shading, view, centers, x, y);
                radiance = estimate_radiance(context, task, s, kind);
                if (!surfaces.empty()) surfaces(x, y) = make_diffuse_surface(s);
            }
            estimate(x, y) = radiance * scale;
        }
    };
    cast_parallel(view.height, 4, context.rays, counts, estimate_row, Blend::cutout);  // without noise
    if (surfaces.empty()) return estimate;
    const Image<Rgb> light = interpolate_estimate(*options.indirect, surfaces);
    for (std::size_t i = 0; i < estimate.size(); ++i) estimate.pixels[i] += light.pixels[i] * scale;
    return estimate;
}

std::optional<double> compute_exposure(const Image<Rgb>& estimate) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const Rgb& pixel : estimate.pixels) {
        const double y = luminance(pixel);
        if (!(y > 0.0) || !std::isfinite(y)) continue;
        sum += std::log(y);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return 0.18 / std::exp(sum / static_cast<double>(count));
}

}  // namespace aleph
