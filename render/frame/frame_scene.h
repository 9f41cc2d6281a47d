#pragma once
// The scene at one time, made ready step by step: pose, rays, shading and lights.

#include <cstdint>
#include <optional>

#include "engine/pose/posed_view.h"
#include "render/frame/shot.h"
#include "render/light/known_lights.h"
#include "render/plan/effects_plan.h"
#include "render/shade/sample_shading.h"
#include "render/time/keyframe_light.h"

namespace aleph {

/// Keeps its structures from time to time and updates what moved, which gives the same as making them anew.
class FrameScene {
  public:
    /// Keeps references to shot and plan.
    /// @param plan  what can move: the shot's own plan, or one of more
    FrameScene(const Shot& shot, const PosePlan& plan)
        : shot_(shot), plan_(plan), rays_(std::in_place, shot.scene, plan) {}
    /// Shares the mesh structures of another one, once it needs rays. Keeps a reference to it.
    FrameScene(const Shot& shot, const FrameScene& meshes) : shot_(shot), plan_(shot.pose_plan), meshes_(&meshes) {}
    FrameScene(const FrameScene&) = delete;

    /// Poses the scene, seen by one of its cameras.
    /// @param camera  index into ScenePose::cameras
    void pose(double seconds, int camera, int width, int height);
    /// Poses the scene as the shot has it at a frame.
    void pose(std::int64_t frame);
    /// Takes a pose of the same elements from elsewhere.
    void pose(const PosedView& given);

    /// Brings the rays to the pose. @return instances that were updated
    std::size_t update_rays();
    /// Brings rays, shading and lights to the pose, with all effects but those that the settings forbid.
    /// @return instances that were updated
    std::size_t prepare();
    /// Finds the volumes that the camera is in. To be called after prepare; without it there are none.
    void find_media_around(std::uint64_t& rays_cast);
    /// Finds out by rays what decides how lights are sampled. To be called after prepare; without it all go by power.
    /// @param centers  first hits of the pose
    void find_known_lights(const SampleHits& centers, RayCounts& counts);
    /// The same, from the pose of another time. To be called after prepare.
    void take_known_lights(const FrameScene& other);
    /// Adds what is found in the pose of another time.
    /// @param centers  first hits of this pose
    void add_known_lights(const FrameScene& other, const SampleHits& centers, RayCounts& counts);
    /// Leaves out of shading what a plan for this frame skips. To be called after prepare.
    void leave_out(const EffectsPlan& effects);
    /// Leaves effects out of shading; the lights stay, unless direct light is among the effects.
    void leave_out(const EffectSet& effects);

    /// Copies pose and shading, so that they stay when this is posed again.
    void copy_to(KeyPose& kept) const;

    const PosedView& posed() const { return *posed_; }
    const RayScene& rays() const { return *rays_; }
    const ShadingScene& shading() const { return *shading_; }
    LightingContext lighting() const;
    /// The scene while a sample is taken, valid until it is posed again.
    SampleScene sample_scene() const { return {lighting(), posed_->view}; }

    /// Rays that were traced so far, and those of them that were invalid.
    TracedRays traced() const { return rays_ ? TracedRays{rays_->rays_traced(), rays_->invalid_rays()} : TracedRays{}; }

  private:
    void make_light_trees();

    const Shot& shot_;
    const PosePlan& plan_;
    const FrameScene* meshes_ = nullptr;  ///< null: `rays_` is its own from the beginning
    std::optional<RayScene> rays_;
    std::optional<PosedView> posed_;
    std::optional<ShadingScene> shading_;
    LightSet lights_;
    KnownLights known_;
    KnownLightTrees trees_;
    Media around_;  ///< the camera
};

}  // namespace aleph
