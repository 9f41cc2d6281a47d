#include "render/light/light_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/base/sampling.h"
#include "render/surface/surface_material.h"

namespace aleph {

namespace {

constexpr std::uint32_t light_ray_key = 0x62726967u;  // no other random numbers have it

constexpr float whole_sphere = 2.0f;  // versine of the directions of a point light

float find_cone(const PunctualLight& light) {
    return light.kind == Light::Kind::spot ? light.outer_versine : whole_sphere;
}

/// A light that casts rays.
struct Source {
    int light = 0;
    double power = 0.0;  ///< lm
};

std::vector<Source> list_sources(const LightSet& lights) {
    std::vector<Source> sources;
    int index = 0;
    for (const Emitter& emitter : lights.emitters) {
        const double sides = emitter.double_sided ? 2.0 : 1.0;
        sources.push_back({index++, std::numbers::pi * luminance(emitter.brightest) * emitter.area * sides});
    }
    for (const PunctualLight& light : lights.punctual) {
        const double power = 2.0 * std::numbers::pi * find_cone(light) * luminance(light.intensity);
        if (light.kind != Light::Kind::directional) sources.push_back({index, power});
        ++index;
    }
    return sources;
}

Ray leave_emitter(const ShadingScene& shading, const Emitter& emitter, float place, RandomStream& random) {
    const auto end = std::ranges::upper_bound(emitter.cumulative_area, place);
    const auto i = std::min<std::ptrdiff_t>(end - emitter.cumulative_area.begin(), std::ssize(emitter.triangles) - 1);
    const Emitter::Triangle& t = emitter.triangles[static_cast<std::size_t>(i)];
    const glm::vec2 b = sample_triangle(random.next_2d());
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

/// Casts one light ray.
/// @param place  of the ray among those of its source, in [0, 1)
/// @param count  of rays that the source has
LitPlace cast_light_ray(const LightingContext& context, RayTask& task, const Source& source, float place, double count,
                        RandomStream& random) {
    const LightSet& lights = context.lights;
    const int punctual = source.light - static_cast<int>(lights.emitters.size());
    const Ray ray = punctual < 0 ? leave_emitter(context.shading, lights.emitters[source.light], place, random)
                                 : leave_punctual(lights.punctual[punctual], random);
    ++task.counts.gather;
    const Hit hit = task.tracer.intersect(ray);
    if (hit.instance == no_index) return {};
    const SurfacePoint met = make_surface_point(context.shading, hit, ray.direction);
    const glm::vec3 side = place_triangle(context.shading.instances[hit.instance], hit.primitive).normal;
    const SurfaceMaterial material = evaluate_material(context.shading, met, {});
    double brought = source.power / count;
    if (punctual >= 0) {
        // The light of a spot fades towards its edge, and that of any towards its range.
        const LightSample sample = sample_light(context.shading, lights, source.light, {met.position, met.normal}, {});
        const double solid_angle = 2.0 * std::numbers::pi * find_cone(lights.punctual[punctual]);
        const double distance = hit.distance;
        brought = luminance(sample.incoming) * distance * distance * solid_angle / count;
    }
    return {hit.instance,
            hit.primitive,
            glm::dot(side, ray.direction) > 0.0f,
            {hit.u, hit.v},
            brought * luminance(material.diffuse + material.gloss.f0)};
}

}  // namespace

std::vector<LitPlace> cast_light_rays(const LightingContext& context, std::size_t count, RayCounts& counts) {
    const std::vector<Source> sources = list_sources(context.lights);
    double total = 0.0;
    for (const Source& source : sources) total += source.power;
    if (!(total > 0.0) || !std::isfinite(total)) return {};
    std::vector<double> shares, ends;
    for (const Source& source : sources) {
        shares.push_back(0.5 * (source.power / total + 1.0 / static_cast<double>(sources.size())));
    }
    ends.resize(shares.size());
    std::partial_sum(shares.begin(), shares.end(), ends.begin());
    std::vector<LitPlace> places(count);
    cast_parallel(count, 256, context.rays, counts, [&](int i, RayTask& task) {
        RandomStream random({light_ray_key, 0, 0, static_cast<std::uint32_t>(i)});
        const double number = (i + random.next()) / static_cast<double>(count);
        const auto s =
            std::min<std::ptrdiff_t>(std::ranges::upper_bound(ends, number) - ends.begin(), std::ssize(ends) - 1);
        const double place = (number - ends[s]) / shares[s] + 1.0;
        places[i] = cast_light_ray(context, task, sources[s], static_cast<float>(place),
                                   shares[s] * static_cast<double>(count), random);
    });
    return places;
}

}  // namespace aleph
