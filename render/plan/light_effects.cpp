// Effects of lights: direct light, shadows, and the environment.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/plan/effect_bounds.h"
#include "render/plan/effect_table.h"

namespace aleph {

namespace {

constexpr std::size_t most_shadow_tests = 1000000;

bool overlap(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.low, b.high)) && glm::all(glm::lessThanEqual(b.low, a.high));
}

struct Interval {
    double low = unbounded, high = -unbounded;
    bool meets(const Interval& o) const { return low <= o.high && o.low <= high; }
};

Interval along(const Bounds& box, const glm::dvec3& axis) {
    Interval interval;
    for (int i = 0; i < 8; ++i) {
        const double at = glm::dot(axis, box.corner(i));
        interval.low = std::min(interval.low, at);
        interval.high = std::max(interval.high, at);
    }
    return interval;
}

/// True if parallel light that comes to one box may meet another before it.
bool may_block_parallel(const Bounds& receiver, const Bounds& blocker, const glm::dvec3& towards_light) {
    if (along(blocker, towards_light).high < along(receiver, towards_light).low) return false;
    const glm::dvec3 other = std::abs(towards_light.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 across = glm::normalize(glm::cross(towards_light, other));
    return along(receiver, across).meets(along(blocker, across)) &&
           along(receiver, glm::cross(towards_light, across)).meets(along(blocker, glm::cross(towards_light, across)));
}

bool may_block(const LightFacts& light, const ObjectFacts& receiver, const ObjectFacts& blocker) {
    if (light.kind == LightFacts::Kind::surroundings) return !(receiver.flat && is_in_plane(receiver, blocker.bounds));
    if (light.kind == LightFacts::Kind::directional)
        return may_block_parallel(receiver.bounds, blocker.bounds, -light.direction);
    Bounds hull = receiver.bounds;
    hull.add(light.center - light.radius);
    hull.add(light.center + light.radius);
    return overlap(hull, blocker.bounds);
}

bool may_be_shadowed(const FrameFacts& facts, const LightFacts& light) {
    const std::size_t count = facts.objects.size();
    if (count * count * facts.lights.size() > most_shadow_tests) return true;
    const ObjectFacts* const lamp = light.object == no_index ? nullptr : &facts.objects[light.object];
    for (const ObjectFacts& receiver : facts.objects) {
        if (!receiver.material.scatters()) continue;
        if (!receiver.convex || receiver.material.alpha) return true;
        const bool near = light.kind == LightFacts::Kind::point && distance_to(receiver.bounds, light.center) == 0.0;
        if (near || (receiver.material.glass && !receiver.flat)) return true;  // a lamp within a body
        for (const ObjectFacts& blocker : facts.objects) {
            const bool itself = &blocker == &receiver || (&blocker == lamp && lamp->convex);
            if (!itself && may_block(light, receiver, blocker)) return true;
        }
    }
    return false;
}

/// Radiance that an object can scatter of a light that is sampled, at most. Mirrors and smooth glass meet a light that
/// has an area by themselves; wide lobes do so too rarely.
double scattered_radiance(const LightFacts& light, const ObjectFacts& object) {
    const MaterialFacts& material = object.material;
    const double illuminance = largest_illuminance(light, object.bounds);
    const auto lit = [&](double brightness) { return brightness > 0.0 ? brightness * illuminance : 0.0; };
    const double diffuse = material.diffuse / std::numbers::pi;
    if (!light.has_area()) return material.glass ? unbounded : lit(diffuse + lobe_peak(material));
    if (material.rough_glass) return lit(diffuse) + light.strength;
    if (!material.glossy) return lit(diffuse);
    return lit(diffuse) + std::min(material.reflectance * light.strength, lit(lobe_peak(material)));
}

/// Radiance that a light can bring to pixels.
double bound_light(const FrameFacts& facts, const LightFacts& light, int bounces) {
    double largest = 0.0;
    for (const ObjectFacts& object : facts.objects) {
        if (light.object != no_index && &facts.objects[light.object] == &object && object.convex) continue;
        largest = std::max(largest, scattered_radiance(light, object));
    }
    return largest * (1.0 + bounces);
}

/// Chooses the lights to leave out: those that can hardly bring anything, the dimmest first.
/// @returns the radiance that they can bring together
double choose_faint_lights(const Planning& frame, std::vector<LightFacts>& chosen) {
    const FrameFacts& facts = frame.in.facts;
    std::vector<std::pair<double, std::size_t>> brought;
    for (std::size_t i = 0; i < facts.lights.size(); ++i) {
        if (facts.lights[i].kind == LightFacts::Kind::surroundings) continue;
        brought.emplace_back(bound_light(facts, facts.lights[i], frame.settings.light.bounces), i);
    }
    std::ranges::sort(brought);
    double sum = 0.0;
    for (const auto& [radiance, i] : brought) {
        if (!(frame.bound_of(sum + radiance).thresholds <= 0.5 * frame.left)) break;
        sum += radiance;
        chosen.push_back(facts.lights[i]);
    }
    return sum;
}

Finding find_direct_light(Planning& frame) {
    const std::size_t all = frame.in.facts.lights.size();
    if (all == 0) return skip("there is no light");
    if (!frame.in.facts.any(&MaterialFacts::scatters)) return skip("no surface scatters light");
    Finding finding = simulate(fmt::format("{} {}", all, all == 1 ? "light" : "lights"));
    if (!frame.visible || !frame.may_leave_out(Effect::direct_light)) return finding;
    const double radiance = choose_faint_lights(frame, frame.plan.lights_left_out);
    const std::size_t count = frame.plan.lights_left_out.size();
    if (count == 0) return finding;
    finding.cheaper = {.decision = count == all ? Decision::skip : Decision::simplify,
                       .reason = fmt::format("{} of {} lights bring less than {:.2g} visible thresholds together",
                                             count, all, 0.5 * planned_thresholds(frame.settings)),
                       .bound = frame.bound_of(radiance)};
    return finding;
}

Finding find_area_shadows(Planning& frame) {
    bool areas = false, areas_shadowed = false, points_shadowed = false;
    for (const LightFacts& light : frame.in.facts.lights) {
        areas = areas || light.has_area();
        bool& shadowed = light.has_area() ? areas_shadowed : points_shadowed;
        shadowed = shadowed || may_be_shadowed(frame.in.facts, light);
    }
    frame.plan.points_unshadowed = !points_shadowed && frame.may_leave_out(Effect::direct_light);
    Finding finding = simulate("something may stand between lights and surfaces");
    if (!areas) {
        finding = skip("no light has an area");
    } else if (!frame.in.facts.any(&MaterialFacts::scatters)) {
        finding = skip("no surface scatters light");
    } else if (!areas_shadowed) {
        finding = skip("nothing stands between lights and surfaces");
    }
    finding.planned.spares = areas || frame.plan.points_unshadowed;
    return finding;
}

Finding find_environment(Planning& frame) {
    const bool there = std::ranges::any_of(
        frame.in.facts.lights, [](const LightFacts& l) { return l.kind == LightFacts::Kind::surroundings; });
    return simulate_if(there, "light comes from all around", "there is no environment, or it is black");
}

void remove_environment(Scene& scene) {
    scene.environment.radiance.reset();
    scene.environment.image = no_index;
}

bool is_lit(const MaterialFacts& material, const FrameFacts& facts) {
    return material.scatters() && !facts.lights.empty();
}

constexpr Rgb yellow{1.0f, 0.8f, 0.0f}, blue{0.1f, 0.3f, 1.0f};

}  // namespace

EffectTable light_effects() {
    return {
        {describe(Effect::direct_light), find_direct_light, yellow, is_lit},
        {describe(Effect::area_shadows), find_area_shadows, blue, is_lit},
        {.effect = describe(Effect::environment), .find = find_environment, .remove = remove_environment},
    };
}

}  // namespace aleph
