#include "render/effects_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleph {

namespace {

constexpr double half_pixel = 0.5;
constexpr double contrast_margin = 2.0;  // highlights may be brighter than what the estimate shows

/// Makes one frame's plan.
class Planner {
  public:
    Planner(const PlanInput& input, const std::optional<VisibleFrame>& visible)
        : in_(input), visible_(visible), left_(planned_thresholds(input.settings)) {}

    EffectsPlan make() {
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

  private:
    using E = Effect;

    bool any(bool MaterialFacts::*what) const {
        return std::ranges::any_of(in_.facts.objects, [&](const ObjectFacts& o) { return o.material.*what; });
    }
    bool any_seen(bool MaterialFacts::*what) const {
        return std::ranges::any_of(in_.facts.objects,
                                   [&](const ObjectFacts& o) { return in_.facts.is_seen(o) && o.material.*what; });
    }
    bool has_light(LightFacts::Kind kind) const {
        return std::ranges::any_of(in_.facts.lights, [&](const LightFacts& l) { return l.kind == kind; });
    }
    bool scatters() const {
        return std::ranges::any_of(in_.facts.objects, [](const ObjectFacts& o) { return o.material.scatters(); });
    }

    void set(Effect effect, Decision decision, std::string reason, std::optional<EffectBound> bound = EffectBound{}) {
        plan_.of(effect) = {decision, std::move(reason), bound};
    }
    void simulate(Effect effect, std::string reason) { set(effect, Decision::simulate, std::move(reason)); }
    void skip(Effect effect, std::string reason) { set(effect, Decision::skip, std::move(reason)); }

    EffectBound bound_of(double radiance) const {
        const double luminance = radiance > 0.0 ? radiance * in_.luminance_scale : 0.0;
        return {luminance, luminance > 0.0 ? luminance / least_threshold() : 0.0};
    }
    double least_threshold() const { return visible_ ? visible_->threshold : 0.0; }

    /// Whether so much may be left out, which is then spent. Forced effects spend nothing.
    bool spend(Effect effect, const EffectBound& bound) {
        if (in_.settings.plan == EffectsPlanning::off || in_.settings.force.contains(effect)) return false;
        if (!(bound.thresholds <= left_)) return false;
        left_ -= bound.thresholds;
        return true;
    }

    /// Skips an effect if its bound fits into what is left.
    /// @param text  what there is, for the reason
    void skip_if_invisible(Effect effect, double radiance, const std::string& text) {
        const EffectBound bound = bound_of(radiance);
        if (bound.luminance == 0.0 || spend(effect, bound)) {
            set(effect, Decision::skip,
                bound.luminance == 0.0
                    ? "no " + text
                    : fmt::format("{} below {:.2g} visible thresholds", text, planned_thresholds(in_.settings)),
                bound);
        } else {
            simulate(effect, text);
        }
    }

    /// Effects that are there, or are not.
    void plan_presence() {
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

    /// Lights that can hardly bring anything are left out, the dimmest first.
    void plan_lights() {
        if (in_.facts.lights.empty()) return skip(E::direct_light, "there is no light");
        if (!scatters()) return skip(E::direct_light, "no surface scatters light");
        simulate(E::direct_light,
                 fmt::format("{} {}", in_.facts.lights.size(), in_.facts.lights.size() == 1 ? "light" : "lights"));
        if (!visible_ || in_.settings.plan == EffectsPlanning::off || in_.settings.force.contains(E::direct_light))
            return;
        std::vector<std::pair<double, std::size_t>> brought;
        for (std::size_t i = 0; i < in_.facts.lights.size(); ++i) {
            if (in_.facts.lights[i].kind == LightFacts::Kind::surroundings) continue;
            brought.emplace_back(bound_light(in_.facts, in_.facts.lights[i], in_.settings.bounces), i);
        }
        std::ranges::sort(brought);
        double sum = 0.0;
        for (const auto& [radiance, i] : brought) {
            if (!(bound_of(sum + radiance).thresholds <= 0.5 * left_)) break;
            sum += radiance;
            plan_.lights_left_out.push_back(in_.facts.lights[i]);
        }
        if (plan_.lights_left_out.empty()) return;
        const EffectBound bound = bound_of(sum);
        spend(E::direct_light, bound);
        const std::size_t count = plan_.lights_left_out.size(), all = in_.facts.lights.size();
        set(E::direct_light, count == all ? Decision::skip : Decision::simplify,
            fmt::format("{} of {} lights bring less than {:.2g} visible thresholds together", count, all,
                        0.5 * planned_thresholds(in_.settings)),
            bound);
    }

    void plan_shadows() {
        bool areas = false, areas_shadowed = false, points_shadowed = false;
        for (const LightFacts& light : in_.facts.lights) {
            areas = areas || light.has_area();
            bool& shadowed = light.has_area() ? areas_shadowed : points_shadowed;
            shadowed = shadowed || may_be_shadowed(in_.facts, light);
        }
        plan_.points_unshadowed = !points_shadowed && in_.settings.plan == EffectsPlanning::on;
        if (!areas) return skip(E::area_shadows, "no light has an area");
        if (!scatters()) return skip(E::area_shadows, "no surface scatters light");
        if (!areas_shadowed) return skip(E::area_shadows, "nothing stands between lights and surfaces");
        simulate(E::area_shadows, "something may stand between lights and surfaces");
    }

    void plan_indirect() {
        const RenderSettings& settings = in_.settings;
        const int bounces = std::min(settings.bounces, settings.path_depth - 1);
        if (bounces <= 0) {
            leave_to_user(E::indirect_diffuse, "the setting bounces is 0", bound_indirect_light(in_.facts, 1));
            skip(E::caustics, "there is no indirect light");
            skip(E::more_bounces, "there is no indirect light");
            return;
        }
        skip_if_invisible(E::indirect_diffuse, bound_indirect_light(in_.facts, bounces),
                          "light passes from surface to Lambert surface");
        if (plan_.skips(E::indirect_diffuse)) {
            plan_.of(E::indirect_diffuse).reason = plan_.of(E::indirect_diffuse).bound->luminance == 0.0
                                                       ? "no Lambert surface sees another that sends light"
                                                       : plan_.of(E::indirect_diffuse).reason;
            skip(E::caustics, "there is no indirect light");
            skip(E::more_bounces, "there is no indirect light");
            return;
        }
        const bool specular =
            std::ranges::any_of(in_.facts.objects, [](const auto& o) { return o.material.has_specular(); });
        specular ? simulate(E::caustics, "mirrors, glass or gloss may pass light to Lambert surfaces")
                 : skip(E::caustics, "no surface has gloss, a mirror or glass");
        if (bounces == 1) {
            leave_to_user(E::more_bounces, "the setting bounces is 1", bound_further_bounces(in_.facts, 1, 1000));
        } else {
            skip_if_invisible(E::more_bounces, bound_further_bounces(in_.facts, 1, bounces),
                              "light of second and further bounces");
        }
    }

    /// @param radiance  infinite where there is no bound
    void leave_to_user(Effect effect, std::string reason, double radiance) {
        const EffectBound bound = bound_of(radiance);
        const bool known = std::isfinite(bound.luminance);
        plan_.of(effect) = {Decision::skip, std::move(reason), known ? std::optional(bound) : std::nullopt, true};
    }

    void plan_lobes() {
        if (!any_seen(&MaterialFacts::glossy)) {
            skip(E::glossy_reflection,
                 any(&MaterialFacts::glossy) ? "no glossy surface can be seen" : "no material in use is glossy");
        } else {
            skip_if_invisible(E::glossy_reflection, bound_glossy_light(in_.facts, in_.settings.bounces),
                              "light for glossy surfaces to reflect");
        }
        any_seen(&MaterialFacts::mirror)
            ? simulate(E::mirror_reflection, "a smooth surface may be seen")
            : skip(E::mirror_reflection,
                   any(&MaterialFacts::mirror) ? "no mirror can be seen" : "no material in use is a mirror");
        any_seen(&MaterialFacts::glass)
            ? simulate(E::refraction, "glass may be seen")
            : skip(E::refraction, any(&MaterialFacts::glass) ? "no glass can be seen" : "no material in use is glass");
    }

    double largest_contrast() const {
        double shines = 0.0;
        for (const ObjectFacts& object : in_.facts.objects) {
            if (object.in_view) shines = std::max(shines, double{object.material.radiance});
        }
        return contrast_margin * visible_->brightest / in_.luminance_scale + shines;
    }

    /// Blur that is so small that the picture hardly changes.
    void plan_blur(Effect effect, double size, const BlurMoments& blur, const char* what) {
        simulate(effect, fmt::format("{} up to {:.3g} pixels", what, size));
        if (size == 0.0) return skip(effect, "nothing is blurred");
        if (!visible_ || !(size < half_pixel)) return;
        const EffectBound bound = bound_of(bound_blur(blur, in_.settings.filter) * largest_contrast());
        if (spend(effect, bound)) set(effect, Decision::skip, fmt::format("{} by {:.2g} pixels", what, size), bound);
    }

    void plan_camera() {
        const ShutterFacts& shutter = in_.shutter;
        if (!shutter.open) {
            skip(E::motion_blur, "the shutter opens for no time");
        } else if (!shutter.changes) {
            skip(E::motion_blur, "nothing changes while the shutter is open");
        } else if (shutter.blur) {
            plan_blur(E::motion_blur, shutter.largest, *shutter.blur, "the camera moves the picture");
        } else {
            simulate(E::motion_blur, "objects, lights or reflections may change while the shutter is open");
        }
        if (!(in_.lens.radius > 0.0)) return skip(E::depth_of_field, "the aperture is 0");
        const double radius = 0.5 * in_.lens.circle;
        plan_blur(E::depth_of_field, in_.lens.circle, {radius * 2.0 / 3.0, 0.0, 0.5 * radius * radius},
                  "circles of confusion");
    }

    void plan_shapes() {
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

    void plan_vision() {
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

    void plan_motion() {
        if (!in_.has_other) {
            skip(E::motion, "there is no other frame in this shot");
        } else if (in_.moves || in_.settings.motion == MotionSource::image) {
            simulate(E::motion, in_.moves ? "objects or the camera move" : "it is found from pictures");
        } else {
            skip(E::motion, "nothing moves into the next frame");
        }
    }

    /// --plan off simulates what the plan would leave out; --force and --forbid have the last word.
    void override_by_user() {
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

    const PlanInput& in_;
    const std::optional<VisibleFrame>& visible_;
    double left_;  ///< visible thresholds that may still be left out
    EffectsPlan plan_;
};

}  // namespace

const char* decision_name(Decision decision) {
    constexpr const char* names[] = {"simulate", "simplify", "skip"};
    return names[static_cast<int>(decision)];
}

EffectSet EffectsPlan::skipped() const {
    EffectSet set;
    for (std::size_t i = 0; i < effect_count; ++i) {
        if (effects[i].decision == Decision::skip) set.add(static_cast<Effect>(i));
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
