// Things and lights that differ between two poses of a scene while the shutter is open.

#include <algorithm>
#include <cmath>

#include "render/settings/numbers.h"
#include "render/time/shutter_light.h"

namespace aleph {

namespace {

bool is_at_rest(const PosedInstance& frame, const PosedInstance& sample, const glm::vec3& shift) {
    if (frame.visible != sample.visible) return false;
    if (!frame.visible) return true;
    if (frame.flat && sample.flat) return true;
    if (frame.deformed != nullptr || sample.deformed != nullptr || frame.linear != sample.linear) return false;
    // Coordinates relative to another anchor are rounded anew.
    const glm::vec3 place = sample.translation + shift;
    const glm::vec3 size = glm::abs(frame.translation) + glm::abs(sample.translation) + glm::abs(shift);
    return glm::length(place - frame.translation) <= 1e-6f * glm::length(size);
}

/// m: no less than any vertex moves.
float find_longest_way(const PosedInstance& frame, const PosedInstance& sample, const glm::vec3& shift) {
    float way = 0.0f;
    if (frame.deformed == nullptr && sample.deformed == nullptr) {
        // How far a point moves is convex in its place.
        const BoundingBox& box = frame.bounds->box;
        const glm::mat3 linear = sample.linear - frame.linear;
        const glm::vec3 translation = sample.translation + shift - frame.translation;
        for (int k = 0; k < 8; ++k) way = std::max(way, glm::length(linear * box.corner(k) + translation));
        return way;
    }
    for (std::uint32_t v = 0; v < frame.mesh->positions.size(); ++v) {
        way = std::max(way, glm::length(sample.place(v) + shift - frame.place(v)));
    }
    return way;
}

float find_turn(const glm::mat3& from, const glm::mat3& to) {
    float turn = 0.0f;
    for (int i = 0; i < 3; ++i) turn = std::max(turn, glm::length(to[i] - from[i]) / glm::length(from[i]));
    return turn;
}

/// As find_turn, of a lamp that deforms: it shines by the areas of its triangles and by the directions that they face.
float find_bend(const PosedInstance& from, const PosedInstance& to) {
    const auto area = [](const PosedInstance& instance, const glm::uvec3& t) {
        const glm::vec3 corner = instance.place(t.x);
        return glm::cross(instance.place(t.y) - corner, instance.place(t.z) - corner);
    };
    float changed = 0.0f, whole = 0.0f;
    for (const glm::uvec3& t : from.mesh->triangles) {
        changed += glm::length(area(to, t) - area(from, t));
        whole += glm::length(area(from, t));
    }
    return whole > 0.0f ? changed / whole : infinite;
}

/// Share of the larger of two that they differ by.
float find_difference(const Rgb& a, const Rgb& b) {
    const float largest = largest_channel(glm::max(a, b));
    return largest > 0.0f ? largest_channel(glm::abs(a - b)) / largest : 0.0f;
}

float find_difference(float a, float b) {
    return find_difference(Rgb(a), Rgb(b));
}

/// Share of what a surface reflects or lets pass that may differ between two times, about: of the value that differs
/// most. Where alpha decides what is there at all, any change of it counts as 1.
float find_fade(const ShadingMaterial& from, const ShadingMaterial& to) {
    const MaterialValues &a = from.values, &b = to.values;
    if (a == b) return 0.0f;
    const bool masked = from.material != nullptr && from.material->opacity.mode == Opacity::Mode::mask;
    if (masked && a.alpha != b.alpha) return 1.0f;
    return std::max(
        {find_difference(a.base_color, b.base_color), find_difference(a.alpha, b.alpha),
         find_difference(a.gloss.metallic, b.gloss.metallic), find_difference(a.gloss.roughness, b.gloss.roughness),
         find_difference(a.gloss.specular, b.gloss.specular),
         find_difference(a.gloss.specular_color, b.gloss.specular_color), find_difference(a.gloss.ior, b.gloss.ior),
         find_difference(a.glass.transmission, b.glass.transmission),
         find_difference(a.glass.thickness, b.glass.thickness),
         find_difference(a.glass.attenuation_distance, b.glass.attenuation_distance),
         find_difference(a.glass.attenuation_color, b.glass.attenuation_color),
         find_difference(a.layers.clearcoat, b.layers.clearcoat),
         find_difference(a.layers.clearcoat_roughness, b.layers.clearcoat_roughness),
         find_difference(a.layers.sheen_color, b.layers.sheen_color),
         find_difference(a.layers.sheen_roughness, b.layers.sheen_roughness),
         find_difference(a.layers.anisotropy, b.layers.anisotropy),
         find_difference(a.layers.anisotropy_rotation, b.layers.anisotropy_rotation)});
}

const glm::vec3 far_away(infinite);

/// Light `i` of one pose in another. Poses have the lights of visible nodes alone: where it is hidden, it is dark.
LightValues find_light(const std::vector<LightValues>& lights, std::size_t i, const LightValues& light) {
    if (i < lights.size() && lights[i].node == light.node) return lights[i];
    const auto found = std::ranges::find(lights, light.node, &LightValues::node);
    if (found != lights.end()) return *found;
    LightValues dark = light;
    dark.intensity = Rgb(0.0f);
    return dark;
}

/// Adds the lights without surfaces that move.
void add_lights(const ShadingScene& frame, const ShadingScene& sample, std::vector<ShutterMover>& movers) {
    for (std::size_t i = 0; i < frame.pose->lights.size(); ++i) {
        const LightValues& before = frame.pose->lights[i];
        const LightValues after = find_light(sample.pose->lights, i, before);
        ShutterMover mover{.centers = {far_away, far_away}, .shines = true, .light = before.node};
        if (before.kind != Light::Kind::directional) {
            mover.centers[0] = before.position - frame.anchor;
            mover.centers[1] = after.position - frame.anchor;
            mover.moved = static_cast<float>(glm::distance(after.position, before.position));
        }
        if (before.kind != Light::Kind::point)
            mover.turned = static_cast<float>(glm::distance(after.direction, before.direction));
        if (before.kind == Light::Kind::spot) {
            mover.turned += static_cast<float>(std::max(std::abs(after.inner_cone - before.inner_cone),
                                                        std::abs(after.outer_cone - before.outer_cone)));
        }
        const bool is_dark = before.intensity == Rgb(0.0f) && after.intensity == Rgb(0.0f);
        if (!is_dark && mover.moved + mover.turned > 0.0f) movers.push_back(mover);
    }
    if (frame.environment.map == nullptr || frame.environment.rotation == sample.environment.rotation) return;
    movers.push_back({.centers = {far_away, far_away},
                      .shines = true,
                      .turned = find_turn(frame.environment.rotation, sample.environment.rotation)});
}

}  // namespace

std::vector<ShutterMover> find_movers(const ShadingScene& frame, const ShadingScene& sample) {
    const glm::vec3 shift(sample.anchor - frame.anchor);
    std::vector<ShutterMover> movers;
    for (int i = 0; i < std::ssize(frame.instances); ++i) {
        const PosedInstance &before = frame.instances[i], &after = sample.instances[i];
        const ShadingMaterial &first_values = frame.materials[before.material],
                              &last_values = sample.materials[after.material];
        const float faded = before.visible || after.visible ? find_fade(first_values, last_values) : 0.0f;
        if (is_at_rest(before, after, shift) && faded == 0.0f) continue;
        const bool both = before.visible && after.visible;
        const BoundingSphere first = find_bounds(before.visible ? before : after).sphere,
                             last = find_bounds(after.visible ? after : before).sphere;
        ShutterMover mover{i, {first.center, last.center}, std::max(first.radius, last.radius), infinite};
        mover.faded = faded;
        mover.shines = first_values.emits || last_values.emits;
        mover.turned = find_turn(before.linear, after.linear);
        if (mover.shines && before.deformed != nullptr && after.deformed != nullptr)
            mover.turned = std::max(mover.turned, find_bend(before, after));
        if (after.visible) mover.centers[1] += shift;
        if (!before.visible) mover.centers[0] += shift;
        if (both) mover.moved = find_longest_way(before, after, shift);
        if (both && before.deformed != nullptr)
            mover.bent = find_longest_way(before, after, shift - (mover.centers[1] - mover.centers[0]));
        movers.push_back(mover);
    }
    add_lights(frame, sample, movers);
    return movers;
}

float find_dimming(const ShadingScene& before, const ShadingScene& after, float weight, const ShadingScene& sample) {
    const auto differ = [weight](const Rgb& a, const Rgb& b, const Rgb& at) {
        return find_difference(a + weight * (b - a), at);
    };
    float most = differ(before.environment.radiance, after.environment.radiance, sample.environment.radiance);
    for (const int i : before.emitting) {
        if (!before.instances[i].visible) continue;
        const int m = before.instances[i].material;
        const auto emission = [m](const ShadingScene& at) { return at.materials[m].values.emission; };
        most = std::max(most, differ(emission(before), emission(after), emission(sample)));
    }
    for (const ShadingScene* listed : {&before, &after, &sample}) {
        for (std::size_t i = 0; i < listed->pose->lights.size(); ++i) {
            const LightValues& light = listed->pose->lights[i];
            const LightValues a = find_light(before.pose->lights, i, light),
                              b = find_light(after.pose->lights, i, light),
                              at = find_light(sample.pose->lights, i, light);
            // 1 - (d / range)^4 of the light is left (lights.cpp).
            const float range = std::lerp(find_difference(Rgb(a.range), Rgb(at.range)),
                                          find_difference(Rgb(b.range), Rgb(at.range)), weight);
            most = std::max(most, differ(a.intensity, b.intensity, at.intensity) + 4.0f * range);
        }
    }
    return most;
}

}  // namespace aleph
