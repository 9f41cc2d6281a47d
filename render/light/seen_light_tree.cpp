#include "render/light/seen_light_tree.h"

#include <algorithm>
#include <cmath>

#include "render/light/light_cut.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

namespace {

constexpr int many_places = 64, few_places = 8;
constexpr int most_test_rays = 1 << 18;
constexpr double hidden_share = 0.25;  // of what the lights that are seen bring

/// Illuminance that a light brings to the places, in the mean.
struct Reach {
    double without_shadows = 0.0;
    bool seen = false;  ///< by a place, or it brings nothing to any of them
};

std::vector<PixelSurface> find_places(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                      int count) {
    std::vector<PixelSurface> places;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 place = lattice_point(i, count, {0.0f, 0.5f}) * glm::vec2(view.width, view.height);
        const auto x = static_cast<int>(place.x), y = static_cast<int>(place.y);
        if (centers.hits(x, y).instance != no_index)
            places.push_back(make_pixel_surface(context.shading, view, centers, x, y));
    }
    return places;
}

Reach find_reach(const LightingContext& context, RayTask& task, const std::vector<PixelSurface>& places, int light) {
    Reach reach;
    const auto count = static_cast<int>(places.size());
    for (int i = 0; i < count; ++i) {
        const LitSurface lit(places[i]);
        const Receiver receiver{lit.point.ray_origin(), lit.point.normal, lit.material.has_glass()};
        const LightSample sample = sample_light(context.shading, context.lights, light, receiver,
                                                lattice_point(i, count, {0.25f, 0.75f}), 1.0f);
        if (sample.incoming == Rgb(0.0f) || !lit.is_reached(sample.direction)) continue;
        reach.without_shadows +=
            luminance(sample.incoming) * std::abs(glm::dot(receiver.normal, sample.direction)) / count;
        if (!reach.seen)
            reach.seen = !context.shading.needs_shadow_ray(sample.pdf) ||
                         find_transmittance(context, task, make_shadow_ray(lit, sample)) != Rgb(0.0f);
    }
    reach.seen = reach.seen || reach.without_shadows == 0.0;
    return reach;
}

/// Into HiddenLights::which.
std::size_t place_of(const ShadingScene& shading, const LightSet& lights, std::size_t light) {
    const std::size_t emitters = lights.emitters.size(), instances = shading.instances.size();
    if (light < emitters) return static_cast<std::size_t>(lights.emitters[light].instance);
    if (light - emitters < lights.punctual.size())
        return instances + static_cast<std::size_t>(lights.punctual[light - emitters].index);
    return instances + shading.pose->lights.size();
}

}  // namespace

HiddenLights find_hidden_lights(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                RayCounts& counts) {
    const int count = context.lights.count();
    const int wanted = std::min(many_places, most_test_rays / std::max(count, 1));
    if (count <= LightCut::few || wanted < few_places) return {};
    const std::vector<PixelSurface> places = find_places(context, view, centers, wanted);
    std::vector<Reach> reaches(static_cast<std::size_t>(count));
    cast_parallel(reaches.size(), 64, context.rays, counts,
                  [&](int light, RayTask& task) { reaches[light] = find_reach(context, task, places, light); });
    double seen = 0.0, hidden = 0.0;
    for (const Reach& reach : reaches) (reach.seen ? seen : hidden) += reach.without_shadows;
    if (!(seen > 0.0 && hidden_share * seen < hidden)) return {};  // also where one of them is not a number
    HiddenLights found;
    found.scale = std::max(static_cast<float>(hidden_share * seen / hidden), 1e-12f);
    found.which.resize(context.shading.instances.size() + context.shading.pose->lights.size() + 1);
    for (std::size_t i = 0; i < reaches.size(); ++i)
        found.which[place_of(context.shading, context.lights, i)] = !reaches[i].seen;
    return found;
}

LightTree make_seen_light_tree(const ShadingScene& shading, const LightSet& lights, const HiddenLights& hidden) {
    if (hidden.empty()) return {};
    std::vector<LightNode> nodes = make_light_nodes(shading, lights);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!hidden.which[place_of(shading, lights, i)]) continue;
        nodes[i].strength *= hidden.scale;
        nodes[i].most *= hidden.scale;
    }
    return make_light_tree(nodes);
}

}  // namespace aleph
