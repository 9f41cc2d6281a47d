// The parts of an effects plan that have bounds: light, and blur.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/plan/effects_planner.h"

namespace aleph {

namespace {

constexpr double half_pixel = 0.5;
constexpr double contrast_margin = 2.0;  // highlights may be brighter than what the estimate shows

}  // namespace

/// Lights that can hardly bring anything are left out, the dimmest first.
void Planner::plan_lights() {
    if (in_.facts.lights.empty()) return skip(E::direct_light, "there is no light");
    if (!scatters()) return skip(E::direct_light, "no surface scatters light");
    simulate(E::direct_light,
             fmt::format("{} {}", in_.facts.lights.size(), in_.facts.lights.size() == 1 ? "light" : "lights"));
    if (!visible_ || in_.settings.plan == EffectsPlanning::off || in_.settings.force.contains(E::direct_light)) return;
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

void Planner::plan_shadows() {
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

void Planner::plan_indirect() {
    const RenderSettings& settings = in_.settings;
    const int bounces = std::min(settings.bounces, settings.path_depth - 1);
    if (bounces <= 0) {
        leave_to_user(E::indirect_diffuse, "the setting bounces is 0", bound_indirect_light(in_.facts, 1));
        skip(E::caustics, "there is no indirect light");
        skip(E::more_bounces, "there is no indirect light");
        return;
    }
    skip_if_invisible(E::indirect_diffuse, bound_indirect_light(in_.facts, bounces),
                      "light passes from surface to surface", "no Lambert surface sees another that sends light");
    if (plan_.skips(E::indirect_diffuse)) {
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
                          "light of second and further bounces", "no light of a second bounce");
    }
}

void Planner::plan_lobes() {
    if (!any_seen(&MaterialFacts::glossy)) {
        skip(E::glossy_reflection,
             any(&MaterialFacts::glossy) ? "no glossy surface can be seen" : "no material in use is glossy");
    } else {
        skip_if_invisible(E::glossy_reflection, bound_glossy_light(in_.facts, in_.settings.bounces),
                          "glossy surfaces reflect light", "there is no light that glossy surfaces reflect");
    }
    any_seen(&MaterialFacts::mirror)
        ? simulate(E::mirror_reflection, "a smooth surface may be seen")
        : skip(E::mirror_reflection,
               any(&MaterialFacts::mirror) ? "no mirror can be seen" : "no material in use is a mirror");
    any_seen(&MaterialFacts::glass)
        ? simulate(E::refraction, "glass may be seen")
        : skip(E::refraction, any(&MaterialFacts::glass) ? "no glass can be seen" : "no material in use is glass");
}

double Planner::largest_contrast() const {
    double shines = 0.0;
    for (const ObjectFacts& object : in_.facts.objects) {
        if (object.in_view) shines = std::max(shines, double{object.material.radiance});
    }
    return contrast_margin * visible_->brightest / in_.luminance_scale + shines;
}

/// Blur that is so small that the picture hardly changes.
void Planner::plan_blur(Effect effect, double size, const BlurMoments& blur, const char* what) {
    simulate(effect, fmt::format("{} up to {:.3g} pixels", what, size));
    if (size == 0.0) return skip(effect, "nothing is blurred");
    if (!visible_ || !(size < half_pixel)) return;
    const EffectBound bound =
        bound_of(bound_blur(blur, in_.settings.filter) * largest_contrast(), in_.scene.environment_image != no_index);
    if (spend(effect, bound)) set(effect, Decision::skip, fmt::format("{} by {:.2g} pixels", what, size), bound);
}

void Planner::plan_camera() {
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

}  // namespace aleph
