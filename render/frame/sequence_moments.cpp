// Key moments of a sequence: the scene and its views at other frames.

#include "render/frame/sequence_state.h"

namespace aleph {

/// Takes `now`, rays, shading and lights to a frame, for light that other frames read, whose plans may differ: only
/// what is forbidden is left out.
void SequenceState::show(std::int64_t frame) {
    move_to_frame(now, frame);
    update_rays_and_shading();
    lights = make_light_set(*shading);
    shading->skipped = settings.forbid;
    shading->points_unshadowed = false;
    if (settings.forbid.contains(Effect::direct_light)) remove_all_lights(lights);
}

/// Copies the scene as it is now.
void SequenceState::copy_now(KeyPose& pose) const {
    pose.posed = *now;
    pose.shading = make_shading_scene(scene, pose.posed.pose, rays, textures);
}

/// Key moments, taken from `now`, which is another frame afterwards.
MomentSource SequenceState::key_moments() {
    const auto light = [this](std::int64_t frame) {
        show(frame);
        return lighting();
    };
    const auto pose = [this, light](std::int64_t frame) {
        light(frame);
        const auto key = std::make_shared<KeyPose>();
        copy_now(*key);
        return key;
    };
    const auto look_at = [this](std::int64_t frame) {
        FrameOutput out;
        const auto view = std::make_shared<KeyView>();
        FramePlan plan;
        look(frame, is_guided(), false, out, plan);
        view->frame = frame;
        copy_now(*view);
        view->accuracy = std::move(out.alpha);
        view->rays = out.statistics.counts.rays;
        return view;
    };
    const auto cast = [this](const KeyView& view, RayCounts& counts) {
        if (!other_rays) other_rays = std::make_unique<RayScene>(rays.share_meshes());
        other_rays->update_moving(view.posed.pose, view.shading.anchor);
        const Lens lens = find_lens(scene, view.posed.pose.cameras[camera(view.frame)]);
        const SamplePlace place = make_sample_place(settings, lens, blended, noise_key(view.frame), 0);
        return cast_sample(*other_rays, view.posed.view, place, &counts.primary);
    };
    return {pose, look_at, cast, light};
}

/// The light of the key moments around a frame; null if it reads none. `now`, rays, shading and lights are those of the
/// frame before and after.
std::unique_ptr<CarriedLight> SequenceState::carry_light(std::int64_t frame, const FramePlan& plan,
                                                         std::vector<MomentStatistics>& filled) {
    if (!shot_light || plan.skips(Effect::indirect_diffuse)) return nullptr;
    std::unique_ptr<CarriedLight> light = shot_light->at(frame, filled);
    if (now->pose.seconds != find_seconds(frame)) {
        move_to_frame(now, frame);
        update_rays_and_shading();
        lights = make_light_set(*shading);
    }
    return light;
}

/// Of the scene, its settings and this program; made when it is first asked for.
const CacheFingerprint& SequenceState::fingerprint() {
    if (!cache_fingerprint) cache_fingerprint = make_cache_fingerprint(scene, settings, shots);
    return *cache_fingerprint;
}

/// Whether frames with a closed shutter read their indirect light from key moments.
bool SequenceState::reads_moments() const {
    return settings.integrator == Integrator::cache && settings.light_step > 0 && settings.bounces > 0 &&
           settings.path_depth > 1 && settings.accuracy > 0.0;
}

}  // namespace aleph
