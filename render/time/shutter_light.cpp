#include "render/time/shutter_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/settings/numbers.h"
#include "render/time/shutter_shadows.h"

namespace aleph {

namespace {

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

float find_hidden_share(float radius, float distance) {
    return radius < distance ? radius * radius / (distance * distance) : 1.0f;
}

float find_hidden_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved,
                         int instance, float enough) {
    float change = 0.0f;
    for (const ShutterMover& mover : movers) {
        const bool own = mover.instance == instance;
        if (!(mover.radius > 0.0f) || (own && mover.faded == 0.0f)) continue;
        const float distance = find_distance(mover, position, moved);
        const float steps = own ? 0.0f : find_steps(mover, distance, moved);
        change += find_hidden_share(mover.radius, distance) * std::min(1.0f, steps + mover.faded);
        if (change > enough) break;
    }
    return change;
}

float find_light_change(const std::vector<ShutterMover>& movers, const glm::vec3& position, const glm::vec3& moved) {
    float change = 0.0f;
    for (const ShutterMover& mover : movers) {
        if (!mover.shines) continue;
        const float distance = find_distance(mover, position, moved), steps = find_steps(mover, distance, moved);
        float share = steps;
        if (mover.bend < infinite && distance > 0.0f) {
            const float line = steps * steps / 3.0f + 3.0f * (mover.bend + glm::length(moved)) / distance;
            share = steps < 3.0f ? std::min(steps, line) : line;
        }
        change = std::max(change, share + 3.0f * mover.turned);
    }
    return change;
}

void find_bends(std::vector<ShutterMover>& before, std::vector<ShutterMover>& after, float weight) {
    const auto way = [](const ShutterMover& mover) {
        return mover.centers[0] == mover.centers[1] ? glm::vec3(0.0f) : mover.centers[0] - mover.centers[1];
    };
    const auto set = [&](std::vector<ShutterMover>& movers, const std::vector<ShutterMover>& others, float share) {
        for (ShutterMover& mover : movers) {
            glm::vec3 apart = share * way(mover);
            const auto is_same = [&](const ShutterMover& other) {
                return other.instance == mover.instance && other.light == mover.light;
            };
            const auto other = std::ranges::find_if(others, is_same);
            if (other != others.end()) apart += (1.0f - share) * way(*other);
            mover.bend = mover.bent > 0.0f ? infinite : glm::length(apart);  // parts of it do not move as it does
        }
    };
    set(before, after, 1.0f - weight);
    set(after, before, weight);
}

ShutterLight::Key ShutterLight::make_key(const ShadingScene& at, float weight, const ShadingScene& sample) {
    return {at, weight, sample.anchor - at.anchor, find_movers(at, sample)};
}

ShutterLight::ShutterLight(const ShadingScene& frame, const ShadingScene& sample, const CarriedLight* carried,
                           const IrradianceCache* cache)
    : ShutterLight(frame, frame, 0.0f, sample, carried) {
    cache_ = cache;
    at_center_ = true;
}

ShutterLight::ShutterLight(const ShadingScene& before, const ShadingScene& after, float weight,
                           const ShadingScene& sample, const CarriedLight* between)
    : carried_(between), dimmed_(find_dimming(before, after, weight, sample)) {
    const auto add = [&](const ShadingScene& at, float share) {
        keys_.push_back(make_key(at, share, sample));
        dimmed_ += share * find_shadow_change(at, keys_.back().movers);
    };
    add(before, 1.0f - weight);
    if (!(weight > 0.0f)) return;
    add(after, weight);
    find_bends(keys_[0].movers, keys_[1].movers, weight);
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

std::optional<ShutterLight::Reading> ShutterLight::find_change(const PixelSurface& surface, float enough) const {
    Reading reading{.point = surface.point, .change = dimmed_};
    float turned = 0.0f;
    for (const Key& key : keys_) {
        const std::optional<SurfacePoint> point = carry_point(key.shading, surface.hit, surface.point);
        if (!point) return std::nullopt;
        if (&key == keys_.data()) reading.point = *point;
        turned += key.weight * glm::length(surface.point.normal - point->normal) / std::numbers::sqrt2_v<float>;
        const glm::vec3 moved = surface.point.position + key.shift - point->position;
        reading.moved += key.weight * find_way(key.movers, surface.hit.instance, moved);
        const float most = enough / key.weight;
        const int on = surface.hit.instance;
        const float hidden = find_hidden_change(key.movers, point->position, moved, on, most) +
                             find_sunlight_change(key.shading, key.movers, point->position, moved, on, most);
        reading.change += key.weight * (hidden + find_light_change(key.movers, point->position, moved));
    }
    reading.change = std::max(reading.change, turned);
    if (changes_ != nullptr)
        reading.change = std::max(reading.change, changes_share_ * changes_->at(surface.x, surface.y));
    return reading;
}

std::optional<Rgb> ShutterLight::find(const PixelSurface& surface, float accuracy, RayTask& task,
                                      RecordUse* used) const {
    const std::optional<Reading> reading = find_change(surface, accuracy);
    if (!reading || !(reading->change <= accuracy)) return std::nullopt;
    PixelSurface still = surface;
    if (at_center_) still.point = reading->point;
    RecordUse of_these;
    const std::optional<Rgb> found = read(still, accuracy, task, of_these);
    if (!found || reading->moved * of_these.weights > of_these.reaches) return std::nullopt;
    if (used != nullptr) used->add(of_these);
    return found;
}

}  // namespace aleph
