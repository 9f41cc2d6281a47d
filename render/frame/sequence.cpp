#include "render/frame/sequence.h"

#include <algorithm>
#include <optional>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/load/validate_scene.h"
#include "render/estimate/estimate.h"
#include "render/frame/sequence_state.h"
#include "render/plan/effect_picture.h"
#include "render/shade/frame.h"
#include "render/time/shutter.h"

namespace aleph {

namespace {

constexpr int exposure_columns = 160;
constexpr std::uint32_t shutter_seed_mask = 0x73687574u;  // keeps the shutter apart from other uses of the same key
constexpr float background_depth = 1e30f;

void fill_geometry_maps(const ShadingScene& shading, const SampleHits& centers, FrameOutput& out) {
    const CameraView& view = out.view;
    out.depth = Image<float>(view.width, view.height, background_depth);
    out.normal = Image<glm::vec3>(view.width, view.height, glm::vec3(0.0f));
    out.albedo = Image<Rgb>(view.width, view.height, Rgb(0.0f));
    const glm::vec3 origin(view.position - shading.anchor);
    const glm::vec3 forward(-view.axes[2]);
    parallel_rows(view.height, 16, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < view.width; ++x) {
                if (centers.hits(x, y).instance == no_index) continue;
                const PixelSurface surface = make_pixel_surface(shading, view, centers, x, y);
                out.depth(x, y) = glm::dot(surface.point.position - origin, forward);
                out.normal(x, y) = surface.point.normal;
                const SurfaceMaterial& material = surface.material;
                out.albedo(x, y) =
                    glm::min(material.diffuse + material.f0 + material.glass * material.glass_tint, Rgb(1.0f));
            }
        }
    });
}

/// The scene at each sample's time while the shutter is open.
std::function<SampleMoment(int, int)> open_shutter(SequenceState& s, const ShutterInterval& shutter,
                                                   std::int64_t frame) {
    const double shift = RandomStream({s.settings.seed ^ shutter_seed_mask, s.noise_key(frame), 0, 0}).next();
    return [&s, frame, shutter, shift](int sample, int pixel_class) {
        const double at = place_in_shutter(shutter, sample, pixel_class, shift);
        return s.look_at(frame, at);
    };
}

/// Empty where nothing is known of what a viewer sees.
Image<Outline> find_visible_outlines(const SequenceState& s, const SampleHits& centers, const FrameOutput& out,
                                     double asked) {
    if (out.threshold.empty()) return {};
    Image<Outline> outlines = find_outlines(out.view, centers.hits, out.motion);
    const double error = asked > 0.0 ? asked : 1.0;
    mark_contrasts(outlines, out.estimate, out.threshold, error / s.scene.viewing.display_white);
    return outlines;
}

/// Of the light of key moments; nothing if the frame is one itself, or if nothing but the camera changes.
std::optional<MomentRisk> find_risk(const SequenceState& s, std::int64_t frame) {
    const std::vector<const ShadingScene*> moments = s.shot_light->scenes_around(frame);
    if (moments.empty()) return std::nullopt;
    return find_moment_risk(*s.shading, s.pose_plan, moments);
}

/// The exposure that the scene has with all of its effects, so that pictures without some of them can be compared.
double find_full_exposure(const Scene& scene, RenderSettings settings, const std::string& camera) {
    settings.forbid = {};
    return Sequence(scene, settings, camera).exposure();
}

}  // namespace

Sequence::Sequence(Scene scene, const RenderSettings& settings, const std::string& camera) : camera_(camera) {
    validate(settings);
    validate(scene);
    const std::vector<CameraShot> shots = list_camera_shots(scene, camera);
    if (!settings.forbid.empty()) {
        if (!scene.exposure) scene.exposure = find_full_exposure(scene, settings, camera);
        remove_forbidden(settings.forbid, scene);
    }
    state_ = std::make_unique<SequenceState>(std::move(scene), without_forbidden(settings), shots);
    SequenceState& s = *state_;
    if (s.scene.exposure) {
        s.exposure = *s.scene.exposure;
        return;
    }
    const int height = std::max(1, exposure_columns * settings.height / settings.width);
    const double seconds = s.scene.frame_rate.seconds_of(s.range.first);
    const PosedView posed = make_posed_view(s.scene, seconds, s.camera(s.range.first), exposure_columns, height);
    s.rays.update(posed.pose, compute_anchor(posed.view));
    RayCounts counts;
    s.exposure = compute_exposure(s.estimate_view(s.rays, posed, EstimateKind::direct, std::nullopt, counts));
}

Sequence::~Sequence() = default;
Sequence::Sequence(Sequence&&) noexcept = default;

SequenceState& Sequence::state() const {
    if (state_ == nullptr) throw InputError("", "Sequence", "this sequence has been moved from");
    return *state_;
}

const Scene& Sequence::scene() const {
    return state().scene;
}
double Sequence::exposure() const {
    return state().exposure;
}
FrameRange Sequence::range() const {
    return state().range;
}

void Sequence::load_light(const std::filesystem::path& path) {
    SequenceState& s = state();
    if (!s.shot_light) {
        throw InputError(path.string(), "",
                         "a cache file needs key moments: the integrator cache, a light_step and an accuracy above 0");
    }
    s.shot_light->keep_records(read_cache_file(path, s.fingerprint()));
}

void Sequence::save_light(const std::filesystem::path& path) {
    SequenceState& s = state();
    ALEPH_CHECK(s.shot_light && s.shot_light->records(), "save_light before load_light");
    write_cache_file(path, s.fingerprint(), *s.shot_light->records());
}

EffectsPlan Sequence::plan(std::int64_t frame) {
    SequenceState& s = state();
    FrameOutput out;
    FramePlan plan;
    const SampleHits centers = s.look(s.before_edit ? frame : s.holds.find_first(frame), s.needs_perception(), false,
                                      out, plan, s.before_edit.has_value());
    s.finish_plan(centers.hits, out, plan);
    return plan.effects;
}

SampleOptions SequenceState::find_sample_options(std::int64_t frame, const FramePlan& plan) {
    SampleOptions options;
    std::optional<ShutterInterval> shutter;
    if (!plan.skips(Effect::depth_of_field)) options.lens = find_lens(scene, now->pose.cameras[camera(frame)]);
    if (!plan.skips(Effect::motion_blur)) shutter = find_open_shutter(frame);
    if (shutter) {
        options.light_lasts = !light_breaks.changes(shutter->open, shutter->close);
        options.at_sample = open_shutter(*this, *shutter, frame);
    }
    options.blended = blended;
    return options;
}

/// Fills the cache, shades the picture and adds their times and counts to the frame's statistics.
/// @param carried  light of key moments; may be null
void SequenceState::shade(std::int64_t frame, const SampleHits& centers, const FramePlan& plan,
                          const CarriedLight* carried, SampleOptions options, const FrameProgress& progress,
                          FrameOutput& out) {
    const Image<Outline> outlines = find_visible_outlines(*this, centers, out, plan.settings.error);
    const VisibleLimits limits{out.threshold,
                               out.perception.aleph,
                               out.alpha,
                               out.indirect_luminance,
                               outlines,
                               scene.viewing,
                               plan.effects.left_out_thresholds()};
    if (!out.threshold.empty()) options.limits = &limits;
    std::optional<MomentRisk> risk;
    if (carried != nullptr) risk = find_risk(*this, frame);
    if (risk) options.risk = &*risk;
    const LightingContext seen = lighting();
    const IndirectContext context{.lighting = seen,
                                  .view = out.view,
                                  .settings = plan.settings,
                                  .accuracy = out.alpha,
                                  .frame = noise_key(frame),
                                  .max_radius = scene_radius(*shading),
                                  .progress = progress,
                                  .carried = carried};
    out.shaded = shade_frame(context, centers, exposure, options);
    FrameStatistics& stats = out.statistics;
    stats.seconds.fill = out.shaded.fill_seconds;
    stats.seconds.shade = out.shaded.shade_seconds;
    const RayCounts before = stats.counts.rays;
    stats.counts = out.shaded.counts;
    stats.counts.rays += before;
    if (!out.shaded.errors.total.empty()) stats.error = out.shaded.error_shares;
}

/// A frame by itself, whether or not it is in a hold.
FrameOutput SequenceState::render(std::int64_t frame, const FrameRequest& request) {
    SequenceState& s = *this;
    FrameOutput out;
    FrameStatistics& stats = out.statistics;
    FramePlan plan;
    TracedRays before = s.traced();
    StageClock total;
    const SampleHits centers =
        s.look(frame, s.needs_perception() || request.maps, request.maps, out, plan, s.before_edit.has_value());
    s.finish_plan(centers.hits, out, plan);
    if (request.frame) {
        SampleOptions options = s.find_sample_options(frame, plan);
        total.add_to(stats.seconds.total);
        const TracedRays by_frame = s.traced() - before;
        std::unique_ptr<CarriedLight> carried;
        if (options.light_lasts) carried = s.carry_light(frame, plan, stats.moments);
        before = s.traced() - by_frame;
        total = {};
        s.leave_out(plan.effects);
        options.record_maps = request.maps;
        s.shade(frame, centers, plan, carried.get(), options, request.progress, out);
    }
    if (request.maps) {
        fill_geometry_maps(*s.shading, centers, out);
        out.effects = make_effect_picture(centers.hits, plan.facts, plan.effects, s.shading->instances.size());
    }
    out.hits = centers.hits;
    s.rendered = true;
    s.forget_pose_before_edit();
    const TracedRays traced = s.traced() - before;
    stats.traced_rays = traced.all;
    stats.invalid_rays = traced.invalid;
    stats.plan = plan.effects;
    stats.plan_seconds = plan.seconds;
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return out;
}

}  // namespace aleph
