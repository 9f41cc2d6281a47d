#include "render/cache/aimed_rays.h"

#include <algorithm>
#include <cmath>

#include "render/settings/numbers.h"

namespace aleph {

namespace {

/// Adds the change of light from a point of a bright surface, without that of what is hidden.
/// @param to      m, to that point
/// @param bright  normal there
void add_gradients(const Rgb& light, const glm::vec3& to, const glm::vec3& normal, const glm::vec3& bright,
                   IrradianceGradients& gradients) {
    const float along = glm::dot(normal, to);
    // The change of both cosines over the squared distance, relative, is taken in the tangent plane.
    glm::vec3 moved = 4.0f * to / glm::dot(to, to) - bright / glm::dot(bright, to) - normal / along;
    moved -= normal * glm::dot(normal, moved);
    const glm::vec3 turned = glm::cross(normal, to) / along;
    for (int c = 0; c < 3; ++c) {
        gradients.translation[c] += light[c] * moved;
        gradients.rotation[c] += light[c] * turned;
    }
}

}  // namespace

BrightSurfaces find_bright_surfaces(const LightingContext& lighting, const std::vector<PixelSurface>& seen,
                                    RayCounts& counts) {
    std::vector<Receiver> places;
    places.reserve(seen.size());
    for (const PixelSurface& surface : seen) places.push_back({surface.point.position, surface.point.normal});
    return find_bright_surfaces(lighting, std::span<const Receiver>(places), counts);
}

void aim_rays(const BrightSampler& sampler, const SurfacePlace& point, RandomStream& random, GatherScratch& scratch) {
    for (int i = 0; i < scratch.aims; ++i) {
        const float choice = (static_cast<float>(i) + random.next()) / static_cast<float>(scratch.aims);
        const BrightSampler::Aim aim = sampler.aim({choice, random.next_2d()});
        if (aim.patch == no_index || !(glm::dot(aim.direction, point.geometric) > 0.0f)) continue;
        scratch.rays.push_back({point.ray_origin(), aim.direction});
        scratch.places.push_back({0, i, 0});  // for its light numbers
        scratch.aimed.push_back(aim);
    }
    scratch.hits.resize(scratch.rays.size());
    scratch.normals.resize(scratch.rays.size());
}

void weigh_rays(const BrightSampler& sampler, GatherScratch& scratch) {
    const std::size_t around = scratch.rays_around();
    scratch.weights.resize(scratch.rays.size());
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const int patch = i < around ? no_index : scratch.aimed[i - around].patch;
        scratch.weights[i] = sampler.weigh(scratch.hits[i], scratch.rays[i].direction, patch);
        if (patch != no_index && scratch.weights[i] == 0.0f) scratch.hits[i].instance = no_index;
    }
}

void add_aimed(const glm::vec3& normal, const GatherScratch& scratch, IrradianceSample& out) {
    const std::size_t around = scratch.rays_around();
    const float per_ray = pi / static_cast<float>(scratch.strata.count());
    const double error = out.relative_error * luminance(out.irradiance);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = around; i < scratch.rays.size(); ++i) {
        const Rgb light = scratch.light[i] * per_ray;
        if (light == Rgb(0.0f)) continue;
        const double brightness = luminance(light);
        sum += brightness;
        squares += brightness * brightness;
        out.irradiance += light;
        add_gradients(light, scratch.rays[i].direction * scratch.hits[i].distance, normal,
                      scratch.aimed[i - around].normal, out.gradients);
    }
    out.rays += scratch.aims;
    const double brightness = luminance(out.irradiance), variance = std::max(0.0, squares - sum * sum / scratch.aims);
    if (brightness > 0.0 && std::isfinite(out.relative_error))
        out.relative_error = static_cast<float>(std::sqrt(error * error + variance) / brightness);
}

}  // namespace aleph
