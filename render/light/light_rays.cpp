#include "render/light/light_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/base/sampling.h"
#include "render/surface/environment_map.h"
#include "render/surface/surface_material.h"

namespace aleph {

namespace {

constexpr std::uint32_t light_ray_key = 0x62726967u;  // no other random numbers have it

constexpr float whole_sphere = 2.0f;  // versine of the directions of a point light

float find_cone(const PunctualLight& light) {
    return light.kind == Light::Kind::spot ? light.outer_versine : whole_sphere;
}

double find_solid_angle(const PunctualLight& light) {
    return 2.0 * std::numbers::pi * find_cone(light);
}

/// A place that light from afar passes.
struct Passage {
    glm::vec3 at{0.0f};
    glm::vec3 outward{0.0f};  ///< unit, of an opening; 0: none is known
    double area = 0.0;        ///< m2, of all passages: of the openings, or across the light
};

double find_area(const SkyOpening& opening) {
    const glm::vec2 size = opening.high - opening.low;
    return double{size.x} * size.y;
}

double find_area(const SkyOpenings& all) {
    double area = 0.0;
    for (const SkyOpening& opening : all.openings) area += find_area(opening);
    return area;
}

/// All places of the openings are as likely.
Passage choose_passage(const SkyOpenings& all, RandomStream& random) {
    Passage passage{.area = find_area(all)};
    double left = random.next() * passage.area;
    auto opening = all.openings.begin();
    for (; opening + 1 != all.openings.end() && left >= find_area(*opening); ++opening) left -= find_area(*opening);
    const glm::vec2 u = random.next_2d();
    const auto& corners = opening->corners;
    passage.at = corners[0] + u.x * (corners[1] - corners[0]) + u.y * (corners[3] - corners[0]);
    passage.outward[opening->side / 2] = opening->side % 2 == 0 ? -1.0f : 1.0f;
    return passage;
}

/// lm, of each light; of light from afar, what passes the openings or crosses the target.
std::vector<double> find_powers(const LightingContext& context, const BoundingSphere& target) {
    const LightSet& lights = context.lights;
    const double disc = std::numbers::pi * target.radius * target.radius;
    const double open = context.openings != nullptr ? find_area(*context.openings) : 0.0;
    std::vector<double> powers;
    for (const Emitter& emitter : lights.emitters) {
        const double sides = emitter.double_sided ? 2.0 : 1.0;
        powers.push_back(std::numbers::pi * luminance(emitter.brightest) * emitter.shape->mean_of_brightest *
                         emitter.area * sides);
    }
    for (const PunctualLight& light : lights.punctual) {
        const bool is_far = light.kind == Light::Kind::directional;
        const double area = open > 0.0 ? open : disc;
        powers.push_back((is_far ? area : find_solid_angle(light)) * luminance(light.intensity));
    }
    if (lights.has_environment) {
        const EnvironmentMap* map = context.shading.environment.map;
        const double mean = map != nullptr ? map->mean_luminance : 1.0;
        const double area = open > 0.0 ? open : 4.0 * disc;
        powers.push_back(std::numbers::pi * area * mean * luminance(context.shading.environment.radiance));
    }
    return powers;
}

Ray leave_emitter(const ShadingScene& shading, const Emitter& emitter, float place, RandomStream& random) {
    const auto chosen = static_cast<std::size_t>(choose_part(emitter.shape->cumulative, place));
    const glm::vec2 b = sample_place(emitter, chosen, random.next_2d()).b;
    const Emitter::Triangle t = emitter.triangle(chosen);
    const bool other_side = emitter.double_sided && random.next() < 0.5f;
    const glm::vec3 normal = other_side ? -t.normal : t.normal;
    const glm::vec3 direction = make_basis(normal).to_world(sample_cosine_hemisphere(random.next_2d()));
    const SurfacePoint start = make_surface_point(shading, {emitter.instance, t.primitive, b.x, b.y, 0.0f}, -direction);
    return {start.ray_origin(), direction};
}

/// All directions of its cone are as likely.
Ray leave_punctual(const PunctualLight& light, RandomStream& random) {
    const glm::vec2 u = random.next_2d();
    const float versine = find_cone(light) * u.x, cosine = 1.0f - versine;
    const float sine = std::sqrt(std::max(0.0f, versine * (2.0f - versine)));
    const float turn = 2.0f * std::numbers::pi_v<float> * u.y;
    const glm::vec3 axis = light.kind == Light::Kind::spot ? light.direction : glm::vec3(0.0f, 1.0f, 0.0f);
    return {light.position, make_basis(axis).to_world({sine * std::cos(turn), sine * std::sin(turn), cosine})};
}

/// Light of the environment that reaches a passage of 1 m2 across it.
LightSample sample_sky(const LightingContext& context, const glm::vec3& outward, RandomStream& random) {
    const int light = context.lights.count() - 1;
    const bool even = context.shading.environment.map == nullptr, halves = even && outward == glm::vec3(0.0f);
    const glm::vec3 half(0.0f, halves && random.next() < 0.5f ? -1.0f : 1.0f, 0.0f);
    const Receiver receiver{{}, outward == glm::vec3(0.0f) ? half : outward};
    LightSample sample = sample_light(context.shading, context.lights, light, receiver, random.next_2d());
    if (halves) sample.incoming *= 2.0f;  // each half of it is sampled in turn
    return sample;
}

/// A ray of light from afar that comes through an opening or, where none is known, crosses the target.
/// @param sun    null: the environment
/// @param power  set to that of the light, as this ray tells it, lm
Ray come_from_afar(const LightingContext& context, const BoundingSphere& target, const PunctualLight* sun,
                   RandomStream& random, double& power) {
    Passage passage;
    if (context.openings != nullptr) passage = choose_passage(*context.openings, random);
    LightSample light{.incoming = Rgb(0.0f)};
    if (sun != nullptr) {
        light.direction = -sun->direction;
        light.incoming = sun->intensity;
    } else {
        light = sample_sky(context, passage.outward, random);
    }
    if (context.openings == nullptr) {
        const glm::vec2 disc = target.radius * glm::vec2(sample_cosine_hemisphere(random.next_2d()));
        passage.at = target.center + make_basis(light.direction).to_world({disc, 0.0f});
        passage.area = std::numbers::pi * target.radius * target.radius;
    } else {
        passage.area *= std::max(0.0f, glm::dot(light.direction, passage.outward));
    }
    power = passage.area * luminance(light.incoming);
    const BoundingBox& bounds = context.shading.bounds.all;
    const float back = glm::length(bounds.high - bounds.low) + glm::length(target.center) + target.radius;
    return {passage.at + light.direction * back, -light.direction};
}

/// One of the rays of a light.
struct LightRay {
    int light = 0;
    float place = 0.0f;  ///< among those of the light, in [0, 1)
    double power = 0.0;  ///< lm, of the light
    double count = 0.0;  ///< of rays that the light has
};

LitPlace cast_light_ray(const LightingContext& context, const BoundingSphere& target, RayTask& task,
                        const LightRay& light_ray, RandomStream& random) {
    const LightSet& lights = context.lights;
    const int light = light_ray.light;
    double power = light_ray.power;
    const int after = light - static_cast<int>(lights.emitters.size());
    const PunctualLight* punctual =
        after >= 0 && after < std::ssize(lights.punctual) ? &lights.punctual[after] : nullptr;
    const bool spreads = punctual != nullptr && punctual->kind != Light::Kind::directional;
    Ray ray;
    if (after < 0) {
        ray = leave_emitter(context.shading, lights.emitters[light], light_ray.place, random);
    } else if (spreads) {
        ray = leave_punctual(*punctual, random);
    } else {
        ray = come_from_afar(context, target, punctual, random, power);
        if (power == 0.0) return {};
    }
    Rgb passed(1.0f);
    const glm::vec3 origin = ray.origin;
    const Hit hit = find_beyond_sheets(context, task, ray, passed, task.counts.gather);
    if (hit.instance == no_index || !std::isfinite(power)) return {};
    const SurfacePoint met = make_surface_point(context.shading, hit, ray.direction);
    const glm::vec3 side = place_triangle(context.shading.instances[hit.instance], hit.primitive).normal;
    const SurfaceMaterial material = evaluate_material(context.shading, met, {});
    if (spreads) {
        // A spot's light fades towards its edge, and all of it towards its range.
        const LightSample sample = sample_light(context.shading, lights, light, {met.position, met.normal}, {});
        const glm::dvec3 to = glm::dvec3(met.position) - glm::dvec3(origin);
        power = luminance(sample.incoming) * glm::dot(to, to) * find_solid_angle(*punctual);
    }
    return {hit.instance,
            hit.primitive,
            glm::dot(side, ray.direction) > 0.0f,
            {hit.u, hit.v},
            power / light_ray.count * luminance(passed * (material.diffuse + material.gloss.f0))};
}

}  // namespace

std::vector<LitPlace> cast_light_rays(const LightingContext& context, const BoundingSphere& target, std::size_t count,
                                      RayCounts& counts) {
    const std::vector<double> powers = find_powers(context, target);
    const double total = std::accumulate(powers.begin(), powers.end(), 0.0);
    if (!(total > 0.0) || !std::isfinite(total)) return {};
    std::vector<double> shares, ends(powers.size());
    for (const double power : powers)
        shares.push_back(0.5 * (power / total + 1.0 / static_cast<double>(powers.size())));
    std::partial_sum(shares.begin(), shares.end(), ends.begin());
    std::vector<LitPlace> places(count);
    cast_parallel(count, 256, context.rays, counts, [&](int i, RayTask& task) {
        RandomStream random({light_ray_key, 0, 0, static_cast<std::uint32_t>(i)});
        const double number = (i + random.next()) / static_cast<double>(count);
        const auto light =
            std::min<std::ptrdiff_t>(std::ranges::upper_bound(ends, number) - ends.begin(), std::ssize(ends) - 1);
        const LightRay ray{.light = static_cast<int>(light),
                           .place = static_cast<float>((number - ends[light]) / shares[light] + 1.0),
                           .power = powers[light],
                           .count = shares[light] * static_cast<double>(count)};
        places[i] = cast_light_ray(context, target, task, ray, random);
    });
    return places;
}

}  // namespace aleph
