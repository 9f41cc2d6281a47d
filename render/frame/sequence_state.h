#pragma once
// What a Sequence keeps between frames, and the stages of a frame before its picture is shaded.

#include <algorithm>
#include <memory>
#include <optional>

#include "engine/pose/posed_view.h"
#include "motion/model_motion.h"
#include "render/frame/frame_output.h"
#include "render/frame/holds.h"
#include "render/frame/open_shutter.h"
#include "render/frame/sequence_plan.h"
#include "render/settings/measure.h"
#include "render/settings/settings.h"
#include "render/shade/frame.h"
#include "render/time/camera_span.h"
#include "render/time/estimate_moments.h"
#include "render/time/light_breaks.h"
#include "render/time/shot_light.h"
#include "render/time/shutter.h"

namespace aleph {

/// @throws InputError if the camera has an aperture without a focus distance
Lens find_lens(const Scene& scene, const CameraValues& camera);

/// Counted where rays are traced.
struct TracedRays {
    std::uint64_t all = 0, invalid = 0;
    TracedRays operator-(const TracedRays& o) const { return {all - o.all, invalid - o.invalid}; }
};

struct SequenceState {
    /// @param shots  list_camera_shots(given, name)
    SequenceState(Scene given, const RenderSettings& chosen, const std::vector<CameraShot>& shots);

    FrameOutput render(std::int64_t frame, const FrameRequest& request);
    void move_to_frame(std::optional<PosedView>& posed, std::int64_t frame) const;
    Image<Rgb> estimate_view(const RayScene& view_rays, const PosedView& posed, EstimateKind kind,
                             std::optional<std::int64_t> indirect, RayCounts& counts);
    void prepare_estimate(std::int64_t frame, std::int64_t but, RayCounts& counts);
    std::unique_ptr<CarriedEstimate> carry_estimate(std::int64_t frame);
    EstimateNodes find_estimate_nodes(std::int64_t frame, const SampleHits& centers, RayCounts& counts);
    std::optional<EstimateNodes> compute_frame_estimate(std::int64_t frame, const SampleHits& centers,
                                                        const FramePlan& plan, FrameOutput& out);
    std::optional<ShutterInterval> find_open_shutter(std::int64_t frame) const;
    SampleMoment look_at(std::int64_t frame, double at);
    void blur_frame_estimate(std::int64_t frame, const SampleHits& centers, const EstimateNodes* nodes,
                             const FramePlan& plan, FrameOutput& out);
    std::size_t update_rays_and_shading();
    void update_other_rays();
    OtherFrame take_pose_before_edit(std::int64_t frame);
    void forget_pose_before_edit();
    PosePlan make_plan_of_all() const;
    void compute_motion(const SampleHits& centers, OtherFrame which, const FramePlan& plan, StageClock& clock,
                        FrameOutput& out);
    FramePlan begin_plan(std::int64_t frame, OtherFrame which, bool perceive, bool maps, bool edited);
    EffectsPlan make_effects_plan(const FramePlan& plan, const std::optional<VisibleFrame>& visible) const;
    void finish_plan(const Image<Hit>& hits, const FrameOutput& out, FramePlan& plan) const;
    void leave_out(const EffectsPlan& effects);
    double find_seconds(std::int64_t frame) const;
    void show(std::int64_t frame);
    SampleHits look(std::int64_t frame, bool perceive, bool maps, FrameOutput& out, FramePlan& plan,
                    bool edited = false);
    void copy_now(KeyPose& pose) const;
    MomentSource key_moments();
    bool reads_moments() const;
    std::unique_ptr<CarriedLight> carry_light(std::int64_t frame, const FramePlan& plan,
                                              std::vector<MomentStatistics>& filled);
    SampleOptions find_sample_options(std::int64_t frame, const FramePlan& plan);
    void shade(std::int64_t frame, const SampleHits& centers, const FramePlan& plan, const CarriedLight* carried,
               SampleOptions options, const FrameProgress& progress, FrameOutput& out);
    const CacheFingerprint& fingerprint();
    LightingContext lighting() const { return {*shading, lights, rays}; }
    /// Paths do not follow the map.
    bool is_guided() const {
        return settings.perception.guide != Guide::none && settings.integrator == Integrator::cache;
    }
    /// Whether something obeys the visible threshold.
    bool needs_perception() const { return is_guided() || settings.sampling != Sampling::uniform; }
    /// @param bounces  of the frame's settings
    bool estimates_indirect_light(int bounces) const {
        return bounces > 0 && settings.estimate == EstimateKind::direct;
    }
    /// Key of a frame's random numbers: the same for all frames if its camera never moves, so that their noise is too,
    /// where nothing else does.
    std::uint32_t noise_key(std::int64_t frame) const {
        return is_still(camera(frame)) ? 0u : static_cast<std::uint32_t>(frame);
    }
    bool can_change() const { return is_world_animated(scene) || !pose_plan.cameras.empty() || shots.size() > 1; }
    /// Index into ScenePose::cameras of the one that looks.
    int camera(std::int64_t frame) const { return camera_at(shots, frame); }
    /// Whether a camera has the same view at all times.
    bool is_still(int camera) const { return std::ranges::find(pose_plan.cameras, camera) == pose_plan.cameras.end(); }
    glm::dvec2 shutter(std::int64_t frame) const;
    TracedRays traced() const {
        const std::uint64_t others = (other_rays ? other_rays->rays_traced() : 0) + (open ? open->rays_traced() : 0);
        return {rays.rays_traced() + others, rays.invalid_rays()};
    }

    const Scene scene;
    const RenderSettings settings;
    const std::vector<CameraShot> shots;
    const FrameRange range;
    TextureSet textures;
    PosePlan pose_plan;
    Holds holds;
    HeldFrame held;
    RayScene rays;
    // Kept from frame to frame and updated, which gives the same results as making them anew.
    std::optional<PosedView> now, other;
    bool rendered = false;                 ///< a frame, which is `now`
    std::optional<PosedView> before_edit;  ///< the frame rendered last before the scene was changed in code
    bool other_is_before_edit = false;     ///< `other` is that frame
    std::optional<ShadingScene> shading;   ///< of `now`
    LightSet lights;                       ///< of `now`
    std::optional<ModelMotion> model_motion;
    std::unique_ptr<RayScene> other_rays;  ///< for visibility in the other frame, or its quick estimate
    bool blended = false;                  ///< blended surfaces are in the scene

    std::unique_ptr<OpenShutter> open;  ///< the scene while the shutter is open
    LightBreaks light_breaks;
    std::optional<ShotFacts> shot_facts;  ///< once a frame was planned
    const SteadySpans steady;
    CameraSpan camera_span;
    std::optional<ShotLight> shot_light;  ///< if frames read key moments
    EstimateMoments estimate_moments;
    std::optional<CacheFingerprint> cache_fingerprint;
    double exposure = 1.0;
};

}  // namespace aleph
