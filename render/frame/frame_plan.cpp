// The effects plan of a frame: what is known before its first rays, and what the model of vision adds.

#include "render/frame/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/pixel_loops.h"
#include "render/plan/effect_bounds.h"
#include "render/settings/measure.h"

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
        nearest.distance = std::min(nearest.distance, distance_to(object.bounds, view.position));
        for (int i = 0; i < 8; ++i)
            nearest.depth = std::min(nearest.depth, -to_camera(view, object.bounds.corner(i)).z);
    }
    nearest.depth = std::max(nearest.depth, view.near_plane);
    return nearest;
}

constexpr int filter_reach = 2;  // pixels to which the filter brings light of a surface, which blur may move a little

bool is_near_surface(const Image<Hit>& hits, int x, int y) {
    bool near = false;
    visit_around(hits, x, y, filter_reach, [&](int nx, int ny) { near = near || hits(nx, ny).instance != no_index; });
    return near;
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

/// How far the picture moves while a camera takes these values in turn, about the middle one; nothing if that is not
/// known, because it moves past objects.
/// @param nearest  m, distance of what is in view; infinite: nothing is
/// @param largest  set to the largest distance between two places of a point, pixels
std::optional<BlurMoments> find_camera_blur(const std::vector<CameraValues>& cameras, int width, int height,
                                            double nearest, double& largest) {
    constexpr int places = 5;  // in each direction
    const CameraView middle = make_camera_view(cameras[cameras.size() / 2], width, height);
    std::vector<CameraView> views;
    for (const CameraValues& camera : cameras) {
        if (camera.aperture != cameras.front().aperture || camera.focus_distance != cameras.front().focus_distance)
            return std::nullopt;
        views.push_back(make_camera_view(camera, width, height));
        // In a parallel view that turns, a point moves by its distance times the angle.
        if (middle.orthographic && views.back().axes != middle.axes) return std::nullopt;
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
            const glm::dvec3 at = middle.orthographic ? to_camera(view, ray.origin + ray.direction) : turned;
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

/// Largest diameter of the circle of confusion, pixels.
/// @param nearest  m along the view direction, of what is in view
double find_largest_circle(const CameraView& view, double radius, double focus, double nearest) {
    if (view.orthographic) return std::numeric_limits<double>::infinity();
    const double vergence = std::max(std::abs(1.0 / nearest - 1.0 / focus), 1.0 / focus);
    return 2.0 * radius * vergence * view.pixels_per_unit;
}

}  // namespace

/// The camera's values at equal steps, eight for each of the spans between keys, both ends included.
/// @param camera    index into ScenePose::cameras
/// @param from, to  s
std::vector<CameraValues> FramePlanner::look(int camera, double from, double to) {
    constexpr std::size_t most_spans = 32;
    const std::size_t spans = std::min(most_spans, find_key_times(shot_.scene, from, to).size() + 1);
    const int looks = static_cast<int>(8 * spans) + 1;
    std::vector<CameraValues> values;
    for (int i = 0; i < looks; ++i) {
        const double seconds = from + (to - from) * i / (looks - 1);
        if (posed_) {
            update_pose(shot_.scene, shot_.pose_plan, seconds, *posed_);
        } else {
            posed_ = pose(shot_.scene, seconds);
        }
        values.push_back(posed_->cameras[camera]);
    }
    return values;
}

/// How far the picture moves while the shutter is open, where only the camera moves.
ShutterFacts FramePlanner::find_shutter_facts(const FrameWork& work, const FrameFacts& facts, double nearest) {
    ShutterFacts shutter;
    const std::optional<ShutterInterval> interval = shot_.open_shutter(work.frame);
    shutter.open = interval.has_value();
    if (!interval) return shutter;
    const int camera = shot_.camera(work.frame);
    const double rate = shot_.scene.film.frame_rate.per_second();
    const double open_at = interval->open / rate, close_at = interval->close / rate;
    shutter.changes = !shot_.steady.is_steady(camera, open_at, close_at);
    shutter.light_changes = shutter.changes && light_breaks_.changes(interval->open, interval->close);
    shutter.world_changes = shutter.changes && !shot_.steady.is_world_steady(open_at, close_at);
    if (shutter.changes && !shutter.world_changes && !facts.sees_all) {
        shutter.blur = find_camera_blur(look(camera, open_at, close_at), shot_.settings.picture.width,
                                        shot_.settings.picture.height, nearest, shutter.largest);
    }
    return shutter;
}

/// Sets the lens and its facts.
/// @param nearest  m along the view direction, of what is in view while the shutter is open
void FramePlanner::find_lens_facts(const FrameWork& work, const PosedView& posed, double nearest, FramePlan& frame) {
    const int index = shot_.camera(work.frame);
    std::vector<CameraValues> cameras{posed.pose.cameras[index]};
    const Camera& camera = shot_.scene.cameras[shot_.scene.nodes[cameras.front().node].camera];
    const std::optional<ShutterInterval> interval = shot_.open_shutter(work.frame);
    const bool blurs = interval && !shot_.settings.effects.forbid.contains(Effect::motion_blur);
    if (blurs && (is_animated(camera.aperture) || is_animated(camera.focus_distance))) {
        const double rate = shot_.scene.film.frame_rate.per_second();
        const std::vector<CameraValues> looks = look(index, interval->open / rate, interval->close / rate);
        cameras.insert(cameras.end(), looks.begin(), looks.end());
    }
    double& circle = frame.input.lens.circle;
    for (const CameraValues& values : cameras) {
        const Lens lens = find_lens(shot_.scene, values);
        if (!(lens.radius > 0.0)) continue;
        const CameraView view = make_camera_view(values, posed.view.width, posed.view.height);
        circle = std::max(circle, find_largest_circle(view, lens.radius, lens.focus_distance, nearest));
        if (lens.radius > frame.lens.radius) frame.lens = lens;
    }
    frame.input.lens.radius = frame.lens.radius;
}

FramePlan FramePlanner::begin(const FrameWork& work, const PosedView& posed) {
    StageClock clock;
    FramePlan frame;
    PlanInput& in = frame.input;
    if (!facts_) facts_ = find_shot_facts(shot_.scene, shot_.textures, shot_.pose_plan);
    const Lens lens = find_lens(shot_.scene, posed.pose.cameras[shot_.camera(work.frame)]);
    const bool blurs = shot_.open_shutter(work.frame) || lens.radius > 0.0;
    in.facts = find_frame_facts(shot_.scene, *facts_, shot_.textures, posed.pose, posed.view, blurs);
    const Nearest nearest = find_nearest(in.facts, posed.view);
    in.shutter = find_shutter_facts(work, in.facts, nearest.distance);
    const bool is_depth_known = !in.facts.sees_all && !in.shutter.changes;
    find_lens_facts(work, posed, is_depth_known ? nearest.depth : posed.view.near_plane, frame);
    in.perceives = work.perceive;
    in.maps = work.maps;
    in.has_other = work.other != OtherFrame::none || work.edited;
    in.keyframes = reads_keyframes(shot_.settings);
    if (work.perceive && in.has_other && !work.edited) {
        const double now = posed.pose.seconds, other = shot_.seconds(other_frame_number(work.frame, work.other));
        in.moves = !shot_.steady.is_steady(shot_.camera(work.frame), std::min(now, other), std::max(now, other));
    }
    in.luminance_scale = shot_.exposure * shot_.scene.film.viewing.display_white;
    frame.settings = shot_.settings;
    plan(frame, std::nullopt);
    clock.add_to(frame.seconds);
    return frame;
}

void FramePlanner::plan(FramePlan& frame, const std::optional<VisibleFrame>& visible) const {
    frame.effects = plan_effects(shot_.scene, shot_.settings, frame.input, visible);
    int& bounces = frame.settings.light.bounces;
    bounces = shot_.settings.light.bounces;
    if (frame.skips(Effect::indirect_diffuse)) bounces = 0;
    if (visible && frame.skips(Effect::more_bounces)) bounces = std::min(bounces, 1);
}

void FramePlanner::finish(const Image<Hit>& hits, const FrameOutput& out, FramePlan& frame) const {
    if (out.limits.threshold.empty()) return;
    StageClock clock;
    VisibleFrame visible = find_least_thresholds(hits, out.limits.threshold);
    for (const Rgb& pixel : out.estimate.pixels)
        visible.brightest = std::max(visible.brightest, double{luminance(pixel)});
    visible.brightest *= shot_.scene.film.viewing.display_white;
    plan(frame, visible);
    clock.add_to(frame.seconds);
}

}  // namespace aleph
