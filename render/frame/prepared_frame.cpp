#include "render/frame/prepared_frame.h"

#include "perception/sanitize.h"
#include "render/frame/frame_vision.h"
#include "render/frame/sequence_state.h"
#include "render/settings/measure.h"
#include "render/settings/motion_source.h"

namespace aleph {

namespace {

/// Estimate, motion, blur and vision of a frame whose first hits are cast.
void perceive(SequenceState& s, const FrameScene& here, const FrameWork& work, StageClock& clock,
              PreparedFrame& frame) {
    const Shot& shot = s.shot;
    const FramePlan& plan = frame.plan;
    FrameOutput& out = frame.out;
    RayCounts& counts = out.statistics.counts.rays;
    std::optional<EstimateNodes> nodes;
    if (shot.estimates_indirect_light(plan.settings.light.bounces))
        nodes = s.estimate_light.find_nodes(work.frame, here, frame.centers, counts);
    work.report("estimate");
    const EstimateNodes* indirect = nodes ? &*nodes : nullptr;
    out.estimate = estimate_scene(shot, here, frame.centers, indirect, counts);
    note_estimate(out, sanitize_estimate(out.estimate), shot.scene.film.viewing);
    clock.add_to(out.statistics.seconds.estimate);
    work.report("motion");
    s.motion.compute(work, here, s.estimate_light, clock, frame);
    out.velocity = s.motion.find_velocity(work, here, frame);
    if (work.maps) s.motion.compute_backward(work, here, frame);
    clock.add_to(out.statistics.seconds.motion);
    work.report("vision");
    frame.swing = blur_frame_estimate({shot, work.frame, plan, here, s.shutter}, frame.centers, indirect, out.motion,
                                      out.estimate, counts);
    clock.add_to(out.statistics.seconds.estimate);
    RenderSettings vision = shot.settings;
    if (plan.skips(Effect::saliency) && vision.perception.guide == Guide::saliency)
        vision.perception.guide = Guide::full;
    compute_frame_vision(out, shot.scene, vision, s.noise(work), work.maps, clock);
}

}  // namespace

PreparedFrame prepare_frame(SequenceState& s, FrameScene& here, FrameWork work) {
    const Shot& shot = s.shot;
    PreparedFrame frame;
    FrameOutput& out = frame.out;
    FrameStatistics& stats = out.statistics;
    RayCounts& counts = stats.counts.rays;
    stats.frame = work.frame;
    work.other = work.perceive ? shot.other_frame(work.frame) : OtherFrame::none;

    work.report("pose");
    StageClock clock;
    here.pose(work.frame);
    out.view = here.posed().view;
    frame.plan = s.planner.begin(work, here.posed());
    clock.add_to(stats.seconds.pose);
    if (work.perceive && !work.motion_only && shot.estimates_indirect_light(frame.plan.settings.light.bounces)) {
        s.estimate_light.gather_around(work.frame, work.frame, counts);
        if (work.other != OtherFrame::none && picture_search(shot.settings.guide.motion))
            s.estimate_light.gather_around(other_frame_number(work.frame, work.other), work.frame, counts);
        here.pose(work.frame);  // gathering moved it if lighting keyframes are prepared in it
    }
    clock.add_to(stats.seconds.estimate);
    work.other = s.motion.pose_other(work, here.posed());
    clock.add_to(stats.seconds.pose);

    stats.instances_touched = here.prepare();
    here.leave_out(frame.plan.effects);
    here.find_media_around(counts.primary);
    clock.add_to(stats.seconds.update);

    work.report("first hits");
    frame.centers = cast_centers(here.rays(), out.view, &counts.primary);
    clock.add_to(stats.seconds.first_hits);
    if (work.motion_only) {
        s.motion.compute(work, here, s.estimate_light, clock, frame);
        return frame;
    }
    here.find_known_lights(frame.centers, counts);
    clock.add_to(stats.seconds.update);
    if (work.perceive) {
        perceive(s, here, work, clock, frame);
    } else {
        out.perception.aleph = Image<float>(shot.settings.picture.width, shot.settings.picture.height, 1.0f);
        out.limits.alpha = Image<float>(shot.settings.picture.width, shot.settings.picture.height,
                                        static_cast<float>(shot.settings.cache.accuracy));
    }
    s.planner.finish(frame.centers.hits, out, frame.plan);
    return frame;
}

Image<Outline> find_visible_outlines(const Shot& shot, const ShadingScene& shading, const PreparedFrame& frame) {
    const FrameOutput& out = frame.out;
    if (out.limits.threshold.empty()) return {};
    Image<Outline> outlines = find_outlines(out.view, frame.centers.hits, out.motion);
    mark_small_objects(outlines, out.view, frame.centers.hits, shading);
    const double asked = frame.plan.settings.error, error = asked > 0.0 ? asked : 1.0;
    mark_contrasts(outlines, out.estimate, out.limits.threshold, error / shot.scene.film.viewing.display_white);
    return outlines;
}

VisibleLimits make_visible_limits(const Shot& shot, const PreparedFrame& frame, const Image<Outline>& outlines) {
    const ErrorLimits& limits = frame.out.limits;
    return {limits.threshold, limits.threshold_noise, frame.out.perception.aleph, limits.alpha, outlines,
            frame.swing,      shot.scene.film.viewing};
}

Image<float> find_record_tolerance(const Shot& shot, const ShadingScene& shading, const PreparedFrame& keyframe) {
    const RenderSettings& settings = keyframe.plan.settings;
    if (!(settings.error > 0.0) || keyframe.out.limits.threshold.empty()) return {};
    const Image<Outline> outlines = find_visible_outlines(shot, shading, keyframe);
    return compute_sampling_tolerance(make_visible_limits(shot, keyframe, outlines), settings, shot.exposure);
}

}  // namespace aleph
