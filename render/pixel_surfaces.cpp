#include "render/pixel_surfaces.h"

#include <cmath>

#include "render/lattice.h"

namespace aleph {

PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y) {
    const Hit& hit = sample.hits(x, y);
    const glm::vec3 direction(make_camera_ray(view, x + sample.offset_x, y + sample.offset_y).direction);
    PixelSurface surface;
    surface.point = make_surface_point(shading, hit, direction);
    surface.material = evaluate_material(
        shading, surface.point, make_pixel_footprint(view, surface.point, direction, hit.distance, sample.spacing));
    surface.view = -direction;
    const float distance = view.orthographic ? 1.0f : hit.distance;
    surface.footprint = distance / static_cast<float>(view.pixels_per_unit);
    surface.x = x;
    surface.y = y;
    surface.sample = sample.index;
    surface.pixel = static_cast<std::uint32_t>(sample.hits.index(x, y));
    return surface;
}

SampleHits cast_sample(const RayScene& rays, const CameraView& view, int i, int n, std::uint64_t* rays_cast) {
    SampleHits sample;
    sample.index = i;
    if (n > 1) {
        const glm::vec2 offset = lattice_point(i, n, {0.0f, 0.5f});
        sample.offset_x = offset.x;
        sample.offset_y = offset.y;
        sample.spacing = 1.0f / std::sqrt(static_cast<float>(n));
    }
    sample.hits = cast_first_hits(rays, view, sample.offset_x, sample.offset_y, rays_cast);
    return sample;
}

}  // namespace aleph
