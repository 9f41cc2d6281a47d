#include "render/shade/lens_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/sampling.h"
#include "render/pixels/pixel_sequence.h"
#include "render/shade/bright_edges.h"

namespace aleph {

namespace {

// Pixels: radius of a disc that is worth rays of its own, and of one that shows next to nothing.
constexpr double least_blur = 1.0, most_blur = 1e4;
constexpr double farthest_in_filter = 2.0;  // pixels
constexpr double small_in_blur = 2.0;       // radii of that disc: most rays meet a larger lamp
constexpr double rounding = 1e-6;           // of coordinates, by which a point must not move on the lens
constexpr int lamp_rays = 8;
constexpr double nearly_all = 0.75;     // of a filter's square
constexpr int places = 8;               // in a polygon, which tell how much the filter weighs it
constexpr float same_distance = 1e-3f;  // of two places on a lamp

/// The least octagon around a disc with sides along x, y and the diagonals.
PicturePolygon surround(const LensLight::Lamp& lamp) {
    const double r = lamp.radius, half_side = (std::numbers::sqrt2 - 1.0) * r;
    PicturePolygon octagon;
    for (const glm::dvec2& corner : {glm::dvec2(r, -half_side),
                                     {r, half_side},
                                     {half_side, r},
                                     {-half_side, r},
                                     {-r, half_side},
                                     {-r, -half_side},
                                     {-half_side, -r},
                                     {half_side, -r}})
        octagon.add(lamp.middle + corner);
    return octagon;
}

/// Returns whether a place is in that octagon.
bool is_around(const LensLight::Lamp& lamp, const glm::dvec2& place) {
    const glm::dvec2 away = glm::abs(place - lamp.middle);
    return std::max(away.x, away.y) <= lamp.radius && away.x + away.y <= std::numbers::sqrt2 * lamp.radius;
}

}  // namespace

std::optional<LensLight> find_lens_light(const LightingContext& context, const CameraView& view, const Lens& lens,
                                         double exposure) {
    if (view.orthographic || !(lens.focus_distance * rounding < lens.radius)) return std::nullopt;
    LensLight light;
    const auto find_blur = [&](double depth) {
        return lens.radius * std::abs(1.0 / depth - 1.0 / lens.focus_distance) * view.pixels_per_unit;
    };
    for (const Emitter& emitter : context.lights.emitters) {
        const glm::dvec3 center = to_camera(view, context.rays.anchor() + glm::dvec3(emitter.center));
        const double depth = -center.z, radius = double{emitter.radius};
        if (!(luminance(emitter.brightest) * exposure >= least_bright && depth > 2.0 * radius)) continue;
        const double size = radius / (depth - radius) * view.pixels_per_unit, blur = find_blur(depth);
        if (!(blur >= least_blur && blur <= most_blur) || size > small_in_blur * blur) continue;
        // The view may look at the lamp aslant.
        const double slant = glm::length(center) / depth;
        light.lamps.push_back({emitter.instance, project_camera_point(view, center),
                               std::max(find_blur(depth - radius), find_blur(depth + radius)) + slant * slant * size,
                               double{luminance(emitter.brightest)} * size * size / (size * size + blur * blur)});
    }
    if (light.lamps.empty()) return std::nullopt;
    constexpr int tile = LensLight::tile;
    light.tiles = Image<std::vector<int>>((view.width + tile - 1) / tile, (view.height + tile - 1) / tile);
    for (int i = 0; i < std::ssize(light.lamps); ++i) {
        const glm::dvec2 reach(light.lamps[i].radius + farthest_in_filter), size(light.tiles.width, light.tiles.height);
        const glm::ivec2 low(
            glm::clamp(glm::floor((light.lamps[i].middle - reach) / double{tile}), glm::dvec2(0.0), size));
        const glm::ivec2 high(
            glm::clamp(glm::ceil((light.lamps[i].middle + reach) / double{tile}), glm::dvec2(0.0), size));
        for (int y = low.y; y < high.y; ++y)
            for (int x = low.x; x < high.x; ++x) light.tiles(x, y).push_back(i);
    }
    return light;
}

LensPixel::LensPixel(const LensLight& light, PixelFilter filter, const glm::ivec2& pixel)
    : pixel_(pixel), filter_(filter) {
    const glm::dvec2 middle = glm::dvec2(pixel) + 0.5, reach(place_in_filter(filter, 1.0));
    double sum = 0.0, end = 0.0;
    for (const int i : light.tiles(pixel.x / LensLight::tile, pixel.y / LensLight::tile)) {
        Part part;
        part.lamp = &light.lamps[i];
        part.polygon = clip_to_rectangle(surround(*part.lamp), middle - reach, middle + reach);
        const double area = area_of(part.polygon);
        if (!(area > 0.0)) continue;
        double share = 0.0;
        if (area >= nearly_all * 4.0 * reach.x * reach.y) {
            part.polygon = {};
            share = 1.0;
        } else {
            for (int k = 0; k < places; ++k)
                share += area / places * weigh(sample_polygon(part.polygon, lattice_point(k, places, {0.0f, 0.3f})));
        }
        const double weight = part.lamp->bright * share;
        if (!(weight > 0.0)) continue;
        part.density = part.polygon.count > 0 ? weight / area : weight;
        sum += weight;
        parts_.push_back(part);
        ends_.push_back(static_cast<float>(weight));
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        parts_[i].density /= sum;
        ends_[i] = static_cast<float>((end += double{ends_[i]}) / sum);
    }
}

/// Density of the filter at a place of the picture.
double LensPixel::weigh(const glm::dvec2& place) const {
    const glm::dvec2 away = place - (glm::dvec2(pixel_) + 0.5);
    return filter_density(filter_, away.x) * filter_density(filter_, away.y);
}

/// Where all rays of a place in the picture meet.
struct LensPixel::Focus {
    glm::dvec2 place;       ///< pixels
    glm::dvec3 back;        ///< unit, across the lens
    double distance;        ///< m, from the lens to the plane that is sharp
    double area;            ///< m2, of the lens
    glm::vec3 lens, point;  ///< m, relative to the anchor: the middle of the lens, and where the rays meet

    Focus(const SampleScene& scene, const Lens& open, const glm::dvec2& at)
        : place(at),
          back(scene.view.axes[2]),
          distance(open.focus_distance),
          area(std::numbers::pi * open.radius * open.radius) {
        const CameraRay ray = make_camera_ray(scene.view, at.x, at.y);
        const glm::dvec3 middle = ray.origin - scene.lighting.rays.anchor();
        lens = glm::vec3(middle);
        point = glm::vec3(middle - ray.direction * (distance / glm::dot(ray.direction, back)));
    }

    /// m: from the point along a unit direction to the lens; negative if it is the other way.
    double to_lens(const glm::vec3& direction) const { return distance / glm::dot(glm::dvec3(direction), back); }
};

/// Density of the rays towards lamps over that of the samples' own rays, of a ray that met something.
double LensPixel::find_density(const SampleScene& scene, const Focus& focus, const Hit& hit,
                               const glm::vec3& direction) const {
    const auto found = std::ranges::find_if(parts_, [&](const Part& p) { return p.lamp->instance == hit.instance; });
    if (hit.instance == no_index || found == parts_.end()) return 0.0;
    const bool is_even = found->polygon.count > 0;
    if (is_even && !is_around(*found->lamp, focus.place)) return 0.0;
    const LightSet& lights = scene.lighting.lights;
    const int number = lights.emitter_of_instance[hit.instance];
    if (number < 0) return 0.0;
    const Emitter& emitter = lights.emitters[number];
    const SurfacePoint point = make_surface_point(scene.lighting.shading, hit, direction);
    const glm::vec3 from_lens = point.position - focus.lens, from_point = point.position - focus.point;
    const double distance = glm::length(from_lens), beyond = glm::length(from_point);
    if (!(beyond > 0.0)) return 0.0;
    float cosine = -glm::dot(point.geometric, from_lens) / static_cast<float>(distance);
    if (emitter.double_sided) cosine = std::abs(cosine);
    // Per solid angle from the lens, per area of the lamp, per solid angle from the point, per area of the lens.
    double density = double{pdf_emitter(emitter, focus.lens, hit, cosine, static_cast<float>(distance))};
    density *= double{cosine} / (distance * distance);
    const glm::vec3 away = from_point / static_cast<float>(beyond);
    density *= beyond * beyond / std::abs(double{glm::dot(point.geometric, away)});
    const double way = focus.to_lens(away);
    density *= focus.distance / std::abs(way * way * way);
    density *= lamp_rays * focus.area * found->density / (is_even ? weigh(focus.place) : 1.0);
    return std::isfinite(density) ? density : std::numeric_limits<double>::max();
}

/// The light of a ray towards one of the lamps, over the density of both kinds of rays.
Rgb LensPixel::find_lamp(const SampleScene& scene, RayTask& task, const SamplePlace& place, int index) const {
    const PixelSequence sequence(place.seed, place.noise_key, pixel_.x, pixel_.y);
    const LightSet& lights = scene.lighting.lights;
    glm::vec2 u = sequence.at_2d(SampleUse::lamp_disc, index);
    const Part& chosen = parts_[choose_part(ends_, u.x)];
    const int number = lights.emitter_of_instance[chosen.lamp->instance];
    if (number < 0) return Rgb(0.0f);
    const glm::dvec2 at =
        chosen.polygon.count > 0
            ? sample_polygon(chosen.polygon, u)
            : glm::dvec2(pixel_) + 0.5 + glm::dvec2(place_in_filter(filter_, u.x), place_in_filter(filter_, u.y));
    const Focus focus(scene, place.lens, at);
    const LightSample sample =
        sample_light(scene.lighting.shading, lights, number, {focus.lens, glm::vec3(-focus.back)},
                     sequence.at_2d(SampleUse::lamp_point, index), 1.0f);
    if (!(sample.pdf > 0.0f)) return Rgb(0.0f);
    const glm::vec3 on_lamp = focus.lens + sample.direction * sample.distance;
    const glm::vec3 away = glm::normalize(on_lamp - focus.point);
    const glm::vec3 on_lens = focus.point + away * static_cast<float>(focus.to_lens(away));
    if (!(glm::distance(on_lens, focus.lens) <= static_cast<float>(place.lens.radius))) return Rgb(0.0f);
    const float distance = glm::distance(on_lens, on_lamp);
    Ray ray{on_lens, (on_lamp - on_lens) / distance};
    if (place.blend == Blend::random) ray.choice = sequence.at_1d(SampleUse::passing, place.index);
    const Hit met = task.tracer.intersect(ray);
    ++task.counts.primary;
    const bool is_other = std::abs(met.distance - distance) > same_distance * distance;
    if (met.instance != chosen.lamp->instance || is_other) return Rgb(0.0f);
    const double density = find_density(scene, focus, met, ray.direction);
    return density > 0.0
               ? find_emission(scene, task, place, met, ray.direction, pixel_) / static_cast<float>(1.0 + density)
               : Rgb(0.0f);
}

Rgb LensPixel::correct(const SampleScene& scene, RayTask& task, const SamplePlace& place, const Hit& hit,
                       const glm::vec3& direction) const {
    if (parts_.empty()) return Rgb(0.0f);
    Rgb change(0.0f);
    for (int i = 0; i < lamp_rays; ++i) change += find_lamp(scene, task, place, lamp_rays * place.index + i);
    const Focus focus(scene, place.lens, place_sample(place, pixel_.x, pixel_.y));
    if (const double density = find_density(scene, focus, hit, direction); density > 0.0)
        change -=
            find_emission(scene, task, place, hit, direction, pixel_) * static_cast<float>(density / (1.0 + density));
    return change;
}

}  // namespace aleph
