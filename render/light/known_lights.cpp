#include "render/light/known_lights.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "engine/base/sampling.h"
#include "render/light/find_sky_openings.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

namespace {

constexpr int all_places = 1024, many_places = 64, few_places = 8;
constexpr int few_test_rays = 1 << 14, most_test_rays = 1 << 18;
constexpr float most_share = 0.5f;
constexpr std::uint32_t met_key = 0x6d657473u;  // no other random numbers have it

/// Illuminance that a light brings to the places, in the mean.
struct Reach {
    double without_shadows = 0.0;
    bool seen = false;  ///< by a place, or it brings nothing to any of them
};

std::vector<ViewedSurface> find_seen_places(const LightingContext& context, const CameraView& view,
                                            const SampleHits& centers, int count) {
    std::vector<ViewedSurface> places;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 place = lattice_point(i, count, {0.0f, 0.5f}) * glm::vec2(view.width, view.height);
        const auto x = static_cast<int>(place.x), y = static_cast<int>(place.y);
        if (centers.hits(x, y).instance != no_index)
            places.push_back(make_pixel_surface(context.shading, view, centers, x, y));
    }
    return places;
}

/// Those that a ray by cosine from each of these meets.
std::vector<ViewedSurface> find_met_places(const LightingContext& context, const std::vector<ViewedSurface>& places,
                                           RayCounts& counts) {
    std::vector<std::optional<ViewedSurface>> met(places.size());
    cast_parallel(places.size(), 64, context.rays, counts, [&](int i, RayTask& task) {
        const SurfacePoint& from = places[i].point;
        RandomStream random({met_key, 0, static_cast<std::uint32_t>(i), 0});
        Ray ray{from.ray_origin(), make_basis(from.normal).to_world(sample_cosine_hemisphere(random.next_2d()))};
        if (!(glm::dot(ray.direction, from.geometric) > 0.0f)) return;
        Rgb passed(1.0f);
        const Hit hit = find_beyond_sheets(context, task, ray, passed, task.counts.shadow);
        if (hit.instance == no_index) return;
        met[i] =
            view_surface(context.shading, make_surface_point(context.shading, hit, ray.direction), -ray.direction, {});
    });
    std::vector<ViewedSurface> found;
    for (const std::optional<ViewedSurface>& place : met)
        if (place) found.push_back(*place);
    return found;
}

Reach find_reach(const LightingContext& context, RayTask& task, const std::vector<ViewedSurface>& places, int light) {
    Reach reach;
    const auto count = static_cast<int>(places.size());
    for (int i = 0; i < count; ++i) {
        const LitSurface lit(places[i]);
        const Receiver receiver = make_receiver(context, lit);
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

std::vector<Reach> find_reaches(const LightingContext& context, const std::vector<ViewedSurface>& places,
                                RayCounts& counts) {
    std::vector<Reach> reaches(static_cast<std::size_t>(context.lights.count()));
    cast_parallel(reaches.size(), 4, context.rays, counts,
                  [&](int light, RayTask& task) { reaches[light] = find_reach(context, task, places, light); });
    return reaches;
}

HiddenLights list_hidden(const LightingContext& context, const std::vector<Reach>& reaches, std::size_t places) {
    double seen = 0.0, hidden = 0.0;
    for (const Reach& reach : reaches) (reach.seen ? seen : hidden) += reach.without_shadows;
    HiddenLights found;
    found.share = std::min(most_share, 2.0f / std::sqrt(static_cast<float>(places)));
    if (!(seen > 0.0 && found.share * seen < hidden)) return {};  // also where one of them is not a number
    found.scale = std::max(static_cast<float>(found.share * seen / hidden), 1e-12f);
    found.which.resize(context.shading.instances.size() + context.shading.pose->lights.size() + 1);
    for (std::size_t i = 0; i < reaches.size(); ++i)
        found.which[place_of(context.shading, context.lights, i)] = !reaches[i].seen;
    return found;
}

/// Keeps those that are hidden in both.
void keep_hidden(const HiddenLights& other, HiddenLights& hidden) {
    for (std::size_t i = 0; i < hidden.which.size(); ++i)
        hidden.which[i] = hidden.which[i] && !other.empty() && other.which[i];
    if (std::ranges::none_of(hidden.which, std::identity{})) hidden = {};
}

/// A tree in which the strength of lights is multiplied by one of two factors.
LightTree make_tree_of_parts(const ShadingScene& shading, const LightSet& lights, const HiddenLights& hidden,
                             float of_hidden, float of_others) {
    std::vector<LightNode> nodes = make_light_nodes(shading, lights);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const float factor = hidden.which[place_of(shading, lights, i)] ? of_hidden : of_others;
        nodes[i].strength *= factor;
        nodes[i].most = factor == 0.0f ? 0.0f : nodes[i].most * factor;  // it may be infinite
    }
    return make_light_tree(nodes);
}

}  // namespace

KnownLights find_known_lights(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              RayCounts& counts) {
    KnownLights known;
    known.openings = find_sky_openings(context, view, centers, counts);
    const int count = context.lights.count();
    if (count < 2 || count * few_places > most_test_rays) return known;
    LightingContext lighting = context;
    if (known.openings) lighting.openings = &*known.openings;
    const int wanted = std::min(std::clamp(few_test_rays / count, many_places, all_places), most_test_rays / count);
    const std::vector<ViewedSurface> seen = find_seen_places(lighting, view, centers, wanted);
    const std::vector<ViewedSurface> met = find_met_places(lighting, seen, counts);
    const std::vector<Reach> at_seen = find_reaches(lighting, seen, counts);
    std::vector<Reach> at_met = find_reaches(lighting, met, counts);
    // Rays meet what the camera sees, too.
    for (std::size_t i = 0; i < at_met.size(); ++i)
        at_met[i].seen = at_met[i].seen || (at_seen[i].seen && at_seen[i].without_shadows > 0.0);
    known.unseen = list_hidden(lighting, at_seen, seen.size());
    known.unmet = list_hidden(lighting, at_met, met.size());
    return known;
}

void add_known_lights(const KnownLights& other, const glm::vec3& shift, KnownLights& known) {
    if (other.openings) {
        SkyOpenings there = *other.openings;
        move_openings(shift, there);
        add_openings(there, known.openings);
    }
    keep_hidden(other.unseen, known.unseen);
    keep_hidden(other.unmet, known.unmet);
}

KnownLightTrees::KnownLightTrees(const ShadingScene& shading, const LightSet& lights, const KnownLights& known) {
    if (!known.unseen.empty()) {
        seen.share = known.unseen.share;
        seen.others = make_tree_of_parts(shading, lights, known.unseen, 0.0f, 1.0f);
        seen.hidden = make_tree_of_parts(shading, lights, known.unseen, 1.0f, 0.0f);
    }
    if (!known.unmet.empty()) met = make_tree_of_parts(shading, lights, known.unmet, known.unmet.scale, 1.0f);
}

}  // namespace aleph
