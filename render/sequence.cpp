#include "render/sequence.h"

#include <algorithm>
#include <optional>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/pose/cage_level.h"
#include "engine/pose/posed_view.h"
#include "motion/image_motion.h"
#include "motion/model_motion.h"
#include "motion/velocity.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "render/accuracy_map.h"
#include "render/estimate.h"
#include "render/frame.h"
#include "render/measure.h"
#include "render/texture.h"

namespace aleph {

namespace {

constexpr int exposure_columns = 160;
constexpr float background_depth = 1e30f;

/// Takes `posed` to a frame. Its first call poses the whole scene, later calls only what can move.
void move_to_frame(std::optional<PosedView>& posed, const Scene& scene, const PosePlan& plan, std::int64_t frame,
                   int camera, const RenderSettings& settings) {
    const double seconds = scene.frame_rate.seconds_of(frame);
    if (posed) {
        update_posed_view(scene, plan, seconds, camera, *posed);
    } else {
        posed = make_posed_view(scene, seconds, camera, settings.width, settings.height);
    }
}

void refuse_later_effects(const Scene& scene, const CameraValues& camera) {
    const std::string name = scene.nodes[camera.node].name;
    if (camera.shutter.x != camera.shutter.y) {
        throw InputError(scene.file, "camera of node " + printable(name),
                         "motion blur (an open shutter) is not in this version");
    }
    if (camera.aperture > 0.0) {
        throw InputError(scene.file, "camera of node " + printable(name),
                         "depth of field (an aperture) is not in this version");
    }
}

/// The quick estimate of a posed view to which `rays` have been updated, not sanitized.
Image<Rgb> estimate_view(const Scene& scene, const TextureSet& textures, const RayScene& rays, const PosedView& posed,
                         EstimateKind kind, double exposure, RayCounts& counts) {
    const ShadingScene shading = make_shading_scene(scene, posed.pose, rays.anchor(), textures);
    const LightSet lights = make_light_set(shading);
    const SampleHits centers = cast_sample(rays, posed.view, 0, 1, &counts.primary);
    return compute_estimate({shading, lights, rays}, posed.view, centers, kind, exposure, counts);
}

/// The scene with its subdivision cages at the levels that the picture asks for; null where they are.
std::unique_ptr<Scene> refine_cages(const Scene& scene, int camera, const RenderSettings& settings) {
    if (scene.cages.empty()) return nullptr;
    std::vector<int> levels(scene.cages.size(), settings.subdivision_level);
    if (settings.subdivision_level < 0) levels = choose_cage_levels(scene, camera, settings.width, settings.height);
    return make_scene_at_levels(scene, levels);
}

bool is_cut(const Scene& scene, std::int64_t frame) {
    return std::find(scene.cuts.begin(), scene.cuts.end(), frame) != scene.cuts.end();
}

}  // namespace

std::array<std::pair<const char*, double>, 10> list_stages(const StageSeconds& s) {
    return {{{"pose", s.pose},
             {"update", s.update},
             {"first_hits", s.first_hits},
             {"estimate", s.estimate},
             {"motion", s.motion},
             {"perception", s.perception},
             {"fill", s.fill},
             {"shade", s.shade},
             {"write", s.write},
             {"total", s.total}}};
}

struct Sequence::State {
    std::unique_ptr<const Scene> refined;  ///< where the picture asks for other levels of cages than the scene has
    const Scene& scene;                    ///< that, or the caller's
    RenderSettings settings;
    int camera;
    FrameRange range;
    TextureSet textures;
    PosePlan pose_plan;
    RayScene rays;
    // What the last frame left: the next one updates it, and is the same as without.
    std::optional<PosedView> now, other;
    std::optional<ShadingScene> shading;  ///< of `now`
    std::optional<ModelMotion> model_motion;
    std::unique_ptr<RayScene> other_rays;  ///< for visibility in the other frame, or its quick estimate
    double exposure = 1.0;
};

Sequence::Sequence(const Scene& authored, const RenderSettings& settings, const std::string& camera) {
    validate(settings);
    const int camera_index = find_camera(authored, camera);
    std::unique_ptr<const Scene> refined = refine_cages(authored, camera_index, settings);
    const Scene& scene = refined ? *refined : authored;
    PosePlan plan = make_pose_plan(scene);
    RayScene rays(scene, plan);
    state_.reset(new State{std::move(refined),
                           scene,
                           settings,
                           camera_index,
                           frame_range(scene),
                           make_texture_set(scene),
                           std::move(plan),
                           std::move(rays),
                           {},
                           {},
                           {},
                           {},
                           nullptr,
                           1.0});
    State& s = *state_;
    if (scene.exposure) {
        s.exposure = *scene.exposure;
        return;
    }
    const int height = std::max(1, exposure_columns * settings.height / settings.width);
    const double seconds = scene.frame_rate.seconds_of(s.range.first);
    const PosedView posed = make_posed_view(scene, seconds, s.camera, exposure_columns, height);
    s.rays.update(posed.pose, compute_anchor(posed.view));
    RayCounts counts;
    s.exposure = compute_exposure(estimate_view(scene, s.textures, s.rays, posed, EstimateKind::direct, 1.0, counts));
}

Sequence::~Sequence() = default;
Sequence::Sequence(Sequence&&) noexcept = default;
double Sequence::exposure() const {
    return state_->exposure;
}
FrameRange Sequence::range() const {
    return state_->range;
}

namespace {

/// Motion to the next frame; from the previous one at the scene's last frame; none across a cut.
OtherFrame find_other_frame(const Scene& scene, const FrameRange& range, std::int64_t frame) {
    const bool is_last = frame == range.last && range.last > range.first;
    if (is_cut(scene, is_last ? frame : frame + 1)) return OtherFrame::none;
    return is_last ? OtherFrame::previous : OtherFrame::next;
}

void fill_geometry_maps(const ShadingScene& shading, const SampleHits& centers, FrameOutput& out) {
    const CameraView& view = out.view;
    out.depth = Image<float>(view.width, view.height, background_depth);
    out.normal = Image<glm::vec3>(view.width, view.height, glm::vec3(0.0f));
    const glm::vec3 origin(view.position - shading.anchor);
    const glm::vec3 forward(-view.axes[2]);
    parallel_rows(view.height, 16, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < view.width; ++x) {
                if (centers.hits(x, y).instance == no_index) continue;
                const PixelSurface surface = make_pixel_surface(shading, view, centers, x, y);
                out.depth(x, y) = glm::dot(surface.point.position - origin, forward);
                out.normal(x, y) = surface.point.normal;
            }
        }
    });
}

}  // namespace

FrameOutput Sequence::render(std::int64_t frame, const FrameRequest& request) {
    State& s = *state_;
    const RenderSettings& settings = s.settings;
    const bool guided = settings.perception.guide != Guide::none;
    const bool perceive = guided || request.maps;
    const OtherFrame which = find_other_frame(s.scene, s.range, frame);
    const bool has_other = perceive && which != OtherFrame::none;
    FrameOutput out;
    FrameStatistics& stats = out.statistics;
    stats.frame = frame;
    const std::uint64_t traced_before = s.rays.rays_traced(), invalid_before = s.rays.invalid_rays();
    StageClock clock, total;

    move_to_frame(s.now, s.scene, s.pose_plan, frame, s.camera, settings);
    const PosedView& now = *s.now;
    if (request.frame) refuse_later_effects(s.scene, now.pose.cameras[s.camera]);
    if (has_other) move_to_frame(s.other, s.scene, s.pose_plan, other_frame_number(frame, which), s.camera, settings);
    const PosedView& other = has_other ? *s.other : now;
    out.view = now.view;
    clock.add_to(stats.seconds.pose);

    const glm::dvec3 anchor = compute_anchor(now.view);
    stats.instances_touched = s.rays.update_moving(now.pose, anchor);
    if (s.shading) {
        update_shading_scene(*s.shading, s.pose_plan, anchor);
    } else {
        s.shading = make_shading_scene(s.scene, now.pose, anchor, s.textures);
    }
    const ShadingScene& shading = *s.shading;
    const LightSet lights = make_light_set(shading);
    const LightingContext lighting{shading, lights, s.rays};
    clock.add_to(stats.seconds.update);

    const SampleHits centers = cast_sample(s.rays, now.view, 0, 1, &stats.rays.primary);
    clock.add_to(stats.seconds.first_hits);

    if (perceive) {
        out.estimate = compute_estimate(lighting, now.view, centers, settings.estimate, s.exposure, stats.rays);
        const SanitizeCounts sanitized = sanitize_estimate(out.estimate);
        stats.replaced = sanitized.replaced;
        stats.clamped = sanitized.clamped;
        stats.median_luminance = median_luminance(out.estimate, s.scene.viewing);
        clock.add_to(stats.seconds.estimate);

        const bool from_images = settings.motion == MotionSource::image;
        const bool look_there = has_other && (from_images || request.maps);
        if (look_there && !s.other_rays) s.other_rays = std::make_unique<RayScene>(s.rays.share_meshes());
        const std::uint64_t other_before = look_there ? s.other_rays->rays_traced() : 0;
        if (look_there) s.other_rays->update_moving(other.pose, compute_anchor(other.view));
        if (from_images) {
            Image<Rgb> other_estimate;
            if (look_there) {
                other_estimate =
                    estimate_view(s.scene, s.textures, *s.other_rays, other, settings.estimate, s.exposure, stats.rays);
                sanitize_estimate(other_estimate);
            }
            clock.add_to(stats.seconds.estimate);
            out.motion = compute_image_motion(out.estimate, other_estimate, which);
        } else {
            if (!s.model_motion) s.model_motion.emplace(s.scene, s.pose_plan);
            out.motion = s.model_motion->compute(now, other, centers.hits, which);
            if (look_there) {
                stats.rays.primary += mark_hidden(out.motion, s.scene, other, centers.hits, *s.other_rays);
            }
        }
        if (look_there) stats.traced_rays += s.other_rays->rays_traced() - other_before;
        out.velocity = compute_image_velocity(out.motion, s.scene.viewing, s.scene.frame_rate);
        clock.add_to(stats.seconds.motion);

        out.perception =
            compute_perception(out.estimate, out.velocity, s.scene.viewing, s.scene.frame_rate, settings.perception,
                               {.retinal_velocity = request.maps, .conspicuity = request.maps});
        stats.saliency_fallback = out.perception.fallback;
        out.threshold =
            compute_threshold(out.perception.aleph, compute_adaptation_luminance(out.estimate, s.scene.viewing));
        clock.add_to(stats.seconds.perception);
    } else {
        out.perception.aleph = Image<float>(settings.width, settings.height, 1.0f);
    }
    out.alpha = compute_accuracy_map(out.perception.aleph, settings);

    if (request.frame) {
        const IndirectContext indirect{
            lighting,        now.view, settings, out.alpha, static_cast<std::uint32_t>(frame), scene_radius(shading),
            request.progress};
        out.shaded = shade_frame(indirect, centers, s.exposure);
        stats.seconds.fill = out.shaded.fill_seconds;
        stats.seconds.shade = out.shaded.shade_seconds;
        stats.rays += out.shaded.counts.rays;
        stats.records = out.shaded.counts.records;
        stats.cache = out.shaded.counts.cache;
        stats.samples = out.shaded.counts.samples;
        stats.nan_count = out.shaded.counts.invalid_samples;
    }
    if (request.maps) fill_geometry_maps(shading, centers, out);
    out.hits = centers.hits;
    stats.traced_rays += s.rays.rays_traced() - traced_before;
    stats.invalid_rays = s.rays.invalid_rays() - invalid_before;
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return out;
}

}  // namespace aleph
