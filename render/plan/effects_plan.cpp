#include "render/plan/effects_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleph {

EffectsPlan Planner::make() {
    plan_presence();
    plan_lights();
    plan_shadows();
    plan_indirect();
    plan_lobes();
    plan_camera();
    plan_shapes();
    plan_vision();
    override_by_user();
    return std::move(plan_);
}

bool Planner::any(bool MaterialFacts::*what) const {
    return std::ranges::any_of(in_.facts.objects, [&](const ObjectFacts& o) { return o.material.*what; });
}

bool Planner::any_seen(bool MaterialFacts::*what) const {
    return std::ranges::any_of(in_.facts.objects,
                               [&](const ObjectFacts& o) { return in_.facts.is_seen(o) && o.material.*what; });
}

bool Planner::has_light(LightFacts::Kind kind) const {
    return std::ranges::any_of(in_.facts.lights, [&](const LightFacts& l) { return l.kind == kind; });
}

bool Planner::scatters() const {
    return std::ranges::any_of(in_.facts.objects, [](const ObjectFacts& o) { return o.material.scatters(); });
}

void Planner::set(Effect effect, Decision decision, std::string reason, std::optional<EffectBound> bound) {
    plan_.of(effect) = {decision, std::move(reason), bound};
}

/// @param everywhere  it changes pixels that show no surface too
EffectBound Planner::bound_of(double radiance, bool everywhere) const {
    const double luminance = radiance > 0.0 ? radiance * in_.luminance_scale : 0.0;
    double threshold = 0.0;
    if (visible_) threshold = everywhere ? visible_->threshold : visible_->on_surfaces;
    return {luminance, luminance > 0.0 ? luminance / threshold : 0.0};
}

/// Whether so much may be left out, which is then spent. Forced effects spend nothing.
bool Planner::spend(Effect effect, const EffectBound& bound) {
    if (in_.settings.plan == EffectsPlanning::off || in_.settings.force.contains(effect)) return false;
    if (!(bound.thresholds <= left_)) return false;
    left_ -= bound.thresholds;
    return true;
}

/// Skips an effect that adds nothing, or so little that it fits into what may be left out.
/// @param some, none  the reason where it adds something, and where it adds nothing
void Planner::skip_if_invisible(Effect effect, double radiance, const std::string& some, const std::string& none) {
    const EffectBound bound = bound_of(radiance);
    if (bound.luminance == 0.0) {
        skip(effect, none);
    } else if (spend(effect, bound)) {
        set(effect, Decision::skip, some + ", but too little to be seen", bound);
    } else {
        simulate(effect, some);
    }
}

/// @param radiance  infinite where there is no bound
void Planner::leave_to_user(Effect effect, std::string reason, double radiance) {
    const EffectBound bound = bound_of(radiance);
    const bool known = std::isfinite(bound.luminance);
    plan_.of(effect) = {Decision::skip, std::move(reason), known ? std::optional(bound) : std::nullopt, true};
}

/// Effects that are there, or are not.
void Planner::plan_presence() {
    const auto present = [&](Effect effect, bool there, const char* yes, const char* no) {
        there ? simulate(effect, yes) : skip(effect, no);
    };
    present(E::environment, has_light(LightFacts::Kind::surroundings), "light comes from all around",
            "there is no environment, or it is black");
    const bool shines =
        std::ranges::any_of(in_.facts.objects, [](const auto& o) { return o.material.radiance > 0.0f; });
    present(E::emission, shines, "surfaces shine", "no surface shines");
    present(E::textures, any(&MaterialFacts::textured), "materials in use have textures",
            "no material in use has a texture");
    present(E::normal_maps, any(&MaterialFacts::maps_normals), "materials in use have normal maps",
            "no material in use has a normal map");
    present(E::alpha, any(&MaterialFacts::alpha), "masks or blended materials are in use",
            "no mask and no blended material is in use");
}

void Planner::plan_shapes() {
    const Scene& scene = in_.scene;
    const auto uses = [&](auto&& is) {
        return std::ranges::any_of(in_.facts.objects, [&](const ObjectFacts& o) { return is(o); });
    };
    const bool cages = uses([&](const ObjectFacts& o) { return scene.meshes[o.mesh].cage != no_index; });
    const bool refined = uses([&](const ObjectFacts& o) {
        return scene.meshes[o.mesh].cage != no_index && scene.cages[scene.meshes[o.mesh].cage].level > 0;
    });
    if (!cages) {
        skip(E::subdivision, "there is no subdivision cage");
    } else if (!refined) {
        leave_to_user(E::subdivision, "every cage is drawn at level 0", std::numeric_limits<double>::infinity());
    } else {
        simulate(E::subdivision, "subdivision cages are drawn");
    }
    uses([](const ObjectFacts& o) { return o.deforms; }) ? simulate(E::deformation, "meshes deform")
                                                         : skip(E::deformation, "no mesh deforms");
}

void Planner::plan_vision() {
    const RenderSettings& settings = in_.settings;
    if (!in_.perceives) {
        skip(E::motion, "nothing obeys the model of vision");
        skip(E::saliency, "nothing obeys the model of vision");
    } else {
        plan_motion();
        if (settings.perception.guide != Guide::saliency) {
            skip(E::saliency, "the guide is not saliency");
        } else if (in_.maps) {
            simulate(E::saliency, "its map is asked for");
        } else if (plan_.skips(E::motion)) {
            skip(E::saliency, "nothing moves, so it does not matter where viewers look");
        } else {
            simulate(E::saliency, "viewers track what stands out");
        }
    }
    if (!in_.moments) {
        skip(E::cache_carry_over, "key moments are not in use");
    } else if (plan_.skips(E::indirect_diffuse)) {
        skip(E::cache_carry_over, "there is no indirect light");
    } else {
        simulate(E::cache_carry_over, "indirect light comes from key moments");
    }
}

void Planner::plan_motion() {
    if (!in_.has_other) {
        skip(E::motion, "there is no other frame in this shot");
    } else if (in_.moves || in_.settings.motion == MotionSource::image) {
        simulate(E::motion, in_.moves ? "objects or the camera move" : "it is found from pictures");
    } else {
        skip(E::motion, "nothing moves into the next frame");
    }
}

/// --plan off simulates what the plan would leave out; --force and --forbid have the last word.
void Planner::override_by_user() {
    for (std::size_t i = 0; i < effect_count; ++i) {
        const Effect effect = static_cast<Effect>(i);
        PlannedEffect& planned = plan_.effects[i];
        const bool off = in_.settings.plan == EffectsPlanning::off;
        if (in_.settings.forbid.contains(effect)) {
            planned = {Decision::skip, "forbidden", std::nullopt, true};
        } else if (planned.decision != Decision::simulate && (off || in_.settings.force.contains(effect))) {
            planned = {Decision::simulate, off ? "the plan is off" : "forced", EffectBound{}, false};
        }
    }
    if (in_.settings.force.contains(E::direct_light)) plan_.points_unshadowed = false;
}

const char* decision_name(Decision decision) {
    constexpr const char* names[] = {"simulate", "simplify", "skip"};
    return names[static_cast<int>(decision)];
}

EffectSet EffectsPlan::left_out() const {
    EffectSet set;
    for (std::size_t i = 0; i < effect_count; ++i) {
        const Effect effect = static_cast<Effect>(i);
        const PlannedEffect& planned = effects[i];
        const bool adds_nothing = planned.bound && planned.bound->luminance == 0.0 && effect != Effect::area_shadows;
        if (planned.decision == Decision::skip && !adds_nothing) set.add(effect);
    }
    return set;
}

double EffectsPlan::left_out_thresholds() const {
    double sum = 0.0;
    for (const PlannedEffect& effect : effects) {
        if (effect.decision != Decision::simulate && !effect.by_user && effect.bound) sum += effect.bound->thresholds;
    }
    return sum;
}

EffectsPlan plan_effects(const PlanInput& input, const std::optional<VisibleFrame>& visible) {
    return Planner(input, visible).make();
}

}  // namespace aleph
