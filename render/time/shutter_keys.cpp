#include "render/time/shutter_keys.h"

#include <algorithm>
#include <cmath>

#include "render/settings/numbers.h"
#include "render/time/shutter_shadows.h"

namespace aleph {

namespace {

constexpr double nearly_all = 0.9;            // of the light that is wanted
constexpr double least_gain = 0.25;           // share of what is not known yet, for twice as many spans
constexpr double least_share = 0.25;          // of it, so that light at several times pays
constexpr double before_jump = 1.0 / 2048.0;  // frames

/// Times at which the scene is looked at: -1 where the shutter opens, 1 where it closes. Their mean is exact for light
/// of up to the fifth order in time (Chebyshev's equal weights), and nothing that turns evenly is in step with them.
constexpr double look_places[] = {-0.794654472, -0.187592474, 0.187592474, 0.794654472};

double find_weight(double open, double close, double at) {
    return close > open ? std::clamp((at - open) / (close - open), 0.0, 1.0) : 0.0;
}

/// Returns whether light is not to be interpolated from one pose to another that follows at once.
bool jumps(const KeyPose& before, const KeyPose& after) {
    constexpr float least_dimming = 0.02f;
    const std::vector<ShutterMover> movers = find_movers(before.shading, after.shading);
    return find_dimming(before.shading, before.shading, 0.0f, after.shading) > least_dimming ||
           std::ranges::any_of(movers, [](const ShutterMover& mover) { return !(mover.moved < infinite); });
}

/// Share of the places at whose surfaces light is known.
double find_known_share(const ShutterPlaces& places, const ShutterLight& light, const ShadingScene& sample) {
    std::size_t known = 0;
    for (const PixelSurface& seen : places.surfaces) {
        const std::optional<SurfacePoint> point = carry_point(sample, seen.hit, seen.point);
        if (!point) continue;
        PixelSurface surface = seen;
        surface.point = *point;
        const float accuracy = places.accuracy(surface.x, surface.y);
        const auto reading = light.find_change(surface, accuracy);
        if (reading && reading->change <= accuracy) ++known;
    }
    return static_cast<double>(known) / static_cast<double>(places.surfaces.size());
}

/// Finds LightChanges of the spans, too. @param looks  in order, times at which poses are known
double find_known_share(const ShutterPlaces& places, std::vector<KeySpan>& spans, const std::vector<KeyTime>& looks,
                        const PoseAt& pose) {
    double known = 0.0, length = 0.0;
    for (auto& [first, last, changes] : spans) {
        const double time = last.at - first.at, middle = 0.5 * (first.at + last.at);
        const ProbedLight &open = places.probed_at(*first.pose), &close = places.probed_at(*last.pose);
        const auto look = [&](double at, const KeyPose& there) {
            const auto weight = static_cast<float>(find_weight(first.at, last.at, at));
            const ProbedLight expected = add_light({{&open, 1.0f - weight}, {&close, weight}});
            changes.add(find_light_changes(places.surfaces, places.picture(), expected, places.probed_at(there)));
        };
        const auto halfway = pose(middle);
        look(middle, *halfway);
        for (const auto& [at, there] : looks)
            if (first.at < at && at < last.at) look(at, *there);
        ShutterLight light(first.pose->shading, last.pose->shading, 0.5f, halfway->shading, nullptr);
        light.add_changes(changes, 1.0f);
        known += time * find_known_share(places, light, halfway->shading);
        length += time;
    }
    return length > 0.0 ? known / length : 0.0;
}

std::vector<KeyTime> look_around_center(const ShutterInterval& shutter, const PoseAt& pose) {
    std::vector<KeyTime> looks;
    for (const double place : look_places) {
        const double at = std::lerp(shutter.open, shutter.close, 0.5 + 0.5 * place);
        looks.push_back({at, pose(at)});
    }
    return looks;
}

LightChanges find_changes_from_center(const ShutterPlaces& places, const std::vector<KeyTime>& looks) {
    std::vector<WeighedLight> lights;
    for (const KeyTime& look : looks) lights.push_back({&places.probed_at(*look.pose), 1.0f / std::size(look_places)});
    return find_light_changes(places.surfaces, places.picture(), places.probed, add_light(lights));
}

bool center_does(const ShutterPlaces& places, const std::vector<KeyTime>& looks, const LightChanges& changes) {
    double known = 0.0;
    for (const KeyTime& look : looks) {
        ShutterLight light(places.shading, look.pose->shading, nullptr, nullptr);
        light.add_changes(changes, 1.0f);
        known += find_known_share(places, light, look.pose->shading);
    }
    return known >= nearly_all * static_cast<double>(looks.size());
}

/// Parts of the shutter between jumps.
std::vector<KeySpan> cut_at_jumps(const ShutterInterval& shutter, const std::vector<double>& at, const PoseAt& pose) {
    const auto key = [&](double time) { return KeyTime{time, pose(time)}; };
    std::vector<KeySpan> parts;
    KeyTime begin = key(shutter.open);
    for (const double time : at) {
        if (!(time - before_jump > begin.at && time < shutter.close)) continue;
        const KeyTime before = key(time - before_jump), after = key(time);
        if (!jumps(*before.pose, *after.pose)) continue;
        parts.push_back({begin, before});
        begin = after;
    }
    parts.push_back({begin, key(shutter.close)});
    return parts;
}

std::vector<KeySpan> divide(const std::vector<KeySpan>& parts, double length, const PoseAt& pose) {
    std::vector<KeySpan> spans;
    for (const auto& [first, last, changes] : parts) {
        const double time = last.at - first.at;
        const ShadingScene &from = first.pose->shading, &middle = pose(0.5 * (first.at + last.at))->shading;
        const bool still = is_same(from, last.pose->shading) && is_same(from, middle);
        const int count = still ? 1 : std::max(1, static_cast<int>(std::lround(time / length)));
        KeyTime begin = first;
        for (int i = 1; i <= count; ++i) {
            const double at = first.at + time * i / count;
            const KeyTime end = i == count ? last : KeyTime{at, pose(at)};
            spans.push_back({begin, end});
            begin = end;
        }
    }
    return spans;
}

}  // namespace

LightInSpan::LightInSpan(const ShutterSpan& span, double at, const ShadingScene& sample)
    : light_(span.before->at->shading, span.after ? span.after->at->shading : span.before->at->shading,
             span.after ? static_cast<float>(find_weight(span.open, span.close, at)) : 0.0f, sample, &between_),
      between_(span.before, span.after, find_weight(span.open, span.close, at),
               light_.has_movers() ? BetweenKeys::smooth : BetweenKeys::linear) {
    const auto weight = static_cast<float>(find_weight(span.open, span.close, at));
    light_.add_changes(span.changes, 4.0f * weight * (1.0f - weight));
}

const ShutterSpan* find_span(const std::vector<ShutterSpan>& spans, double at) {
    const auto holds = [at](const ShutterSpan& span) { return span.open <= at && at <= span.close; };
    const auto found = std::ranges::find_if(spans, holds);
    return found == spans.end() ? nullptr : &*found;
}

bool is_same(const ShadingScene& a, const ShadingScene& b) {
    return find_movers(a, b).empty() && find_dimming(a, a, 0.0f, b) == 0.0f;
}

ShutterTimes choose_times(const ShutterInterval& shutter, const std::vector<double>& jump_times,
                          const ShutterPlaces& places, const PoseAt& pose, int most) {
    ShutterTimes times;
    if (places.surfaces.empty() || !(shutter.close > shutter.open)) return times;
    const std::vector<KeyTime> looks = look_around_center(shutter, pose);
    if (jump_times.empty()) {
        times.from_center = find_changes_from_center(places, looks);
        if (most == 0 || center_does(places, looks, times.from_center)) return times;
    }
    const std::vector<KeySpan> parts = cut_at_jumps(shutter, jump_times, pose);
    std::vector<KeySpan>& spans = times.spans;
    double share = 0.0;
    for (int count = 1; count <= most && share < nearly_all; count *= 2) {
        std::vector<KeySpan> finer = divide(parts, (shutter.close - shutter.open) / count, pose);
        const double known = find_known_share(places, finer, looks, pose), gain = known - share;
        if (gain > least_gain * (1.0 - share)) {
            spans = std::move(finer);
            share = known;
        }
    }
    if (share < least_share) spans.clear();
    for (auto& [first, last, changes] : spans)
        if (is_same(first.pose->shading, last.pose->shading)) last.pose = nullptr;
    return times;
}

KeyframeRecords find_lasting(const KeyframeLight& light, const ShutterPlaces& places, const KeyPose& to,
                             float accuracy) {
    const ShadingScene& from = light.at->shading;
    const std::vector<ShutterMover> movers = find_movers(from, to.shading);
    const LightChanges changes =
        find_light_changes(places.surfaces, places.picture(), places.probed_at(*light.at), places.probed_at(to));
    const float dimmed =
        std::max(find_dimming(from, from, 0.0f, to.shading) + find_shadow_change(from, movers), changes.largest());
    KeyframeRecords lasting;
    for (const IrradianceRecord& record : light.cache.records()) {
        const glm::vec3 at_rest(0.0f);
        const float change = dimmed + find_light_change(movers, record.position, at_rest) +
                             find_hidden_change(movers, record.position, at_rest, no_index, accuracy) +
                             find_sunlight_change(from, movers, record.position, at_rest, no_index, accuracy);
        if (change <= accuracy) lasting.seen.push_back(record);
    }
    return lasting;
}

}  // namespace aleph
