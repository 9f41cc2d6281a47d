// The effects plan of a frame: what is known before its first rays, and what the model of vision adds.

#include "render/frame/sequence_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/frame/sequence_state.h"

namespace aleph {

namespace {

/// m: along the view direction for the lens, straight for the shutter.
struct Nearest {
    double depth = std::numeric_limits<double>::infinity(), distance = depth;
};

Nearest find_nearest(const FrameFacts& facts, const CameraView& view) {
    Nearest nearest;
    for (const ObjectFacts& object : facts.objects) {
        if (!object.in_view) continue;
        const glm::dvec3 outside =
            glm::max(glm::max(object.bounds.low - view.position, view.position - object.bounds.high), glm::dvec3(0.0));
        nearest.distance = std::min(nearest.distance, glm::length(outside));
        for (int i = 0; i < 8; ++i)
            nearest.depth = std::min(nearest.depth, -to_camera(view, object.bounds.corner(i)).z);
    }
    nearest.depth = std::max(nearest.depth, view.near_plane);
    return nearest;
}

constexpr int filter_reach = 2;  // pixels to which the filter brings light of a surface, which blur may move a little

bool is_near_surface(const Image<Hit>& hits, int x, int y) {
    for (int ny = std::max(0, y - filter_reach); ny <= std::min(hits.height - 1, y + filter_reach); ++ny) {
        for (int nx = std::max(0, x - filter_reach); nx <= std::min(hits.width - 1, x + filter_reach); ++nx) {
            if (hits(nx, ny).instance != no_index) return true;
        }
    }
    return false;
}

VisibleFrame find_least_thresholds(const Image<Hit>& hits, const Image<float>& threshold) {
    constexpr double none = std::numeric_limits<double>::infinity();
    VisibleFrame visible{none, none, 0.0};
    for (int y = 0; y < threshold.height; ++y) {
        for (int x = 0; x < threshold.width; ++x) {
            const double here = threshold(x, y);
            visible.threshold = std::min(visible.threshold, here);
            if (here < visible.on_surfaces && is_near_surface(hits, x, y)) visible.on_surfaces = here;
        }
    }
    return visible;
}

}  // namespace

std::optional<BlurMoments> find_camera_blur(const std::vector<CameraValues>& cameras, int width, int height,
                                            double nearest, double& largest) {
    constexpr int places = 5;  // in each direction
    const CameraView middle = make_camera_view(cameras[cameras.size() / 2], width, height);
    std::vector<CameraView> views;
    for (const CameraValues& camera : cameras) {
        if (camera.aperture != cameras.front().aperture || camera.focus_distance != cameras.front().focus_distance)
            return std::nullopt;
        views.push_back(make_camera_view(camera, width, height));
        const double step = glm::length(views.back().position - middle.position);
        if (step > 0.0 && (!(nearest > 4.0 * step) || !std::isfinite(nearest))) return std::nullopt;
    }
    BlurMoments worst;
    largest = 0.0;
    for (int i = 0; i < places * places; ++i) {
        const glm::dvec2 place(width * (i % places) / (places - 1.0), height * (i / places) / (places - 1.0));
        const CameraRay ray = make_camera_ray(middle, place.x, place.y);
        glm::dvec2 sum(0.0), low(0.0), high(0.0);
        BlurMoments here;
        for (const CameraView& view : views) {
            // A point that is far away, and how much more the nearest ones move.
            const glm::dvec3 turned = ray.direction * view.axes;
            const glm::dvec3 at = middle.orthographic
                                      ? to_camera(view, ray.origin + ray.direction * (2.0 * std::max(nearest, 1.0)))
                                      : turned;
            if (!(-at.z > 0.0)) return std::nullopt;
            const glm::dvec2 moved = project_camera_point(view, at) - place;
            const double depth = nearest - glm::length(view.position - middle.position);
            const double step = middle.orthographic
                                    ? 0.0
                                    : 1.5 * view.pixels_per_unit * glm::length(view.position - middle.position) /
                                          std::max(depth, 1e-300) * glm::dot(turned, turned) / (turned.z * turned.z);
            const double length = glm::length(moved) + step;
            sum += moved;
            low = glm::min(low, moved - step);
            high = glm::max(high, moved + step);
            here.mean += length / static_cast<double>(views.size());
            here.shift += step / static_cast<double>(views.size());
            here.mean_square += length * length / static_cast<double>(views.size());
        }
        here.shift += glm::length(sum) / static_cast<double>(views.size());
        worst.mean = std::max(worst.mean, here.mean);
        worst.shift = std::max(worst.shift, here.shift);
        worst.mean_square = std::max(worst.mean_square, here.mean_square);
        largest = std::max(largest, glm::length(high - low));
    }
    return worst;
}

double find_largest_circle(const CameraView& view, double radius, double focus, double nearest) {
    if (view.orthographic) return std::numeric_limits<double>::infinity();
    const double vergence = std::max(std::abs(1.0 / nearest - 1.0 / focus), 1.0 / focus);
    return 2.0 * radius * vergence * view.pixels_per_unit;
}

/// Of `now`, which is this frame. What cannot change the picture is skipped.
/// @param edited  motion leads from a frame before an edit
FramePlan SequenceState::begin_plan(std::int64_t frame, OtherFrame which, bool perceive, bool maps, bool edited) {
    StageClock clock;
    FramePlan plan;
    if (!shot_facts) shot_facts = find_shot_facts(scene, textures, pose_plan);
    const Lens lens = find_lens(scene, now->pose.cameras[camera(frame)]);
    const std::optional<ShutterInterval> interval = find_open_shutter(frame);
    plan.facts = find_frame_facts(scene, *shot_facts, textures, now->pose, now->view, interval || lens.radius > 0.0);
    plan.lens.radius = lens.radius;
    const Nearest nearest = find_nearest(plan.facts, now->view);
    if (lens.radius > 0.0) {
        const double depth = plan.facts.sees_all ? now->view.near_plane : nearest.depth;
        plan.lens.circle = find_largest_circle(now->view, lens.radius, lens.focus_distance, depth);
    }
    plan.shutter.open = interval.has_value();
    if (interval) {
        const double rate = scene.frame_rate.per_second();
        const double open_at = interval->open / rate, close_at = interval->close / rate;
        plan.shutter.changes = !steady.is_steady(camera(frame), open_at, close_at);
        if (plan.shutter.changes && !plan.facts.sees_all && steady.is_world_steady(open_at, close_at)) {
            plan.shutter.blur = find_camera_blur(camera_span.look(camera(frame), open_at, close_at), settings.width,
                                                 settings.height, nearest.distance, plan.shutter.largest);
        }
    }
    plan.perceives = perceive;
    plan.maps = maps;
    plan.has_other = which != OtherFrame::none;
    plan.moments = shot_light.has_value();
    if (perceive && plan.has_other && !edited) {
        const double other_at = find_seconds(other_frame_number(frame, which));
        plan.moves = !steady.is_steady(camera(frame), std::min(now->pose.seconds, other_at),
                                       std::max(now->pose.seconds, other_at));
    }
    plan.settings = settings;
    plan.effects = make_effects_plan(plan, std::nullopt);
    if (plan.skips(Effect::indirect_diffuse)) plan.settings.bounces = 0;
    clock.add_to(plan.seconds);
    return plan;
}

EffectsPlan SequenceState::make_effects_plan(const FramePlan& plan, const std::optional<VisibleFrame>& visible) const {
    return plan_effects({.scene = scene,
                         .settings = settings,
                         .facts = plan.facts,
                         .shutter = plan.shutter,
                         .lens = plan.lens,
                         .perceives = plan.perceives,
                         .maps = plan.maps,
                         .has_other = plan.has_other,
                         .moves = plan.moves,
                         .moments = plan.moments,
                         .luminance_scale = exposure * scene.viewing.display_white},
                        visible);
}

/// Adds what a viewer cannot see, once the frame has been estimated.
void SequenceState::finish_plan(const Image<Hit>& hits, const FrameOutput& out, FramePlan& plan) const {
    if (out.threshold.empty()) return;
    StageClock clock;
    VisibleFrame visible = find_least_thresholds(hits, out.threshold);
    for (const Rgb& pixel : out.estimate.pixels)
        visible.brightest = std::max(visible.brightest, double{luminance(pixel)});
    visible.brightest *= scene.viewing.display_white;
    plan.effects = make_effects_plan(plan, visible);
    plan.settings.bounces = settings.bounces;
    if (plan.skips(Effect::indirect_diffuse)) plan.settings.bounces = 0;
    if (plan.skips(Effect::more_bounces)) plan.settings.bounces = std::min(plan.settings.bounces, 1);
    clock.add_to(plan.seconds);
}

/// What the sequence's shading leaves out.
void SequenceState::leave_out(const EffectsPlan& effects) {
    shading->skipped = effects.left_out();
    shading->points_unshadowed = effects.points_unshadowed;
    std::vector<int> instances, punctual;
    if (settings.forbid.contains(Effect::direct_light)) return remove_all_lights(lights);
    for (const LightFacts& light : effects.lights_left_out) {
        (light.kind == LightFacts::Kind::surface ? instances : punctual).push_back(light.number);
    }
    if (!effects.lights_left_out.empty()) remove_lights(*shading, instances, punctual, lights);
}

}  // namespace aleph
