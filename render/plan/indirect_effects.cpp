// Effects of indirect light: what Lambert surfaces pass on, once or more often, caustics, and light kept over frames.

#include <algorithm>

#include "render/plan/effect_bounds.h"
#include "render/plan/effect_table.h"

namespace aleph {

namespace {

constexpr std::size_t most_objects = 128;  // of which all pairs are looked at
constexpr const char* no_indirect_light = "there is no indirect light";

/// Share of its illuminance that a surface of `receiver` can have from what lies in `other`, by a sphere around that.
double largest_view(const ObjectFacts& receiver, const ObjectFacts& other) {
    if (&receiver == &other) return receiver.convex ? 0.0 : 1.0;
    if (receiver.flat && is_in_plane(receiver, other.bounds)) return 0.0;
    const glm::dvec3 center = 0.5 * (other.bounds.low + other.bounds.high);
    const double radius = glm::length(other.bounds.high - center), distance = distance_to(receiver.bounds, center);
    return distance > radius ? radius * radius / (distance * distance) : 1.0;
}

/// Radiance that pixels can have of indirect light: what each surface that is seen can receive from all others, by the
/// solid angles of spheres around them. 0 where no surface sees another.
/// @param bounces  of indirect light
double bound_indirect_light(const FrameFacts& facts, int bounces) {
    if (facts.objects.size() > most_objects) return unbounded;
    const double again = sum_powers(largest_diffuse(facts), 1, bounces - 1);
    const double further = again > 0.0 ? again * largest_direct_radiance(facts) : 0.0;
    const double met = largest_radiance(facts, bounces);
    std::vector<double> sent;
    for (const ObjectFacts& object : facts.objects) {
        double radiance = object.material.diffuse > 0.0f ? object.lit_radiance + further : 0.0;
        if (object.material.has_specular()) {
            const double share = object.material.glass ? 1.0 : object.material.reflectance;
            radiance += share * met + largest_highlight(facts, object);
        }
        sent.push_back(radiance);
    }
    double largest = 0.0;
    for (const ObjectFacts& receiver : facts.objects) {
        if (!(receiver.material.diffuse > 0.0f) || !facts.is_seen(receiver)) continue;
        double received = 0.0;
        for (std::size_t i = 0; i < facts.objects.size(); ++i) {
            const double view = sent[i] > 0.0 ? largest_view(receiver, facts.objects[i]) : 0.0;
            if (view > 0.0) received += view * sent[i];
        }
        largest = std::max(largest, receiver.material.diffuse * received);
    }
    return largest;
}

/// Radiance that pixels can have of the light that comes after the first `bounces` bounces: by the largest albedo
/// alone.
/// @param most  bounces in all
double bound_further_bounces(const FrameFacts& facts, int bounces, int most) {
    const double powers = sum_powers(largest_diffuse(facts), bounces + 1, most);
    if (!(powers > 0.0)) return 0.0;
    return powers *
           (facts.any(&MaterialFacts::has_specular) ? largest_radiance(facts, most) : largest_direct_radiance(facts));
}

int count_bounces(const Planning& frame) {
    return std::min(frame.settings.light.bounces, frame.settings.light.path_depth - 1);
}

Finding find_indirect_diffuse(Planning& frame) {
    const int bounces = count_bounces(frame);
    const double bound = bound_indirect_light(frame.in.facts, std::max(bounces, 1));
    if (bounces <= 0) return leave_to_user(frame, "the setting bounces is 0", bound);
    return simulate_if_visible(frame, bound, "light passes from surface to surface",
                               "no Lambert surface sees another that sends light");
}

Finding find_more_bounces(Planning& frame) {
    if (frame.plan.skips(Effect::indirect_diffuse)) return skip(no_indirect_light);
    const int bounces = count_bounces(frame);
    if (bounces == 1)
        return leave_to_user(frame, "the setting bounces is 1", bound_further_bounces(frame.in.facts, 1, 1000));
    return simulate_if_visible(frame, bound_further_bounces(frame.in.facts, 1, bounces),
                               "light of second and further bounces", "no light of a second bounce");
}

Finding find_caustics(Planning& frame) {
    if (frame.plan.skips(Effect::indirect_diffuse)) return skip(no_indirect_light);
    const float width = find_caustic_width(frame.settings);
    const bool blurred = frame.in.facts.any([width](const MaterialFacts& material) {
        return width > 0.0f && (material.mirror || material.volume || material.least_width < width);
    });
    return simulate_if(frame.in.facts.any(&MaterialFacts::has_specular),
                       blurred ? "mirrors, glass or gloss may pass light to Lambert surfaces; blurred, unless forced"
                               : "mirrors, glass or gloss may pass light to Lambert surfaces",
                       "no surface has gloss, a mirror or glass");
}

Finding find_carry_over(Planning& frame) {
    if (!frame.in.keyframes) return skip("lighting keyframes are not in use");
    if (frame.plan.skips(Effect::indirect_diffuse)) return skip(no_indirect_light);
    return simulate("indirect light comes from lighting keyframes");
}

bool passes_light_on(const MaterialFacts& material, const FrameFacts& facts) {
    return material.diffuse > 0.0f && !facts.lights.empty();
}

/// Limits a setting of a group: `Group` is the member of RenderSettings, `Field` that of the group.
template <auto Group, auto Field, int most>
void limit(RenderSettings& settings) {
    int& value = settings.*Group.*Field;
    value = std::min(value, most);
}

constexpr Rgb green{0.0f, 0.6f, 0.1f}, light_green{0.5f, 0.9f, 0.4f};

}  // namespace

EffectTable indirect_effects() {
    return {
        {describe(Effect::indirect_diffuse), find_indirect_diffuse, green, passes_light_on, nullptr,
         limit<&RenderSettings::light, &LightSettings::bounces, 0>},
        {describe(Effect::more_bounces), find_more_bounces, light_green, passes_light_on, nullptr,
         limit<&RenderSettings::light, &LightSettings::bounces, 1>},
        {describe(Effect::caustics), find_caustics, violet, passes_light_on},
        {.effect = describe(Effect::cache_carry_over),
         .find = find_carry_over,
         .turn_off = limit<&RenderSettings::cache, &CacheSettings::light_step, 0>},
    };
}

}  // namespace aleph
