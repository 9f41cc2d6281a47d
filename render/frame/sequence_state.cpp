#include "render/frame/sequence_state.h"

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/pose/cage_level.h"
#include "engine/rays/alpha_cutout.h"
#include "motion/image_motion.h"
#include "motion/still_motion.h"
#include "perception/sanitize.h"
#include "render/estimate/estimate.h"
#include "render/frame/frame_vision.h"
#include "render/guide/accuracy_map.h"
#include "render/pixels/sample_place.h"
#include "render/surface/texture.h"

namespace aleph {

namespace {

/// A change of cameras begins a shot.
Scene add_camera_cuts(Scene scene, const std::vector<CameraShot>& shots) {
    for (std::size_t i = 1; i < shots.size(); ++i) scene.cuts.push_back(shots[i].first);
    std::ranges::sort(scene.cuts);
    const auto repeated = std::ranges::unique(scene.cuts);
    scene.cuts.erase(repeated.begin(), repeated.end());
    return scene;
}

/// The scene with its subdivision cages at the levels that the picture needs.
Scene refine_cages(Scene scene, const std::vector<CameraShot>& shots, const RenderSettings& settings) {
    if (scene.cages.empty()) return scene;
    std::vector<int> levels(scene.cages.size(), settings.subdivision_level);
    for (const CameraShot& shot : shots) {
        if (settings.subdivision_level >= 0) break;
        const std::vector<int> needed = choose_cage_levels(scene, shot.camera, settings.width, settings.height);
        std::ranges::transform(levels, needed, levels.begin(), [](int a, int b) { return std::max(a, b); });
    }
    const std::unique_ptr<Scene> refined = make_scene_at_levels(scene, levels);
    return refined ? std::move(*refined) : std::move(scene);
}

bool is_cut(const Scene& scene, std::int64_t frame) {
    return std::find(scene.cuts.begin(), scene.cuts.end(), frame) != scene.cuts.end();
}

/// Motion to the next frame; from the previous one at the scene's last frame; none across a cut.
OtherFrame find_other_frame(const Scene& scene, const FrameRange& range, std::int64_t frame) {
    const bool is_last = frame == range.last && range.last > range.first;
    if (is_cut(scene, is_last ? frame : frame + 1)) return OtherFrame::none;
    return is_last ? OtherFrame::previous : OtherFrame::next;
}

}  // namespace

SequenceState::SequenceState(Scene given, const RenderSettings& chosen, const std::vector<CameraShot>& camera_shots)
    : scene(refine_cages(add_camera_cuts(std::move(given), camera_shots), camera_shots, chosen)),
      settings(chosen),
      shots(camera_shots),
      range(frame_range(scene)),
      textures(make_texture_set(scene)),
      pose_plan(make_pose_plan(scene)),
      holds(scene, pose_plan, shots, [this](std::int64_t frame) { return shutter(frame); }),
      rays(scene, pose_plan),
      blended(has_blended(scene)),
      light_breaks(scene, pose_plan, shutter(range.first)),
      steady(scene, pose_plan),
      camera_span(scene, pose_plan) {
    if (!reads_moments()) return;
    const auto find_breaks = [this](std::int64_t first, std::int64_t last) { return light_breaks.find(first, last); };
    shot_light.emplace(KeyMoments{range, scene.cuts, settings.light_step, find_breaks}, settings,
                       !is_world_animated(scene), !can_change(), key_moments());
}

/// The moment that stands for a frame.
double SequenceState::find_seconds(std::int64_t frame) const {
    return can_change() ? find_shutter_center(scene, shutter(frame), frame) : scene.frame_rate.seconds_of(frame);
}

/// Takes `posed` to a frame. Its first call poses the whole scene, later calls only what can move.
void SequenceState::move_to_frame(std::optional<PosedView>& posed, std::int64_t frame) const {
    const double seconds = find_seconds(frame);
    if (posed) {
        update_posed_view(scene, pose_plan, seconds, camera(frame), *posed);
    } else {
        posed = make_posed_view(scene, seconds, camera(frame), settings.width, settings.height);
    }
}

/// The quick estimate of a posed view to which `view_rays` have been updated, not sanitized.
/// @param indirect  the view's frame, if its indirect light is wanted, after prepare_estimate of that frame
Image<Rgb> SequenceState::estimate_view(const RayScene& view_rays, const PosedView& posed, EstimateKind kind,
                                        std::optional<std::int64_t> indirect, RayCounts& counts) {
    ShadingScene view_shading = make_shading_scene(scene, posed.pose, view_rays, textures);
    view_shading.skipped = settings.forbid;
    LightSet view_lights = make_light_set(view_shading);
    if (settings.forbid.contains(Effect::direct_light)) remove_all_lights(view_lights);
    const LightingContext view_lighting{view_shading, view_lights, view_rays};
    const SampleHits centers = cast_centers(view_rays, posed.view, &counts.primary);
    std::optional<EstimateNodes> nodes;
    if (indirect) nodes = gather_estimate(view_lighting, posed.view, centers, carry_estimate(*indirect).get(), counts);
    return compute_estimate(view_lighting, posed.view, centers, kind, nodes ? &*nodes : nullptr, exposure, counts);
}

/// Gathers the estimates of the key moments around a frame, unless they are kept. `now` is another frame afterwards.
/// @param but  a moment that is looked at next, so that it need not be gathered here
void SequenceState::prepare_estimate(std::int64_t frame, std::int64_t but, RayCounts& counts) {
    if (!shot_light) return;
    const MomentPair pair = shot_light->moments_around(frame);
    for (const std::int64_t moment : {pair.before, pair.after}) {
        if (estimate_moments.find(moment)) continue;
        for (const std::int64_t needed : {shot_light->find_base(moment), moment}) {
            if (needed == moment && moment == but) continue;
            if (estimate_moments.find(needed)) continue;
            show(needed);
            find_estimate_nodes(needed, cast_centers(rays, now->view, &counts.primary), counts);
        }
    }
}

/// After prepare_estimate of the frame; null if there are no key moments.
std::unique_ptr<CarriedEstimate> SequenceState::carry_estimate(std::int64_t frame) {
    if (!shot_light) return nullptr;
    const MomentPair pair = shot_light->moments_around(frame);
    const auto before = estimate_moments.find(pair.before), after = estimate_moments.find(pair.after);
    if (!before || !after) return nullptr;
    return std::make_unique<BlendedEstimate>(before, after, pair.weight);
}

/// The estimate's nodes for `now`, which is this frame. Those of a key moment are kept.
EstimateNodes SequenceState::find_estimate_nodes(std::int64_t frame, const SampleHits& centers, RayCounts& counts) {
    const bool is_moment = shot_light && shot_light->moments_around(frame).before == frame;
    if (!is_moment) return gather_estimate(lighting(), now->view, centers, carry_estimate(frame).get(), counts);
    if (const auto kept = estimate_moments.find(frame)) return kept->nodes;
    std::optional<BlendedEstimate> carried;
    if (const std::int64_t base = shot_light->find_base(frame); base != frame) {
        const auto kept = estimate_moments.find(base);
        carried.emplace(kept, kept, 0.0);
    }
    const auto moment = std::make_shared<EstimateMoment>(
        frame, gather_estimate(lighting(), now->view, centers, carried ? &*carried : nullptr, counts));
    copy_now(*moment);
    estimate_moments.keep(moment);
    return moment->nodes;
}

/// @return the nodes of its indirect light, if it has any
std::optional<EstimateNodes> SequenceState::compute_frame_estimate(std::int64_t frame, const SampleHits& centers,
                                                                   const FramePlan& plan, FrameOutput& out) {
    RayCounts& counts = out.statistics.counts.rays;
    std::optional<EstimateNodes> nodes;
    if (estimates_indirect_light(plan.settings.bounces)) nodes = find_estimate_nodes(frame, centers, counts);
    const bool tolerance = needs_indirect_luminance(settings, plan.maps);
    out.estimate = compute_estimate(lighting(), out.view, centers, settings.estimate, nodes ? &*nodes : nullptr,
                                    exposure, counts, tolerance ? &out.indirect_luminance : nullptr);
    note_estimate(out, sanitize_estimate(out.estimate), scene.viewing);
    return nodes;
}

/// Brings rays and shading to `now`. @return instances that were updated
std::size_t SequenceState::update_rays_and_shading() {
    const std::size_t touched = rays.update_moving(now->pose, compute_anchor(now->view));
    if (shading) {
        update_shading_scene(*shading, pose_plan, rays);
    } else {
        shading = make_shading_scene(scene, now->pose, rays, textures);
    }
    return touched;
}

/// Brings other_rays to `other`.
void SequenceState::update_other_rays() {
    if (other_is_before_edit) {
        other_rays = std::make_unique<RayScene>(scene, make_plan_of_all());
        other_rays->update(other->pose, compute_anchor(other->view));
        return;
    }
    if (!other_rays) other_rays = std::make_unique<RayScene>(rays.share_meshes());
    other_rays->update_moving(other->pose, compute_anchor(other->view));
}

/// Motion from `now` to `other`.
/// With maps, it also finds the pixels that are hidden in the other frame.
void SequenceState::compute_motion(const SampleHits& centers, OtherFrame which, const FramePlan& plan,
                                   StageClock& clock, FrameOutput& out) {
    FrameStatistics& stats = out.statistics;
    const bool has_other = which != OtherFrame::none;
    if (has_other && plan.skips(Effect::motion)) {
        out.motion = make_still_motion(out.view, centers.hits);
        return;
    }
    if (settings.motion == MotionSource::model) {
        if (!model_motion) model_motion.emplace(scene, pose_plan);
        out.motion = model_motion->compute(*now, has_other ? *other : *now, centers.hits, which);
        if (!has_other || !plan.maps) return;
        update_other_rays();
        stats.counts.rays.primary += mark_hidden(out.motion, scene, *other, centers.hits, *other_rays);
        return;
    }
    Image<Rgb> other_estimate;
    if (has_other) {
        update_other_rays();
        std::optional<std::int64_t> indirect;
        if (estimates_indirect_light(plan.settings.bounces)) indirect = other_frame_number(stats.frame, which);
        other_estimate = estimate_view(*other_rays, *other, settings.estimate, indirect, stats.counts.rays);
        sanitize_estimate(other_estimate);
    }
    clock.add_to(stats.seconds.estimate);
    out.motion = compute_image_motion(out.estimate, other_estimate, which);
}

/// The stages before the picture: pose, first hits and, if asked for, estimate, motion, perception. Afterwards `now`,
/// rays, shading and lights are those of the frame.
/// @param maps  every map
/// @param plan  set to the frame's plan
/// @return hits through the pixel centres
SampleHits SequenceState::look(std::int64_t frame, bool perceive, bool maps, FrameOutput& out, FramePlan& plan,
                               bool edited) {
    OtherFrame which = perceive ? find_other_frame(scene, range, frame) : OtherFrame::none;
    FrameStatistics& stats = out.statistics;
    stats.frame = frame;
    StageClock clock;
    move_to_frame(now, frame);
    plan = begin_plan(frame, which, perceive, maps, edited);
    clock.add_to(stats.seconds.pose);
    if (perceive && estimates_indirect_light(plan.settings.bounces)) {
        prepare_estimate(frame, frame, stats.counts.rays);
        if (which != OtherFrame::none && settings.motion == MotionSource::image) {
            prepare_estimate(other_frame_number(frame, which), frame, stats.counts.rays);
        }
    }
    clock.add_to(stats.seconds.estimate);
    move_to_frame(now, frame);
    if (edited && perceive) {
        which = take_pose_before_edit(frame);
    } else if (which != OtherFrame::none) {
        move_to_frame(other, other_frame_number(frame, which));
    }
    out.view = now->view;
    clock.add_to(stats.seconds.pose);

    stats.instances_touched = update_rays_and_shading();
    lights = make_light_set(*shading);
    leave_out(plan.effects);
    clock.add_to(stats.seconds.update);

    SampleHits centers = cast_centers(rays, out.view, &stats.counts.rays.primary);
    clock.add_to(stats.seconds.first_hits);

    if (perceive) {
        const std::optional<EstimateNodes> nodes = compute_frame_estimate(frame, centers, plan, out);
        clock.add_to(stats.seconds.estimate);
        compute_motion(centers, which, plan, clock, out);
        blur_frame_estimate(frame, centers, nodes ? &*nodes : nullptr, plan, out);
        clock.add_to(stats.seconds.estimate);
        RenderSettings vision = settings;
        if (plan.skips(Effect::saliency) && vision.perception.guide == Guide::saliency)
            vision.perception.guide = Guide::full;
        compute_frame_vision(out, scene, vision, maps, clock);
    } else {
        out.perception.aleph = Image<float>(settings.width, settings.height, 1.0f);
        out.alpha = Image<float>(settings.width, settings.height, static_cast<float>(settings.accuracy));
    }
    return centers;
}

}  // namespace aleph
