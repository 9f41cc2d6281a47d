#include "render/pixel_surfaces.h"

#include <cmath>
#include <numbers>

#include "engine/base/sampling.h"
#include "render/lattice.h"

namespace aleph {

namespace {

constexpr std::uint32_t lens_seed_mask = 0x6c656e73u;  // keeps the lens apart from other uses of the same key

/// A point of the unit disc: concentric squares become circles (Shirley and Chiu 1997).
glm::dvec2 sample_disc(const glm::vec2& u) {
    const double a = 2.0 * u.x - 1.0, b = 2.0 * u.y - 1.0;
    if (a == 0.0 && b == 0.0) return {0.0, 0.0};
    constexpr double quarter = std::numbers::pi / 4.0;
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b, angle = wide ? quarter * (b / a) : 2.0 * quarter - quarter * (a / b);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Along additive sequences of a pixel's own start. Their steps, sqrt 3 - 1 and (sqrt 13 - 3) / 2, are even by
/// themselves and together with the golden ratio of the pixels' lattice and the shutter's sqrt 2.
glm::vec2 lens_point(const SamplePlace& place, std::uint32_t pixel) {
    const glm::vec2 start = RandomStream({place.seed ^ lens_seed_mask, place.frame, pixel, 0}).next_2d();
    const double i = place.index;
    const glm::dvec2 at(start.x + i * 0.7320508075688772, start.y + i * 0.3027756377319946);
    return glm::min(glm::vec2(at - glm::floor(at)), glm::vec2(0x1.fffffep-1f));
}

}  // namespace

CameraRay make_sample_ray(const CameraView& view, const SampleHits& sample, int x, int y) {
    CameraRay ray = make_camera_ray(view, x + sample.offset_x, y + sample.offset_y);
    const Lens& lens = sample.place.lens;
    if (!(lens.radius > 0.0)) return ray;
    const glm::dvec2 at =
        lens.radius * sample_disc(lens_point(sample.place, static_cast<std::uint32_t>(sample.hits.index(x, y))));
    const glm::dvec3 shift = view.axes[0] * at.x + view.axes[1] * at.y;
    // Rays of a pixel meet in the plane at the focus distance: its planar distance is along the view direction.
    const double along = -glm::dot(ray.direction, view.axes[2]);
    ray.origin += shift;
    ray.direction = glm::normalize(ray.direction - shift * (along / lens.focus_distance));
    return ray;
}

PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y) {
    const Hit& hit = sample.hits(x, y);
    const glm::vec3 direction(make_sample_ray(view, sample, x, y).direction);
    const SurfacePoint point = make_surface_point(shading, hit, direction);
    PixelSurface surface{view_surface(shading, point, -direction,
                                      make_pixel_footprint(view, point, direction, hit.distance, sample.spacing))};
    surface.hit = hit;
    surface.distance = hit.distance;
    const float distance = view.orthographic ? 1.0f : hit.distance;
    surface.footprint = distance / static_cast<float>(view.pixels_per_unit);
    surface.x = x;
    surface.y = y;
    surface.sample = sample.place.index;
    surface.pixel = static_cast<std::uint32_t>(sample.hits.index(x, y));
    return surface;
}

SampleHits cast_sample(const RayScene& rays, const CameraView& view, const SamplePlace& place,
                       std::uint64_t* rays_cast) {
    SampleHits sample;
    sample.place = place;
    if (place.count > 1) {
        const glm::vec2 offset = lattice_point(place.index, place.count, {0.0f, 0.5f});
        sample.offset_x = offset.x;
        sample.offset_y = offset.y;
        sample.spacing = 1.0f / std::sqrt(static_cast<float>(place.count));
    }
    sample.hits = Image<Hit>(view.width, view.height);
    cast_rays(
        rays, [&](int x, int y) { return make_sample_ray(view, sample, x, y); }, place.blend, sample.hits);
    if (rays_cast != nullptr) *rays_cast += sample.hits.size();
    return sample;
}

SampleHits cast_centers(const RayScene& rays, const CameraView& view, std::uint64_t* rays_cast) {
    return cast_sample(rays, view, {}, rays_cast);
}

}  // namespace aleph
