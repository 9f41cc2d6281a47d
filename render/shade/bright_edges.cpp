#include "render/shade/bright_edges.h"

#include <array>

#include "engine/base/pixel_loops.h"
#include "engine/rays/first_hits.h"

namespace aleph {

namespace {

constexpr double bright = 0.5;  // of white
constexpr int reach = 2;        // pixels, of filters
constexpr int rays_of_a_sample = 16;
constexpr double small_lamp = 1.5;  // pixels, largest radius of lamps that the pixels' centres may miss
constexpr std::uint32_t edge_key_mask = 0x65646765u;  // apart from the samples' own places

/// @param direction  of the ray that met it
bool is_bright(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction, double exposure) {
    if (hit.instance == no_index) return luminance(environment_radiance(shading, direction)) * exposure >= bright;
    const ShadingMaterial& material = shading.materials[shading.instances[hit.instance].material];
    return material.emits && luminance(material.values.emission) * exposure >= bright;
}

/// Marks the pixels that small lamps lie in, whether something hides them or not.
/// @param seen  with a margin of `reach` pixels around the picture
void mark_small_lamps(const LightingContext& context, const CameraView& view, double exposure,
                      Image<std::uint8_t>& seen) {
    for (const Emitter& lamp : context.lights.emitters) {
        if (luminance(lamp.brightest) * exposure < bright) continue;
        const glm::dvec3 center = context.shading.anchor + glm::dvec3(lamp.center);
        const std::optional<glm::dvec2> at = project_small_sphere(view, center, lamp.radius, small_lamp);
        if (!at) continue;
        const glm::dvec2 place = *at + static_cast<double>(reach);
        if (!(place.x >= 0.0 && place.x < seen.width && place.y >= 0.0 && place.y < seen.height)) continue;
        seen(static_cast<int>(place.x), static_cast<int>(place.y)) = 1;
    }
}

}  // namespace

Image<std::uint8_t> find_bright_edges(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                      double exposure, std::uint64_t& rays_cast) {
    const int width = centers.hits.width, height = centers.hits.height;
    Image<std::uint8_t> edges(width, height), seen(width + 2 * reach, height + 2 * reach);
    const auto make_ray = [&](int x, int y) { return make_sample_ray(view, centers.place, x, y); };
    const auto mark = [&](int left, int top, const Image<Hit>& hits) {
        parallel_pixels(hits, 16, [&](int x, int y) {
            const glm::vec3 direction(make_ray(left + x, top + y).direction);
            seen(left + x + reach, top + y + reach) = is_bright(context.shading, hits(x, y), direction, exposure);
        });
    };
    mark(0, 0, centers.hits);
    // Filters of the outermost pixels reach beyond the picture.
    for (const auto& [left, top, columns, rows] :
         {std::array{-reach, -reach, width + 2 * reach, reach}, std::array{-reach, height, width + 2 * reach, reach},
          std::array{-reach, 0, reach, height}, std::array{width, 0, reach, height}}) {
        Image<Hit> hits(columns, rows);
        cast_rays(
            context.rays, [&](int x, int y) { return make_ray(left + x, top + y); }, centers.place.blend, hits);
        rays_cast += hits.size();
        mark(left, top, hits);
    }
    mark_small_lamps(context, view, exposure, seen);
    parallel_pixels(edges, 16, [&](int x, int y) {
        bool any = false, all = true;
        visit_around(seen, x + reach, y + reach, reach, [&](int nx, int ny) {
            any = any || seen(nx, ny) != 0;
            all = all && seen(nx, ny) != 0;
        });
        edges(x, y) = any && !all ? 1 : 0;
    });
    return edges;
}

Rgb light_seen(const SampleScene& scene, ShadingTask& task, const SamplePlace& place, const Hit& hit,
               const glm::vec3& direction, const glm::ivec2& pixel) {
    const ShadingScene& shading = scene.lighting.shading;
    if (hit.instance == no_index) return environment_radiance(shading, direction);
    const ShadingMaterial& material = shading.materials[shading.instances[hit.instance].material];
    if (!material.emits) return Rgb(0.0f);
    const PixelSurface surface = make_pixel_surface(shading, scene.view, place, hit, direction, pixel);
    return surface.material.emission * share_left(scene_before(scene, task, surface).lighting.around, surface);
}

Rgb average_light_seen(const SampleScene& scene, ShadingTask& task, const SamplePlace& place, const glm::ivec2& pixel) {
    SamplePlace own = place;
    own.noise_key ^= edge_key_mask;
    std::array<Ray, rays_of_a_sample> rays;
    std::array<Hit, rays_of_a_sample> hits;
    for (int i = 0; i < rays_of_a_sample; ++i) {
        own.index = place.index * rays_of_a_sample + i;
        rays[i] = to_scene(scene.lighting.rays, make_sample_ray(scene.view, own, pixel.x, pixel.y));
    }
    task.tracer.intersect(rays, hits);
    task.counts.primary += rays_of_a_sample;
    Rgb sum(0.0f);
    for (int i = 0; i < rays_of_a_sample; ++i) sum += light_seen(scene, task, place, hits[i], rays[i].direction, pixel);
    return sum / static_cast<float>(rays_of_a_sample);
}

}  // namespace aleph
