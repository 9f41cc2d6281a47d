#include "render/pixels/pixel_surfaces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "render/pixels/pixel_samples.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

namespace {

/// A point of the unit disc: concentric squares become circles (Shirley and Chiu 1997).
glm::dvec2 sample_disc(const glm::vec2& u) {
    const double a = 2.0 * u.x - 1.0, b = 2.0 * u.y - 1.0;
    if (a == 0.0 && b == 0.0) return {0.0, 0.0};
    constexpr double quarter = std::numbers::pi / 4.0;
    const bool wide = std::abs(a) > std::abs(b);
    const double radius = wide ? a : b, angle = wide ? quarter * (b / a) : 2.0 * quarter - quarter * (a / b);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

constexpr double radius = 1.5;  // pixels, of the Blackman-Harris window
constexpr int steps = 512;

/// Integral of the window (Harris 1978, four terms) from -radius to x, over the whole.
double cumulative(double x) {
    constexpr std::array<double, 4> a{0.35875, 0.48829, 0.14128, 0.01168};
    const double t = (x + radius) / (2.0 * radius), turn = 2.0 * std::numbers::pi;
    double sum = a[0] * t;
    sum -= a[1] * std::sin(turn * t) / turn;
    sum += a[2] * std::sin(2.0 * turn * t) / (2.0 * turn);
    sum -= a[3] * std::sin(3.0 * turn * t) / (3.0 * turn);
    return sum / a[0];
}

double invert(double u) {
    double low = -radius, high = radius;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (cumulative(middle) < u ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Places at even shares of the window.
const std::array<double, steps + 1>& inverse_table() {
    static const std::array<double, steps + 1> table = [] {
        std::array<double, steps + 1> places;
        for (int i = 0; i <= steps; ++i) places[i] = invert(static_cast<double>(i) / steps);
        places.front() = -radius;
        places.back() = radius;
        return places;
    }();
    return table;
}

}  // namespace

float find_spacing(const RenderSettings& settings, int index) {
    const auto first_of_stage = static_cast<unsigned>(std::max(index + 1, own_samples));
    const int count = settings.sampling.rule == Sampling::uniform
                          ? settings.sampling.spp
                          : std::min(settings.sampling.spp, static_cast<int>(std::bit_ceil(first_of_stage)));
    return 1.0f / std::sqrt(static_cast<float>(count));
}

SamplePlace make_sample_place(const RenderSettings& settings, const Lens& lens, bool blended, std::uint32_t noise_key,
                              int index) {
    return {.index = index,
            .centered = settings.sampling.spp == 1,
            .spacing = find_spacing(settings, index),
            .lens = lens,
            .filter = settings.picture.filter,
            .seed = settings.seed,
            .noise_key = noise_key,
            .blend = blended ? Blend::random : Blend::cutout};
}

glm::dvec2 place_sample(const SamplePlace& place, int x, int y) {
    if (place.centered) return {x + 0.5, y + 0.5};
    const glm::vec2 u = PixelSequence(place.seed, place.noise_key, x, y).at_2d(SampleUse::pixel, place.index);
    return {x + 0.5 + place_in_filter(place.filter, u.x), y + 0.5 + place_in_filter(place.filter, u.y)};
}

CameraRay make_lens_ray(const CameraView& view, const Lens& lens, const glm::dvec2& pixel, const glm::vec2& u) {
    CameraRay ray = make_camera_ray(view, pixel.x, pixel.y);
    const glm::dvec2 at = lens.radius * sample_disc(u);
    const glm::dvec3 shift = view.axes[0] * at.x + view.axes[1] * at.y;
    // Rays of a pixel meet in the plane at the focus distance: its planar distance is along the view direction.
    const double along = -glm::dot(ray.direction, view.axes[2]);
    ray.origin += shift;
    ray.direction = glm::normalize(ray.direction - shift * (along / lens.focus_distance));
    return ray;
}

CameraRay make_sample_ray(const CameraView& view, const SamplePlace& place, int x, int y) {
    const glm::dvec2 pixel = place_sample(place, x, y);
    const PixelSequence sequence(place.seed, place.noise_key, x, y);
    CameraRay ray = place.lens.radius > 0.0
                        ? make_lens_ray(view, place.lens, pixel, sequence.at_2d(SampleUse::lens, place.index))
                        : make_camera_ray(view, pixel.x, pixel.y);
    if (place.blend == Blend::random) ray.choice = sequence.at_1d(SampleUse::passing, place.index);
    return ray;
}

PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SamplePlace& place,
                                const Hit& hit, const glm::vec3& direction, const glm::ivec2& pixel) {
    const SurfacePoint point = make_surface_point(shading, hit, direction);
    PixelSurface surface{view_surface(shading, point, -direction,
                                      make_pixel_footprint(view, point, direction, hit.distance, place.spacing))};
    surface.hit = hit;
    const float distance = view.orthographic ? 1.0f : hit.distance;
    surface.footprint = distance / static_cast<float>(view.pixels_per_unit);
    surface.x = pixel.x;
    surface.y = pixel.y;
    surface.sample = place.index;
    surface.pixel = static_cast<std::uint32_t>(pixel.y) * static_cast<std::uint32_t>(view.width) +
                    static_cast<std::uint32_t>(pixel.x);
    return surface;
}

PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y) {
    const glm::vec3 direction(make_sample_ray(view, sample.place, x, y).direction);
    return make_pixel_surface(shading, view, sample.place, sample.hits(x, y), direction, {x, y});
}

SampleHits cast_sample(const RayScene& rays, const CameraView& view, const SamplePlace& place,
                       std::uint64_t* rays_cast) {
    SampleHits sample{Image<Hit>(view.width, view.height), place};
    cast_rays(
        rays, [&](int x, int y) { return make_sample_ray(view, place, x, y); }, place.blend, sample.hits);
    if (rays_cast != nullptr) *rays_cast += sample.hits.size();
    return sample;
}

SampleHits cast_centers(const RayScene& rays, const CameraView& view, std::uint64_t* rays_cast) {
    return cast_sample(rays, view, {}, rays_cast);
}

double place_in_filter(PixelFilter filter, double u) {
    if (filter == PixelFilter::box) return u - 0.5;
    const std::array<double, steps + 1>& inverse = inverse_table();
    const double place = std::clamp(u, 0.0, 1.0) * steps;
    const int i = std::min(static_cast<int>(place), steps - 1);
    return inverse[i] + (inverse[i + 1] - inverse[i]) * (place - i);
}

double filter_density(PixelFilter filter, double place) {
    if (filter == PixelFilter::box) return std::abs(place) <= 0.5 ? 1.0 : 0.0;
    if (!(std::abs(place) <= radius)) return 0.0;
    const std::array<double, steps + 1>& inverse = inverse_table();
    const auto* const after = std::upper_bound(inverse.begin() + 1, inverse.end() - 1, place);
    return 1.0 / (steps * (*after - *(after - 1)));
}

}  // namespace aleph
