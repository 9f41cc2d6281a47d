// The picture of a prepared frame.

#include <cmath>
#include <optional>

#include "engine/base/pixel_loops.h"
#include "render/frame/frame_shutter.h"
#include "render/frame/frame_window.h"
#include "render/frame/prepared_frame.h"
#include "render/frame/sequence_state.h"
#include "render/plan/effect_table.h"
#include "render/settings/measure.h"
#include "render/shade/frame.h"
#include "render/time/shutter.h"

namespace aleph {

namespace {

constexpr float background_depth = 1e30f;

void fill_geometry_maps(const ShadingScene& shading, const SampleHits& centers, FrameOutput& out) {
    const CameraView& view = out.view;
    out.surface.depth = Image<float>(view.width, view.height, background_depth);
    out.surface.normal = Image<glm::vec3>(view.width, view.height, glm::vec3(0.0f));
    out.surface.albedo = Image<Rgb>(view.width, view.height, Rgb(0.0f));
    const glm::vec3 origin(view.position - shading.anchor);
    const glm::vec3 forward(-view.axes[2]);
    parallel_pixels(centers.hits, 16, [&](int x, int y) {
        if (centers.hits(x, y).instance == no_index) return;
        const PixelSurface surface = make_pixel_surface(shading, view, centers, x, y);
        out.surface.depth(x, y) = glm::dot(surface.point.position - origin, forward);
        out.surface.normal(x, y) = surface.point.normal;
        const SurfaceMaterial& material = surface.material;
        out.surface.albedo(x, y) =
            glm::min(material.diffuse + material.gloss.f0 + material.glass.share * material.glass.tint, Rgb(1.0f));
    });
}

/// Risk of using the light of lighting keyframes; none if the frame is one itself, or if nothing but the camera
/// changes.
std::optional<KeyframeRisk> find_risk(const SequenceState& s, std::int64_t frame) {
    const std::vector<const ShadingScene*> keyframes = s.shot_light->scenes_around(frame);
    if (keyframes.empty()) return std::nullopt;
    return find_keyframe_risk(s.here.shading(), s.shot.pose_plan, keyframes);
}

}  // namespace

SampleOptions find_sample_options(SequenceState& s, std::int64_t frame, const FramePlan& plan) {
    SampleOptions options;
    const OpenLens open = find_open_lens(s.shot, frame, plan);
    options.lens = open.lens;
    options.blended = s.shot.blended;
    if (!open.shutter) return options;
    options.light_lasts = !plan.input.shutter.light_changes;
    options.at_sample = [&s, &plan, frame, shutter = *open.shutter](int sample, int pixel_class) {
        const float place = time_of_sample(plan.settings.seed, s.shot.noise_key(frame), sample, pixel_class);
        const double at = std::lerp(shutter.open, shutter.close, static_cast<double>(place));
        SampleScene scene = open_scene({s.shot, frame, plan, s.here, s.shutter}, at);
        scene.at = at;
        return scene;
    };
    return options;
}

void shade_prepared(SequenceState& s, std::int64_t frame, PreparedFrame& prepared, const CarriedLight* carried,
                    SampleOptions options, const FrameRequest& request) {
    options.partial = &request.partial;
    FrameOutput& out = prepared.out;
    const Image<Outline> outlines = find_visible_outlines(s.shot, s.here.shading(), prepared);
    const VisibleLimits limits = make_visible_limits(s.shot, prepared, outlines);
    if (!out.limits.threshold.empty()) {
        options.limits = &limits;
        options.estimate = &out.estimate;
    }
    std::optional<KeyframeRisk> risk;
    if (carried != nullptr) risk = find_risk(s, frame);
    if (risk) options.risk = &*risk;
    StageClock clock;
    FrameCounts of_spans;
    double span_seconds = 0.0;
    if (options.at_sample) of_spans = find_shutter_light(s, frame, prepared, request, carried != nullptr, options);
    clock.add_to(span_seconds);
    const LightingContext lighting = s.here.lighting();
    const IndirectContext context{.lighting = lighting,
                                  .view = out.view,
                                  .settings = prepared.plan.settings,
                                  .accuracy = out.limits.alpha,
                                  .frame = s.shot.noise_key(frame),
                                  .max_radius = scene_radius(lighting.shading),
                                  .progress = request.progress,
                                  .checkpoint = request.checkpoint,
                                  .carried = carried};
    out.shaded = shade_frame(context, prepared.centers, s.shot.exposure, options);
    FrameStatistics& stats = out.statistics;
    out.shaded.fill_seconds += span_seconds;
    stats.seconds.fill = out.shaded.fill_seconds;
    stats.seconds.shade = out.shaded.shade_seconds;
    const RayCounts before = stats.counts.rays;
    stats.counts = out.shaded.counts;
    stats.counts.rays += before;
    stats.counts.rays += of_spans.rays;
    stats.counts.records += of_spans.records;
    if (!out.shaded.errors.total.empty()) stats.error = out.shaded.error_shares;
}

FrameOutput render_frame(SequenceState& s, std::int64_t frame, const FrameRequest& request) {
    TracedRays before = s.traced();
    StageClock total;
    PreparedFrame prepared =
        s.prepare(frame, s.shot.needs_perception() || request.maps, request.maps, request.progress);
    FrameOutput& out = prepared.out;
    FrameStatistics& stats = out.statistics;
    const FramePlan& plan = prepared.plan;
    PicturePart part;
    if (request.frame) {
        SampleOptions options = find_sample_options(s, frame, plan);
        if (request.window) {
            part = choose_window_part(plan.settings, s.shot.scene.film.viewing.pixels_per_degree, *request.window);
            options.part = &part;
            options.part_picture = true;
        }
        total.add_to(stats.seconds.total);
        const TracedRays by_frame = s.traced() - before;
        std::unique_ptr<CarriedLight> carried;
        if (options.light_lasts) carried = find_carried_light(s, frame, plan, stats.keyframes, request);
        before = s.traced() - by_frame;
        total = {};
        s.here.leave_out(plan.effects);
        options.record_maps = request.maps;
        shade_prepared(s, frame, prepared, carried.get(), options, request);
    }
    if (request.maps) {
        const ShadingScene& shading = s.here.shading();
        fill_geometry_maps(shading, prepared.centers, out);
        out.surface.effects =
            make_effect_picture(prepared.centers.hits, plan.input.facts, plan.effects, shading.instances.size());
    }
    out.hits = prepared.centers.hits;
    if (request.window) cut_to_window(out, *request.window);
    s.rendered = frame;
    stats.traced = s.traced() - before;
    s.motion.end_edited();
    stats.plan = plan.effects;
    stats.seconds.plan = plan.seconds;
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return std::move(out);
}

}  // namespace aleph
