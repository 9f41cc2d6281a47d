// What shutter and lens do to the stages before the picture.

#include "engine/base/errors.h"
#include "perception/sanitize.h"
#include "render/blurred_estimate.h"
#include "render/sequence_state.h"

namespace aleph {

Lens find_lens(const Scene& scene, const CameraValues& camera) {
    if (!(camera.aperture > 0.0)) return {};
    if (!(camera.focus_distance > 0.0)) {
        throw InputError(scene.file, "camera of node " + printable(scene.nodes[camera.node].name),
                         "with an aperture, its focus distance has to be above 0");
    }
    return {camera.aperture, camera.focus_distance};
}

/// Of the camera at a frame, if something can change while it is open.
std::optional<ShutterInterval> SequenceState::find_open_shutter(std::int64_t frame) const {
    return can_change() ? find_shutter(scene, shutter, frame) : std::nullopt;
}

/// The scene while the shutter is open, valid until the next call.
/// @param at  frames
SampleMoment SequenceState::look_at(double at) {
    if (!open) open = std::make_unique<OpenShutter>(scene, pose_plan, textures, rays, camera);
    return open->move_to(at / scene.frame_rate.per_second(), settings.width, settings.height);
}

/// Blurs the sharp estimate by shutter and lens, if they are open. Motion remains that of the shutter's centre.
void SequenceState::blur_frame_estimate(std::int64_t frame, const SampleHits& centers, const EstimateNodes* nodes,
                                        FrameOutput& out) {
    const Lens lens = find_lens(scene, now->pose.cameras[camera]);
    const std::optional<ShutterInterval> interval = find_open_shutter(frame);
    if (!interval && !(lens.radius > 0.0)) return;
    const SharpEstimate sharp{*shading, out.view, centers, out.estimate, nodes, settings.estimate, exposure};
    const auto look = [&](double place) -> SampleMoment {
        if (!interval) return {lighting(), out.view};
        return look_at(interval->open + (interval->close - interval->open) * place);
    };
    Image<Rgb> blurred = blur_estimate(sharp, lens, look, out.statistics.counts.rays);
    sanitize_estimate(blurred);
    out.estimate = std::move(blurred);
}

}  // namespace aleph
