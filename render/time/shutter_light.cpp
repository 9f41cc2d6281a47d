#include "render/time/shutter_light.h"

#include <algorithm>
#include <numbers>

#include "render/settings/numbers.h"

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

float find_longest_way(const PosedInstance& frame, const PosedInstance& sample, const glm::vec3& shift) {
    float way = 0.0f;
    for (std::uint32_t v = 0; v < frame.mesh->positions.size(); ++v) {
        way = std::max(way, glm::length(sample.place(v) + shift - frame.place(v)));
    }
    return way;
}

/// Upper bound of the share of irradiance that a sphere hides at a distance from its centre.
float hidden_share(float radius, float distance) {
    return radius < distance ? radius * radius / (distance * distance) : 1.0f;
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

const glm::vec3 far_away(infinite);

/// Adds the lights without surfaces that move.
void add_lights(const ShadingScene& frame, const ShadingScene& sample, std::vector<ShutterMover>& movers) {
    for (std::size_t i = 0; i < frame.pose->lights.size(); ++i) {
        const LightValues &before = frame.pose->lights[i], &after = sample.pose->lights[i];
        ShutterMover mover{.centers = {far_away, far_away}, .shines = true};
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

/// m, of the point from the mover.
float find_distance(const ShutterMover& mover, const glm::vec3& position, const glm::vec3& moved) {
    return std::min(glm::length(position - mover.centers[0]), glm::length(position + moved - mover.centers[1]));
}

/// In distances, three times how far the mover and the point move.
float find_steps(const ShutterMover& mover, float distance, const glm::vec3& moved) {
    return distance > 0.0f ? 3.0f * (mover.moved + glm::length(moved)) / distance : infinite;
}

/// m: how far a point moves, or other parts of its own mesh past it.
float find_way(const std::vector<ShutterMover>& movers, int instance, const glm::vec3& moved) {
    const float way = glm::length(moved);
    const auto own = std::ranges::find(movers, instance, &ShutterMover::instance);
    if (own == movers.end() || !(own->bent > 0.0f)) return way;
    return std::max(way, own->bent + glm::length(moved - (own->centers[1] - own->centers[0])));
}

}  // namespace

std::vector<ShutterMover> find_movers(const ShadingScene& frame, const ShadingScene& sample) {
    const glm::vec3 shift(sample.anchor - frame.anchor);
    std::vector<ShutterMover> movers;
    for (int i = 0; i < std::ssize(frame.instances); ++i) {
        const PosedInstance &before = frame.instances[i], &after = sample.instances[i];
        if (is_at_rest(before, after, shift)) continue;
        const bool both = before.visible && after.visible;
        const BoundingSphere first = find_sphere(before.visible ? before : after),
                             last = find_sphere(after.visible ? after : before);
        ShutterMover mover{i, {first.center, last.center}, std::max(first.radius, last.radius), infinite};
        mover.shines = frame.materials[before.material].emits || sample.materials[after.material].emits;
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

float find_hidden_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved,
                         int instance, float enough) {
    float change = 0.0f;
    for (const ShutterMover& mover : movers) {
        if (mover.instance == instance || !(mover.radius > 0.0f)) continue;
        const float distance = find_distance(mover, position, moved);
        change += hidden_share(mover.radius, distance) * std::min(1.0f, find_steps(mover, distance, moved));
        if (change > enough) break;
    }
    return change;
}

float find_light_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved) {
    float change = 0.0f;
    for (const ShutterMover& mover : movers) {
        if (!mover.shines) continue;
        const float steps = find_steps(mover, find_distance(mover, position, moved), moved);
        change = std::max(change, std::min(1.0f, steps + 3.0f * mover.turned));
    }
    return change;
}

float find_dimming(const ShadingScene& frame, const ShadingScene& sample) {
    float most = find_difference(frame.environment.radiance, sample.environment.radiance);
    for (const int i : frame.emitting) {
        if (!frame.instances[i].visible) continue;
        const int m = frame.instances[i].material;
        most = std::max(most, find_difference(frame.materials[m].values.emission, sample.materials[m].values.emission));
    }
    for (std::size_t i = 0; i < frame.pose->lights.size(); ++i) {
        const LightValues &before = frame.pose->lights[i], &after = sample.pose->lights[i];
        // 1 - (d / range)^4 of the light is left (lights.cpp).
        const float range = find_difference(Rgb(before.range), Rgb(after.range));
        most = std::max(most, find_difference(before.intensity, after.intensity) + 4.0f * range);
    }
    return most;
}

std::optional<Rgb> ShutterLight::read(const PixelSurface& still, float accuracy, RayTask& task, RecordUse& used) const {
    if (carried_ != nullptr) {
        if (const std::optional<Rgb> found = carried_->find(still, accuracy, task, &used)) return found;
    }
    if (cache_ == nullptr) return std::nullopt;
    CacheQuery query{still.point.position, still.point.normal, accuracy * shade_reach, &task};
    query.used = &used;
    return cache_->interpolate(query);
}

std::optional<Rgb> ShutterLight::find(const PixelSurface& surface, float accuracy, RayTask& task,
                                      RecordUse* used) const {
    const std::optional<SurfacePoint> point = carry_point(frame_, surface.hit, surface.point);
    if (!point) return std::nullopt;
    const float turn = glm::length(surface.point.normal - point->normal) / std::numbers::sqrt2_v<float>;
    if (!(turn <= accuracy)) return std::nullopt;
    const glm::vec3 moved = surface.point.position + shift_ - point->position;
    const float hidden = find_hidden_change(movers_, point->position, moved, surface.hit.instance, accuracy);
    const float change = hidden + dimmed_ + find_light_change(movers_, point->position, moved);
    if (!(change <= accuracy)) return std::nullopt;
    PixelSurface still = surface;
    still.point = *point;
    RecordUse of_these;
    const std::optional<Rgb> found = read(still, accuracy, task, of_these);
    const float way = find_way(movers_, surface.hit.instance, moved);
    if (!found || way * of_these.weights > of_these.reaches) return std::nullopt;
    if (used != nullptr) used->add(of_these);
    return found;
}

}  // namespace aleph
