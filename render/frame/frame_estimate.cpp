#include "render/frame/frame_estimate.h"

#include "perception/sanitize.h"
#include "render/frame/blurred_estimate.h"

namespace aleph {

Image<Rgb> estimate_scene(const Shot& shot, const FrameScene& scene, const SampleHits& centers,
                          const EstimateNodes* nodes, RayCounts& counts) {
    return compute_estimate(scene.lighting(), scene.posed().view, centers,
                            {shot.settings.guide.estimate, nodes, shot.exposure}, counts);
}

void EstimateLight::gather_around(std::int64_t frame, std::int64_t but, RayCounts& counts) {
    if (!shot_light_) return;
    const KeyframePair pair = shot_light_->keyframes_around(frame);
    for (const std::int64_t keyframe : {pair.before, pair.after}) {
        if (kept_.find(keyframe)) continue;
        for (const std::int64_t needed : {shot_light_->find_base(keyframe), keyframe}) {
            if (needed == keyframe && keyframe == but) continue;
            if (kept_.find(needed)) continue;
            keyframe_.pose(needed);
            keyframe_.prepare();
            find_nodes(needed, keyframe_, cast_centers(keyframe_.rays(), keyframe_.posed().view, &counts.primary),
                       counts);
        }
    }
}

/// Null if there are no lighting keyframes.
std::unique_ptr<CarriedEstimate> EstimateLight::carry(std::int64_t frame) const {
    if (!shot_light_) return nullptr;
    const KeyframePair pair = shot_light_->keyframes_around(frame);
    const auto before = kept_.find(pair.before), after = kept_.find(pair.after);
    if (!before || !after) return nullptr;
    return std::make_unique<BlendedEstimate>(before, after, pair.weight);
}

EstimateNodes EstimateLight::gather_nodes(std::int64_t frame, const FrameScene& scene, const SampleHits& centers,
                                          RayCounts& counts) const {
    return gather_estimate(scene.lighting(), scene.posed().view, centers, carry(frame).get(), counts);
}

EstimateNodes EstimateLight::find_nodes(std::int64_t frame, const FrameScene& scene, const SampleHits& centers,
                                        RayCounts& counts) {
    const bool is_keyframe = shot_light_ && shot_light_->keyframes_around(frame).before == frame;
    if (!is_keyframe) return gather_nodes(frame, scene, centers, counts);
    if (const auto kept = kept_.find(frame)) return kept->nodes;
    std::optional<BlendedEstimate> carried;
    if (const std::int64_t base = shot_light_->find_base(frame); base != frame) {
        const auto kept = kept_.find(base);
        carried.emplace(kept, kept, 0.0);
    }
    const auto keyframe = std::make_shared<EstimateKeyframe>(
        frame, gather_estimate(scene.lighting(), scene.posed().view, centers, carried ? &*carried : nullptr, counts));
    scene.copy_to(*keyframe);
    kept_.keep(keyframe);
    return keyframe->nodes;
}

OpenLens find_open_lens(const Shot& shot, std::int64_t frame, const FrameScene& scene, const FramePlan& plan) {
    OpenLens open;
    if (!plan.skips(Effect::depth_of_field))
        open.lens = find_lens(shot.scene, scene.posed().pose.cameras[shot.camera(frame)]);
    if (!plan.skips(Effect::motion_blur)) open.shutter = shot.open_shutter(frame);
    return open;
}

SampleScene open_scene(const Shot& shot, std::int64_t frame, double at, const FrameScene& scene, FrameScene& shutter) {
    EffectSet skipped = scene.shading().skipped;
    // The plan knows the lights at the shutter's centre alone: at other times lamps are seen and cast shadows.
    for (const Effect effect : {Effect::direct_light, Effect::area_shadows})
        if (!shot.settings.effects.forbid.contains(effect)) skipped.remove(effect);
    shutter.pose(at / shot.scene.film.frame_rate.per_second(), shot.camera(frame), shot.settings.picture.width,
                 shot.settings.picture.height);
    shutter.prepare();
    shutter.leave_out(skipped);
    shutter.take_media_around(scene);
    return shutter.sample_scene();
}

void blur_frame_estimate(const OpenFrame& frame, const SampleHits& centers, const EstimateNodes* nodes,
                         Image<Rgb>& sharp, RayCounts& counts) {
    const Shot& shot = frame.shot;
    const FrameScene& scene = frame.scene;
    const OpenLens open = find_open_lens(shot, frame.number, scene, frame.plan);
    if (!open.shutter && !(open.lens.radius > 0.0)) return;
    const SharpEstimate estimate{scene.shading(), scene.posed().view,           centers,      sharp,
                                 nodes,           shot.settings.guide.estimate, shot.exposure};
    const auto look = [&](double place) -> SampleScene {
        if (!open.shutter) return scene.sample_scene();
        const double at = open.shutter->open + (open.shutter->close - open.shutter->open) * place;
        return open_scene(shot, frame.number, at, scene, frame.shutter);
    };
    Image<Rgb> blurred = blur_estimate(estimate, open.lens, look, counts);
    sanitize_estimate(blurred);
    sharp = std::move(blurred);
}

}  // namespace aleph
