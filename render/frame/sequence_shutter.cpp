// What shutter and lens do to the stages before the picture.

#include "engine/base/errors.h"
#include "perception/sanitize.h"
#include "render/frame/blurred_estimate.h"
#include "render/frame/sequence_state.h"

namespace aleph {

namespace {

/// Of a camera, by its index in ScenePose::cameras.
glm::dvec2 read_shutter(const Scene& scene, int camera) {
    for (const Node& node : scene.nodes) {
        if (node.camera != no_index && camera-- == 0) return scene.cameras[node.camera].shutter;
    }
    return glm::dvec2(0.0);
}

}  // namespace

Lens find_lens(const Scene& scene, const CameraValues& camera) {
    if (!(camera.aperture > 0.0)) return {};
    if (!(camera.focus_distance > 0.0)) {
        throw InputError(scene.file, "camera of node " + printable(scene.nodes[camera.node].name),
                         "with an aperture, its focus distance has to be above 0");
    }
    return {camera.aperture, camera.focus_distance};
}

/// Of a frame's camera.
glm::dvec2 SequenceState::shutter(std::int64_t frame) const {
    return read_shutter(scene, camera(frame));
}

/// Of the camera at a frame, if something can change while it is open.
std::optional<ShutterInterval> SequenceState::find_open_shutter(std::int64_t frame) const {
    return can_change() ? find_shutter(scene, shutter(frame), frame) : std::nullopt;
}

/// The scene while the shutter of a frame is open, valid until the next call.
/// @param at  frames
SampleMoment SequenceState::look_at(std::int64_t frame, double at) {
    if (!open) open = std::make_unique<OpenShutter>(scene, pose_plan, textures, rays);
    EffectSet skipped = shading->skipped;
    if (!settings.forbid.contains(Effect::direct_light)) skipped.remove(Effect::direct_light);  // lamps are still seen
    return open->move_to(at / scene.frame_rate.per_second(), camera(frame), settings.width, settings.height, skipped);
}

/// Blurs the sharp estimate by shutter and lens, if they are open. Motion remains that of the shutter's centre.
void SequenceState::blur_frame_estimate(std::int64_t frame, const SampleHits& centers, const EstimateNodes* nodes,
                                        const FramePlan& plan, FrameOutput& out) {
    Lens lens;
    std::optional<ShutterInterval> interval;
    if (!plan.skips(Effect::depth_of_field)) lens = find_lens(scene, now->pose.cameras[camera(frame)]);
    if (!plan.skips(Effect::motion_blur)) interval = find_open_shutter(frame);
    if (!interval && !(lens.radius > 0.0)) return;
    const SharpEstimate sharp{*shading, out.view, centers, out.estimate, nodes, settings.estimate, exposure};
    const auto look = [&](double place) -> SampleMoment {
        if (!interval) return {lighting(), out.view};
        return look_at(frame, interval->open + (interval->close - interval->open) * place);
    };
    Image<Rgb> blurred = blur_estimate(sharp, lens, look, out.statistics.counts.rays);
    sanitize_estimate(blurred);
    out.estimate = std::move(blurred);
}

}  // namespace aleph
