#include "render/cache/multi_bounce_light.h"

#include <numbers>

#include "render/cache/irradiance_cache.h"
#include "render/path/path.h"
#include "render/surface/bsdf.h"

namespace aleph {

std::optional<Rgb> find_cached_irradiance(RayTask& task, const SurfacePlace& point,
                                          const MultiBounceLight& multi_bounce) {
    if (multi_bounce.cache == nullptr) return std::nullopt;
    CacheQuery query{point.position, point.normal, multi_bounce.accuracy, &task};
    std::optional<Rgb> found = multi_bounce.cache->interpolate(query);
    if (found) return found;
    query.accuracy = gap_reach * multi_bounce.accuracy;
    return multi_bounce.cache->interpolate(query);
}

/// Lamps that the ray meets, or sees straight through sheets of glass, are direct light of the point.
Rgb sample_multi_bounce_irradiance(const LightingContext& context, RayTask& task, const SurfacePlace& point,
                                   const SurfaceMaterial* material, const MultiBounceLight& multi_bounce, int depth,
                                   RandomStream& random) {
    if (multi_bounce.bounces <= 0) return Rgb(0.0f);
    const glm::vec3 local = sample_cosine_hemisphere(random.next_2d());
    const glm::vec3 direction = make_basis(point.normal).to_world(local);
    if (!(glm::dot(direction, point.geometric) > 0.0f)) return Rgb(0.0f);
    ++task.counts.multi_bounce;
    PathState state;
    state.left = {multi_bounce.bounces - 1, depth};
    // Where a cache knows most of this light, long paths would cost more than all the rest.
    if (multi_bounce.cache != nullptr) state.roulette_after = 0;
    state.turned = true;
    state.emission = EmissionWeight::none;
    state.media = context.around;
    const float enters = material == nullptr ? 1.0f : relative_transmission(*material, local.z);
    return enters * std::numbers::pi_v<float> *
           follow_ray(context, task, {point.ray_origin(), direction}, state, random);
}

}  // namespace aleph
