#include "render/plan/effect_picture.h"

#include <algorithm>
#include <vector>

#include "engine/base/index.h"

namespace aleph {

namespace {

/// Whether a surface would show the effect.
bool has_effect(const MaterialFacts& material, Effect effect, const FrameFacts& facts) {
    const bool lit = material.scatters() && !facts.lights.empty();
    switch (effect) {
        case Effect::direct_light:
        case Effect::area_shadows:
            return lit;
        case Effect::indirect_diffuse:
        case Effect::more_bounces:
        case Effect::caustics:
            return lit && material.diffuse > 0.0f;
        case Effect::glossy_reflection:
            return material.glossy;
        case Effect::mirror_reflection:
            return material.mirror;
        case Effect::refraction:
            return material.glass;
        default:
            return true;
    }
}

/// Whether the plan leaves out something of the effect, and it is not that there is nothing of the kind.
bool is_left_out(const EffectsPlan& plan, const FrameFacts& facts, Effect effect) {
    const PlannedEffect& planned = plan.of(effect);
    if (planned.decision == Decision::simulate) return false;
    if (!planned.bound || planned.bound->luminance > 0.0) return true;
    const bool areas = std::ranges::any_of(facts.lights, [](const LightFacts& l) { return l.has_area(); });
    return effect == Effect::area_shadows && (areas || plan.points_unshadowed);
}

Rgb mix(const std::vector<Effect>& left_out, const MaterialFacts& material, const FrameFacts& facts) {
    Rgb sum(0.0f);
    float count = 0.0f;
    for (const Effect effect : left_out) {
        if (!has_effect(material, effect, facts)) continue;
        sum += effect_color(effect);
        count += 1.0f;
    }
    return count > 0.0f ? sum / count : sum;
}

}  // namespace

Rgb effect_color(Effect effect) {
    switch (effect) {
        case Effect::direct_light:
            return {1.0f, 0.8f, 0.0f};
        case Effect::area_shadows:
            return {0.1f, 0.3f, 1.0f};
        case Effect::indirect_diffuse:
            return {0.0f, 0.6f, 0.1f};
        case Effect::more_bounces:
            return {0.5f, 0.9f, 0.4f};
        case Effect::glossy_reflection:
            return {1.0f, 0.0f, 0.8f};
        case Effect::mirror_reflection:
        case Effect::refraction:
        case Effect::caustics:
            return {0.5f, 0.1f, 0.8f};
        case Effect::motion_blur:
            return {1.0f, 0.1f, 0.1f};
        case Effect::depth_of_field:
            return {0.0f, 0.8f, 0.9f};
        default:
            return Rgb(0.0f);
    }
}

Image<Rgb> make_effect_picture(const Image<Hit>& hits, const FrameFacts& facts, const EffectsPlan& plan,
                               std::size_t instances) {
    std::vector<Effect> left_out;
    for (std::size_t i = 0; i < effect_count; ++i) {
        const Effect effect = static_cast<Effect>(i);
        if (effect_color(effect) != Rgb(0.0f) && is_left_out(plan, facts, effect)) left_out.push_back(effect);
    }
    std::vector<Rgb> colors(instances, Rgb(0.0f));
    for (const ObjectFacts& object : facts.objects) colors[object.instance] = mix(left_out, object.material, facts);
    Image<Rgb> picture(hits.width, hits.height, Rgb(0.0f));
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits.pixels[i].instance != no_index) picture.pixels[i] = colors[hits.pixels[i].instance];
    }
    return picture;
}

}  // namespace aleph
