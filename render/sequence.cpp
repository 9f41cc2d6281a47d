#include "render/sequence.h"

#include <algorithm>
#include <optional>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/pose/cage_level.h"
#include "engine/pose/posed_view.h"
#include "engine/rays/alpha_cutout.h"
#include "motion/image_motion.h"
#include "motion/model_motion.h"
#include "perception/sanitize.h"
#include "render/accuracy_map.h"
#include "render/estimate.h"
#include "render/frame.h"
#include "render/frame_vision.h"
#include "render/measure.h"
#include "render/open_shutter.h"
#include "render/shutter.h"
#include "render/texture.h"

namespace aleph {

namespace {

constexpr int exposure_columns = 160;
constexpr std::uint32_t shutter_seed_mask = 0x73687574u;  // keeps the shutter apart from other uses of the same key
constexpr float background_depth = 1e30f;

Lens find_lens(const Scene& scene, const CameraValues& camera) {
    if (!(camera.aperture > 0.0)) return {};
    if (!(camera.focus_distance > 0.0)) {
        throw InputError(scene.file, "camera of node " + printable(scene.nodes[camera.node].name),
                         "with an aperture, its focus distance has to be above 0");
    }
    return {camera.aperture, camera.focus_distance};
}

/// The scene with its subdivision cages at the levels that the picture needs.
Scene refine_cages(Scene scene, int camera, const RenderSettings& settings) {
    if (scene.cages.empty()) return scene;
    std::vector<int> levels(scene.cages.size(), settings.subdivision_level);
    if (settings.subdivision_level < 0) levels = choose_cage_levels(scene, camera, settings.width, settings.height);
    const std::unique_ptr<Scene> refined = make_scene_at_levels(scene, levels);
    return refined ? std::move(*refined) : std::move(scene);
}

bool is_cut(const Scene& scene, std::int64_t frame) {
    return std::find(scene.cuts.begin(), scene.cuts.end(), frame) != scene.cuts.end();
}

}  // namespace

struct Sequence::State {
    State(Scene given, const RenderSettings& chosen, int camera_index)
        : scene(refine_cages(std::move(given), camera_index, chosen)),
          settings(chosen),
          camera(camera_index),
          range(frame_range(scene)),
          textures(make_texture_set(scene)),
          pose_plan(make_pose_plan(scene)),
          rays(scene, pose_plan),
          blended(has_blended(scene)) {}

    void move_to_frame(std::optional<PosedView>& posed, std::int64_t frame) const;
    Image<Rgb> estimate_view(const RayScene& view_rays, const PosedView& posed, EstimateKind kind, bool indirect,
                             RayCounts& counts) const;
    std::size_t update_rays_and_shading();
    void update_other_rays();
    void compute_motion(const SampleHits& centers, OtherFrame which, bool maps, StageClock& clock, FrameOutput& out);
    bool can_change() const { return is_world_animated(scene) || !pose_plan.cameras.empty(); }
    std::uint64_t rays_traced() const {
        return rays.rays_traced() + (other_rays ? other_rays->rays_traced() : 0) + (open ? open->rays_traced() : 0);
    }

    const Scene scene;
    const RenderSettings settings;
    const int camera;
    const FrameRange range;
    TextureSet textures;
    PosePlan pose_plan;
    RayScene rays;
    // Kept from frame to frame and updated, which gives the same results as making them anew.
    std::optional<PosedView> now, other;
    std::optional<ShadingScene> shading;  ///< of `now`
    std::optional<ModelMotion> model_motion;
    std::unique_ptr<RayScene> other_rays;  ///< for visibility in the other frame, or its quick estimate
    bool blended = false;                  ///< blended surfaces are in the scene

    std::unique_ptr<OpenShutter> open;  ///< the scene while the shutter is open
    double exposure = 1.0;
};

/// Takes `posed` to a frame. Its first call poses the whole scene, later calls only what can move.
void Sequence::State::move_to_frame(std::optional<PosedView>& posed, std::int64_t frame) const {
    const double seconds = scene.frame_rate.seconds_of(frame);
    if (posed) {
        update_posed_view(scene, pose_plan, seconds, camera, *posed);
    } else {
        posed = make_posed_view(scene, seconds, camera, settings.width, settings.height);
    }
}

/// The quick estimate of a posed view to which `view_rays` have been updated, not sanitized.
Image<Rgb> Sequence::State::estimate_view(const RayScene& view_rays, const PosedView& posed, EstimateKind kind,
                                          bool indirect, RayCounts& counts) const {
    const ShadingScene view_shading = make_shading_scene(scene, posed.pose, view_rays, textures);
    const LightSet lights = make_light_set(view_shading);
    const SampleHits centers = cast_centers(view_rays, posed.view, &counts.primary);
    return compute_estimate({view_shading, lights, view_rays}, posed.view, centers, kind, indirect, exposure, counts);
}

/// Brings rays and shading to `now`. @return instances that were updated
std::size_t Sequence::State::update_rays_and_shading() {
    const std::size_t touched = rays.update_moving(now->pose, compute_anchor(now->view));
    if (shading) {
        update_shading_scene(*shading, pose_plan, rays);
    } else {
        shading = make_shading_scene(scene, now->pose, rays, textures);
    }
    return touched;
}

/// Brings other_rays to `other`.
void Sequence::State::update_other_rays() {
    if (!other_rays) other_rays = std::make_unique<RayScene>(rays.share_meshes());
    other_rays->update_moving(other->pose, compute_anchor(other->view));
}

/// Motion from `now` to `other`.
/// @param maps  also finds the pixels that are hidden in the other frame
void Sequence::State::compute_motion(const SampleHits& centers, OtherFrame which, bool maps, StageClock& clock,
                                     FrameOutput& out) {
    FrameStatistics& stats = out.statistics;
    const bool has_other = which != OtherFrame::none;
    if (settings.motion == MotionSource::model) {
        if (!model_motion) model_motion.emplace(scene, pose_plan);
        out.motion = model_motion->compute(*now, has_other ? *other : *now, centers.hits, which);
        if (!has_other || !maps) return;
        update_other_rays();
        stats.counts.rays.primary += mark_hidden(out.motion, scene, *other, centers.hits, *other_rays);
        return;
    }
    Image<Rgb> other_estimate;
    if (has_other) {
        update_other_rays();
        other_estimate = estimate_view(*other_rays, *other, settings.estimate, settings.bounces > 0, stats.counts.rays);
        sanitize_estimate(other_estimate);
    }
    clock.add_to(stats.seconds.estimate);
    out.motion = compute_image_motion(out.estimate, other_estimate, which);
}

Sequence::Sequence(Scene scene, const RenderSettings& settings, const std::string& camera) {
    validate(settings);
    const int camera_index = find_camera(scene, camera);
    state_ = std::make_unique<State>(std::move(scene), settings, camera_index);
    State& s = *state_;
    if (s.scene.exposure) {
        s.exposure = *s.scene.exposure;
        return;
    }
    const int height = std::max(1, exposure_columns * settings.height / settings.width);
    const double seconds = s.scene.frame_rate.seconds_of(s.range.first);
    const PosedView posed = make_posed_view(s.scene, seconds, s.camera, exposure_columns, height);
    s.rays.update(posed.pose, compute_anchor(posed.view));
    RayCounts counts;
    s.exposure = compute_exposure(s.estimate_view(s.rays, posed, EstimateKind::direct, false, counts));
}

Sequence::~Sequence() = default;
Sequence::Sequence(Sequence&&) noexcept = default;
const Scene& Sequence::scene() const {
    return state_->scene;
}
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

/// Fills the cache, shades the picture and adds their times and counts to the frame's statistics.
void shade(const IndirectContext& context, const SampleHits& centers, double exposure, const SampleOptions& options,
           FrameOutput& out) {
    out.shaded = shade_frame(context, centers, exposure, options);
    FrameStatistics& stats = out.statistics;
    stats.seconds.fill = out.shaded.fill_seconds;
    stats.seconds.shade = out.shaded.shade_seconds;
    const RayCounts before = stats.counts.rays;
    stats.counts = out.shaded.counts;
    stats.counts.rays += before;
}

}  // namespace

FrameOutput Sequence::render(std::int64_t frame, const FrameRequest& request) {
    State& s = *state_;
    // Paths do not follow the map.
    const bool guided = s.settings.perception.guide != Guide::none && s.settings.integrator == Integrator::cache;
    const bool perceive = guided || request.maps;
    const OtherFrame which = perceive ? find_other_frame(s.scene, s.range, frame) : OtherFrame::none;
    FrameOutput out;
    FrameStatistics& stats = out.statistics;
    stats.frame = frame;
    const std::uint64_t traced_before = s.rays_traced(), invalid_before = s.rays.invalid_rays();
    StageClock clock, total;

    s.move_to_frame(s.now, frame);
    const CameraValues& camera = s.now->pose.cameras[s.camera];
    SampleOptions options;
    if (request.frame) options.lens = find_lens(s.scene, camera);
    if (which != OtherFrame::none) s.move_to_frame(s.other, other_frame_number(frame, which));
    out.view = s.now->view;
    clock.add_to(stats.seconds.pose);

    stats.instances_touched = s.update_rays_and_shading();
    const LightSet lights = make_light_set(*s.shading);
    const LightingContext lighting{*s.shading, lights, s.rays};
    clock.add_to(stats.seconds.update);

    const SampleHits centers = cast_centers(s.rays, out.view, &stats.counts.rays.primary);
    clock.add_to(stats.seconds.first_hits);

    if (perceive) {
        out.estimate = compute_estimate(lighting, out.view, centers, s.settings.estimate, s.settings.bounces > 0,
                                        s.exposure, stats.counts.rays);
        note_estimate(out, sanitize_estimate(out.estimate), s.scene.viewing);
        clock.add_to(stats.seconds.estimate);
        s.compute_motion(centers, which, request.maps, clock, out);
        compute_frame_vision(out, s.scene, s.settings, request.maps, clock);
    } else {
        out.perception.aleph = Image<float>(s.settings.width, s.settings.height, 1.0f);
        out.alpha = compute_accuracy_map(out.perception.aleph, s.settings);
    }
    if (request.frame) {
        const auto random_frame = static_cast<std::uint32_t>(frame);
        options.blended = s.blended;
        if (const auto shutter = find_shutter(s.scene, camera, frame); shutter && s.can_change()) {
            const double shift = RandomStream({s.settings.seed ^ shutter_seed_mask, random_frame, 0, 0}).next();
            if (!s.open) s.open = std::make_unique<OpenShutter>(s.scene, s.pose_plan, s.textures, s.rays, s.camera);
            options.at_sample = [&s, shutter, shift, &view = out.view](int sample) {
                const double at = place_in_shutter(*shutter, sample, shift);
                return s.open->move_to(at / s.scene.frame_rate.per_second(), view.width, view.height);
            };
        }
        shade({lighting, out.view, s.settings, out.alpha, random_frame, scene_radius(*s.shading), request.progress},
              centers, s.exposure, options, out);
    }
    if (request.maps) fill_geometry_maps(*s.shading, centers, out);
    out.hits = centers.hits;
    stats.traced_rays = s.rays_traced() - traced_before;
    stats.invalid_rays = s.rays.invalid_rays() - invalid_before;
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return out;
}

}  // namespace aleph
