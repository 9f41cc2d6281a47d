#pragma once
// Data that all frames of a sequence share: the scene, its settings, and all that follows from the two alone.

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/pose/pose.h"
#include "engine/pose/steady.h"
#include "engine/scene/scene.h"
#include "motion/motion_field.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/settings/settings.h"
#include "render/surface/shading_scene.h"
#include "render/time/lighting_keyframes.h"
#include "render/time/shutter.h"

namespace aleph {

/// @throws InputError if the camera has an aperture without a focus distance
Lens find_lens(const Scene& scene, const CameraValues& camera);

/// Const but for the exposure and is_dark, which Sequence sets once. Frames are integers, times are seconds.
struct Shot {
    /// @param camera_shots  list_camera_shots(given, name)
    Shot(Scene given, const RenderSettings& chosen, const std::vector<CameraShot>& camera_shots);
    Shot(const Shot&) = delete;

    /// The scene as it was given: what a picture of this size adds to it is not its own.
    Scene given_scene() const;
    /// Index into ScenePose::cameras of the camera of a frame.
    int camera(std::int64_t frame) const { return camera_at(shots, frame); }
    /// Open and close of the frame's camera, frames relative to the frame.
    glm::dvec2 shutter(std::int64_t frame) const;
    /// The shutter of a frame, if something can change while it is open.
    std::optional<ShutterInterval> open_shutter(std::int64_t frame) const;
    /// The time that stands for a frame: its shutter's centre.
    double seconds(std::int64_t frame) const;
    /// The frame that a frame's motion leads to: the next one; the previous one at the scene's last frame; none across
    /// a cut.
    OtherFrame other_frame(std::int64_t frame) const;
    /// The frame that a frame's backward motion leads to: the previous one; at the first frame the next one, turned
    /// round; none behind a cut.
    OtherFrame backward_frame(std::int64_t frame) const;
    /// Returns whether a frame's noise is that of the frames around it, where nothing moves: its camera never does, and
    /// no error is asked for. Noise that is new in every frame is seen less, so that less work keeps to an error.
    bool keeps_noise(std::int64_t frame) const { return is_still(camera(frame)) && !(settings.error > 0.0); }
    /// Key of a frame's random numbers.
    std::uint32_t noise_key(std::int64_t frame) const {
        return keeps_noise(frame) ? 0u : static_cast<std::uint32_t>(frame);
    }
    bool can_change() const { return is_world_animated(scene) || !pose_plan.cameras.empty() || shots.size() > 1; }
    /// Returns whether a camera has the same view at all times.
    bool is_still(int camera) const { return std::ranges::find(pose_plan.cameras, camera) == pose_plan.cameras.end(); }
    /// Paths do not follow the map.
    bool is_guided() const {
        return settings.perception.guide != Guide::none && settings.light.integrator == Integrator::cache;
    }
    /// Returns whether something obeys the visible threshold.
    bool needs_perception() const { return is_guided() || settings.sampling.rule != Sampling::uniform; }
    bool estimates_indirect_light(int bounces) const {
        return bounces > 0 && settings.guide.estimate == EstimateKind::direct;
    }

    const std::vector<std::int64_t> given_cuts;
    const std::vector<int> given_levels;  ///< by cage
    const Scene scene;                    ///< cages at the levels that are rendered, changes of cameras among the cuts
    const RenderSettings settings;
    const std::vector<CameraShot> shots;
    const FrameRange range;
    const TextureSet textures;
    const PosePlan pose_plan;
    const SteadySpans steady;
    const bool blended;                            ///< blended surfaces are in the scene
    const std::vector<std::int64_t> crossed_cuts;  ///< find_crossed_cuts
    double exposure = 1.0;
    bool is_dark = false;  ///< no exposure is given or found: the frames that were tried show no direct light
};

}  // namespace aleph
