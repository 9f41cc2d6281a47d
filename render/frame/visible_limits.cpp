#include "render/frame/visible_limits.h"

namespace aleph {

Image<Outline> find_visible_outlines(const Shot& shot, const ShadingScene& shading, const PreparedFrame& frame) {
    const FrameOutput& out = frame.out;
    if (out.limits.threshold.empty()) return {};
    Image<Outline> outlines = find_outlines(out.view, frame.centers.hits, out.motion);
    mark_small_objects(outlines, out.view, frame.centers.hits, shading);
    const double asked = frame.plan.settings.error, error = asked > 0.0 ? asked : 1.0;
    mark_contrasts(outlines, out.estimate, out.limits.threshold, error / shot.scene.film.viewing.display_white);
    return outlines;
}

VisibleLimits make_visible_limits(const Shot& shot, const FrameOutput& out, const Image<Outline>& outlines) {
    return {out.limits.threshold,   out.limits.threshold_noise, out.perception.aleph, out.limits.alpha, outlines,
            shot.scene.film.viewing};
}

Image<float> find_record_tolerance(const Shot& shot, const ShadingScene& shading, const PreparedFrame& keyframe) {
    const RenderSettings& settings = keyframe.plan.settings;
    if (!(settings.error > 0.0) || keyframe.out.limits.threshold.empty()) return {};
    const Image<Outline> outlines = find_visible_outlines(shot, shading, keyframe);
    return compute_sampling_tolerance(make_visible_limits(shot, keyframe.out, outlines), settings, shot.exposure);
}

}  // namespace aleph
