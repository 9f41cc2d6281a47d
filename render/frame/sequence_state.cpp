#include "render/frame/sequence_state.h"

#include "render/frame/prepared_frame.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

namespace {

/// The scene at lighting keyframes and as their cameras see it. Poses `keyframe` and, for first samples, the other
/// frame's scene.
KeyframeSource make_keyframe_source(SequenceState& s) {
    const auto light = [&s](std::int64_t frame, RayCounts& counts) {
        s.keyframe.pose(frame);
        s.keyframe.prepare();
        const SampleHits centers = cast_centers(s.keyframe.rays(), s.keyframe.posed().view, &counts.primary);
        s.keyframe.find_known_lights(centers, counts);
        return s.keyframe.lighting();
    };
    const auto pose = [&s](std::int64_t frame) {
        s.keyframe.pose(frame);
        s.keyframe.prepare();
        const auto key = std::make_shared<KeyPose>();
        s.keyframe.copy_to(*key);
        return key;
    };
    const auto look = [&s](std::int64_t frame) {
        const bool perceive = s.shot.is_guided() || s.shot.settings.error > 0.0;
        PreparedFrame prepared = prepare_frame(s, s.keyframe, {.frame = frame, .perceive = perceive, .lasts = true});
        const auto view = std::make_shared<KeyView>();
        view->frame = frame;
        s.keyframe.copy_to(*view);
        view->accuracy = std::move(prepared.out.limits.alpha);
        view->tolerance = find_record_tolerance(s.shot, s.keyframe.shading(), prepared);
        view->rays = prepared.out.statistics.counts.rays;
        return view;
    };
    const auto cast = [&s](const KeyView& view, RayCounts& counts) {
        FrameScene& scene = s.motion.other();
        scene.pose(view.frame);
        scene.update_rays();
        const Lens lens = find_lens(s.shot.scene, view.posed.pose.cameras[s.shot.camera(view.frame)]);
        const SamplePlace place =
            make_sample_place(s.shot.settings, lens, s.shot.blended, s.shot.noise_key(view.frame), 0);
        return cast_sample(scene.rays(), view.posed.view, place, &counts.primary);
    };
    return {pose, look, cast, light};
}

}  // namespace

SequenceState::SequenceState(Scene given, const RenderSettings& settings, const std::vector<CameraShot>& shots)
    : shot(std::move(given), settings, shots),
      static_spans(shot.scene, shot.pose_plan, shot.shots, [this](std::int64_t frame) { return shot.shutter(frame); }),
      here(shot, shot.pose_plan),
      keyframe(shot, here),
      light_breaks(shot.scene, shot.pose_plan, [this](std::int64_t frame) { return shot.seconds(frame); }),
      planner(shot, light_breaks),
      estimate_light(shot, shot_light, keyframe),
      motion(shot, here),
      shutter(shot, here) {
    if (!reads_keyframes(shot.settings)) return;
    const auto find_breaks = [this](std::int64_t first, std::int64_t last) { return light_breaks.find(first, last); };
    shot_light.emplace(LightingKeyframes{shot.range, shot.scene.film.cuts, shot.settings.cache.light_step, find_breaks},
                       shot.settings, !is_world_animated(shot.scene), !shot.can_change(), make_keyframe_source(*this));
}

PreparedFrame SequenceState::prepare(std::int64_t frame, bool perceive, bool maps, const FrameProgress& progress) {
    FrameWork work{.frame = frame, .perceive = perceive, .maps = maps, .progress = progress};
    work.edited = motion.is_edited();
    work.lasts = !work.edited && static_spans.find_first(frame + 1) == frame;
    return prepare_frame(*this, here, work);
}

const NoiseVisibility& SequenceState::noise(const FrameWork& work) {
    const bool lasts = work.lasts || shot.keeps_noise(work.frame);
    std::optional<NoiseVisibility>& known = lasts ? lasting_noise : fresh_noise;
    if (!known)
        known.emplace(shot.scene.film.viewing, shot.scene.film.frame_rate,
                      lasts ? NoiseOverTime::lasts : NoiseOverTime::fresh);
    return *known;
}

std::unique_ptr<CarriedLight> find_carried_light(SequenceState& s, std::int64_t frame, const FramePlan& plan,
                                                 std::vector<KeyframeStatistics>& filled, const FrameRequest& request) {
    if (!s.shot_light || plan.skips(Effect::indirect_diffuse)) return nullptr;
    return s.shot_light->at(frame, {filled, request.progress, request.checkpoint});
}

}  // namespace aleph
