#include "render/time/shutter_shadows.h"

#include <algorithm>
#include <cmath>

#include "render/settings/numbers.h"

namespace aleph {

namespace {

/// A lamp, a point or a spot; m, in the frame's coordinates.
struct ShadowedLight {
    BoundingSphere sphere;
    int instance = no_index, node = no_index;
    float area = 0.0f;                  ///< m2; 0: none
    const LightValues* cone = nullptr;  ///< of a spot

    bool is(const ShutterMover& mover) const {
        return instance != no_index ? mover.instance == instance : node != no_index && mover.light == node;
    }
};

std::vector<ShadowedLight> list_lights(const ShadingScene& frame) {
    std::vector<ShadowedLight> lights;
    for (const int i : frame.emitting) {
        const PosedInstance& lamp = frame.instances[i];
        if (!lamp.visible) continue;
        const MeshBounds bounds = find_bounds(lamp);
        lights.push_back({.sphere = bounds.sphere, .instance = i, .area = bounds.area});
    }
    for (const LightValues& light : frame.pose->lights) {
        if (light.kind == Light::Kind::directional) continue;
        lights.push_back({.sphere = {glm::vec3(light.position - frame.anchor), 0.0f},
                          .node = light.node,
                          .cone = light.kind == Light::Kind::spot ? &light : nullptr});
    }
    return lights;
}

/// m: how far a thing moves past a light, which may move along.
float find_way_past(const ShutterMover& mover, const ShutterMover* light) {
    if (light == nullptr || !(mover.moved < infinite)) return mover.moved;
    const glm::vec3 way = mover.centers[1] - mover.centers[0] - (light->centers[1] - light->centers[0]);
    return glm::length(way) + mover.bent + std::abs(mover.turned - light->turned) * mover.radius;
}

/// Share of a spot's light, over that of a light of all directions, that a thing may hide; 0 beside its cone.
float find_cone_gain(const LightValues& spot, const ShutterMover& mover, const glm::vec3& position) {
    const auto outer = static_cast<float>(spot.outer_cone);
    const auto is_beside = [&](const glm::vec3& center) {
        const glm::vec3 to = center - position;
        const float distance = glm::length(to);
        if (!(distance > mover.radius)) return false;
        const float cosine = glm::dot(to, glm::vec3(spot.direction)) / distance;
        return std::acos(std::clamp(cosine, -1.0f, 1.0f)) > outer + std::asin(mover.radius / distance);
    };
    if (is_beside(mover.centers[0]) && is_beside(mover.centers[1])) return 0.0f;
    const float sine = outer < 0.5f * pi ? std::sin(outer) : 1.0f;
    return sine > 0.0f ? 1.0f / (sine * sine) : infinite;
}

/// Share of a light that a thing hides at one of the times alone.
float find_change(const ShadowedLight& light, const ShutterMover& mover, const ShutterMover* own) {
    const glm::vec3& from = light.sphere.center;
    const glm::vec3 to = own == nullptr ? from : from + own->centers[1] - own->centers[0];
    const float apart = std::min(glm::distance(mover.centers[0], from), glm::distance(mover.centers[1], to));
    const float distance = std::max(0.0f, apart - light.sphere.radius);
    float hidden = find_hidden_share(mover.radius, distance);
    if (light.area > 0.0f) hidden = std::min(hidden, 2.0f * pi * mover.radius * mover.radius / light.area);
    if (light.cone != nullptr) hidden *= find_cone_gain(*light.cone, mover, from);
    const float way = find_way_past(mover, own),
                scale = std::max(distance, std::min(mover.radius, light.sphere.radius));
    const float steps = way > 0.0f ? 3.0f * way / scale : 0.0f;
    return std::min(1.0f, hidden) * std::min(1.0f, steps + mover.faded);
}

}  // namespace

float find_shadow_change(const ShadingScene& frame, const std::vector<ShutterMover>& movers) {
    const auto hides = [](const ShutterMover& mover) { return mover.radius > 0.0f; };
    if (std::ranges::none_of(movers, hides)) return 0.0f;
    float most = 0.0f;
    for (const ShadowedLight& light : list_lights(frame)) {
        const auto own = std::ranges::find_if(movers, [&](const ShutterMover& mover) { return light.is(mover); });
        float change = 0.0f;
        for (const ShutterMover& mover : movers) {
            if (hides(mover) && !light.is(mover))
                change += find_change(light, mover, own == movers.end() ? nullptr : &*own);
        }
        most = std::max(most, change);
    }
    return most;
}

float find_sunlight_change(const ShadingScene& frame, const std::vector<ShutterMover>& movers,
                           const glm::vec3& position, const glm::vec3& moved, int instance, float enough) {
    float change = 0.0f;
    for (const LightValues& light : frame.pose->lights) {
        if (light.kind != Light::Kind::directional) continue;
        const glm::vec3 along(light.direction);
        const auto find_distance = [&](const glm::vec3& from, const glm::vec3& to) {
            return glm::length(to - from - std::max(0.0f, glm::dot(to - from, along)) * along);
        };
        for (const ShutterMover& mover : movers) {
            if (!(mover.radius > 0.0f) || mover.instance == instance) continue;
            const float distance =
                std::min(find_distance(mover.centers[0], position), find_distance(mover.centers[1], position + moved));
            const float way = mover.moved + glm::length(moved), steps = way > 0.0f ? 3.0f * way / distance : 0.0f;
            change += find_hidden_share(mover.radius, distance) * std::min(1.0f, steps + mover.faded);
            if (change > enough) return change;
        }
    }
    return change;
}

}  // namespace aleph
