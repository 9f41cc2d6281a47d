#include "motion/model_motion.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/base/pixel_loops.h"
#include "motion/reprojection.h"

namespace aleph {

/// An instance, or the background.
struct ObjectMotion {
    CameraFromObject now, other;
    bool counterpart = false;  ///< shown in the other frame too
    bool still = false;        ///< both projections are the same bits
    bool deforms = false;
    const Mesh* mesh = nullptr;
    const PosedMesh* shape_now = nullptr;
    const PosedMesh* shape_other = nullptr;
    /// Its place and shape at a time between the frames.
    struct Step {
        CameraFromObject place;
        PosedMesh shape;
    };
    /// From now towards other, where it turns too far for one chord. Else empty.
    std::vector<Step> steps;
};

struct PreparedMotion {
    CameraView now, other;
    std::vector<CameraView> steps;      ///< times between the frames, from now towards other
    std::vector<ObjectMotion> objects;  ///< as SeenInstances numbers them
    ObjectMotion background;
    double sign = 1.0;  ///< displacement_sign
    double diagonal = 0.0;
};

namespace {

/// The turn (of an object or the camera) that one chord of the path may stand for, radians.
constexpr double max_chord_turn = 20.0 * std::numbers::pi / 180.0;

struct PixelMotion {
    glm::dvec2 displacement{0.0};
    double path_length = 0.0;
    MotionValidity validity = MotionValidity::valid;
};

/// Keeps the direction. Takes lengths whose square overflows.
glm::dvec2 cap_length(const glm::dvec2& vector, double longest) {
    if (glm::dot(vector, vector) <= longest * longest) return vector;
    const double most = std::max(std::abs(vector.x), std::abs(vector.y));
    const glm::dvec2 scaled = vector / most;
    return scaled * (longest / glm::length(scaled));
}

/// Q at both times, in object space, m; or a direction of the background.
struct SurfacePlace {
    glm::dvec3 now{0.0}, other{0.0};
    const Hit* hit = nullptr;
};

/// Sum of the chords over the steps; a chord with an end behind the camera adds nothing.
[[gnu::noinline]] double compute_path_length(const PreparedMotion& all, const ObjectMotion& object, SurfacePlace place,
                                             glm::dvec2 start, glm::dvec2 end) {
    double sum = 0.0;
    glm::dvec2 previous = start;
    bool known = true;
    const auto go_to = [&](const glm::dvec2& next) {
        if (known) sum += glm::length(cap_length(next - previous, all.diagonal));
        previous = next;
        known = true;
    };
    for (std::size_t i = 0; i < object.steps.size(); ++i) {
        const ObjectMotion::Step& step = object.steps[i];
        const bool moved = object.deforms && !step.shape.positions.empty();
        const glm::dvec3 p = step.place(moved ? surface_point(*object.mesh, step.shape, *place.hit) : place.now);
        if (-p.z > nearest_depth(all.steps[i])) {
            go_to(project_camera_point(all.steps[i], p));
        } else {
            known = false;
        }
    }
    go_to(end);
    return sum;
}

bool is_on_screen(const CameraView& view, const glm::dvec2& p) {
    return p.x >= 0.0 && p.x <= view.width && p.y >= 0.0 && p.y <= view.height;
}

/// Motion of a surface point or of a background direction. The same function projects both, so that equal bits give
/// exactly 0.
PixelMotion compute_point_motion(const PreparedMotion& all, const ObjectMotion& object, const SurfacePlace& place,
                                 double near_now, double near_other) {
    PixelMotion motion;
    const glm::dvec3 from = object.now(place.now);
    const glm::dvec3 to = object.still ? from : object.other(place.other);
    if (!(-from.z > near_now) || !(-to.z > near_other)) {
        motion.validity = MotionValidity::behind_camera;
        return motion;
    }
    const glm::dvec2 start = project_camera_point(all.now, from);
    const glm::dvec2 end = object.still ? start : project_camera_point(all.other, to);
    motion.displacement = cap_length(all.sign * (end - start), all.diagonal);
    motion.path_length =
        object.steps.empty() ? glm::length(motion.displacement) : compute_path_length(all, object, place, start, end);
    if (!is_on_screen(all.other, end)) motion.validity = MotionValidity::leaves_screen;
    return motion;
}

PixelMotion compute_background_motion(const PreparedMotion& all, double x, double y) {
    PixelMotion motion;
    if (!all.background.still || !all.background.steps.empty()) {
        const glm::dvec3 direction(unproject_pixel(all.now, x, y), -1.0);
        // At infinity every direction before the camera is beyond the near plane.
        constexpr double smallest = 1e-12;
        motion = compute_point_motion(all, all.background, {direction, direction}, smallest, smallest);
    }
    motion.validity = MotionValidity::background;
    return motion;
}

/// Not inlined, so that the code for rigid objects stays short.
[[gnu::noinline]] PixelMotion compute_deforming_motion(const PreparedMotion& all, const ObjectMotion& object,
                                                       const Hit& hit) {
    const SurfacePlace place{surface_point(*object.mesh, *object.shape_now, hit),
                             surface_point(*object.mesh, *object.shape_other, hit), &hit};
    return compute_point_motion(all, object, place, nearest_depth(all.now), nearest_depth(all.other));
}

PixelMotion compute_hit_motion(const PreparedMotion& all, const ObjectMotion& object, const Hit& hit) {
    if (!object.counterpart) return {.validity = MotionValidity::no_counterpart};
    if (object.deforms) return compute_deforming_motion(all, object, hit);
    const glm::dvec3 point = surface_point(*object.mesh, hit);
    return compute_point_motion(all, object, {point, point, &hit}, nearest_depth(all.now), nearest_depth(all.other));
}

bool same_projection(const CameraView& a, const CameraView& b) {
    return a.width == b.width && a.height == b.height && a.orthographic == b.orthographic &&
           a.pixels_per_unit == b.pixels_per_unit && a.axis_offset == b.axis_offset;
}

/// Objects and background at both frames, without steps. Refers to the scene and to both poses.
PreparedMotion prepare_motion(const Scene& scene, const PosedView& now, const PosedView& other, OtherFrame which,
                              const SeenInstances& seen) {
    PreparedMotion motion;
    motion.now = now.view;
    motion.other = other.view;
    motion.sign = displacement_sign(which);
    motion.diagonal = std::hypot(now.view.width, now.view.height);
    const bool same = same_projection(motion.now, motion.other);

    motion.background.counterpart = true;
    motion.background.now = make_background_map(motion.now, motion.now);
    motion.background.other = make_background_map(motion.now, motion.other);
    motion.background.still = motion.now.orthographic || (same && motion.background.now == motion.background.other);

    const std::vector<Instance>&instances = now.pose.instances, &other_instances = other.pose.instances;
    motion.objects.resize(seen.instances().size());
    for (std::size_t i = 0; i < motion.objects.size(); ++i) {
        const auto place = static_cast<std::size_t>(seen.instances()[i]);
        const Instance& instance = instances[place];
        ObjectMotion& object = motion.objects[i];
        object.mesh = &scene.meshes[instance.mesh];
        object.now = make_camera_from_object(motion.now, now.pose.world[instance.node]);
        // The list of instances is the same at every time; poses of different scenes have no counterparts.
        if (place >= other_instances.size() || !(other_instances[place] == instance)) continue;
        object.counterpart = other.pose.shown[place] != 0;
        object.other = make_camera_from_object(motion.other, other.pose.world[instance.node]);
        object.shape_now = &now.pose.meshes[instance.mesh];
        object.shape_other = &other.pose.meshes[instance.mesh];
        object.deforms = !object.shape_now->positions.empty();
        object.still = same && object.now == object.other && *object.shape_now == *object.shape_other;
    }
    return motion;
}

}  // namespace

ModelMotion::ModelMotion(const Scene& scene, const PosePlan& plan) : scene_(scene), plan_(plan), turns_(scene, plan) {}

const ScenePose& ModelMotion::pose_between(double seconds) {
    if (between_) {
        update_pose(scene_, plan_, seconds, *between_);
    } else {
        between_ = pose(scene_, seconds);
    }
    return *between_;
}

void ModelMotion::add_steps(PreparedMotion& motion, const PosedView& now, const PosedView& other) {
    const int camera_node = now.pose.cameras[now.camera].node;
    const double begin = now.pose.seconds, end = other.pose.seconds;
    const std::vector<double> times = turns_.subdivide(camera_node, begin, end, max_chord_turn);
    if (times.empty()) return;

    turns_.find(camera_node, begin, end);
    const bool background_is_fast = !now.view.orthographic && turns_.background() > max_chord_turn;
    for (const double seconds : times) {
        const ScenePose& posed = pose_between(seconds);
        const CameraView view = make_camera_view(posed.cameras[now.camera], now.view.width, now.view.height);
        motion.steps.push_back(view);
        if (background_is_fast) motion.background.steps.push_back({make_background_map(now.view, view), {}});
        for (std::size_t i = 0; i < motion.objects.size(); ++i) {
            const Instance& instance = now.pose.instances[seen_.instances()[i]];
            if (!motion.objects[i].counterpart || !(turns_.of_node(instance.node) > max_chord_turn)) continue;
            motion.objects[i].steps.push_back(
                {make_camera_from_object(view, posed.world[instance.node]), posed.meshes[instance.mesh]});
        }
    }
}

MotionField ModelMotion::compute(const PosedView& now, const PosedView& other, const Image<Hit>& hits,
                                 OtherFrame which) {
    ALEPH_CHECK(hits.width == now.view.width && hits.height == now.view.height,
                fmt::format("{}x{} hits, {}x{} view", hits.width, hits.height, now.view.width, now.view.height));
    if (which == OtherFrame::none) return make_motion_field(hits.width, hits.height, MotionValidity::no_counterpart);
    MotionField field = make_motion_field(hits.width, hits.height, MotionValidity::background);
    seen_.find(hits, now.pose.instances.size());
    PreparedMotion all = prepare_motion(scene_, now, other, which, seen_);
    add_steps(all, now, other);
    constexpr int rows_per_chunk = 8;
    parallel_pixels(hits, rows_per_chunk, [&](int x, int y) {
        const Hit& hit = hits(x, y);
        const PixelMotion motion = hit.instance == no_index
                                       ? compute_background_motion(all, x + 0.5, y + 0.5)
                                       : compute_hit_motion(all, all.objects[seen_.number(hit.instance)], hit);
        field.displacement(x, y) = motion.displacement;
        field.path_length(x, y) = motion.path_length;
        field.validity(x, y) = motion.validity;
    });
    return field;
}

MotionField compute_model_motion(const Scene& scene, const PosedView& now, const PosedView& other,
                                 const Image<Hit>& hits, OtherFrame which) {
    const PosePlan plan = make_pose_plan(scene);
    return ModelMotion(scene, plan).compute(now, other, hits, which);
}

MotionField make_still_motion(const CameraView& view, const Image<Hit>& hits) {
    MotionField field = make_motion_field(hits.width, hits.height, MotionValidity::background);
    parallel_pixels(hits, 16, [&](int x, int y) {
        const Hit& hit = hits(x, y);
        if (hit.instance == no_index) return;
        const CameraRay ray = make_camera_ray(view, x + 0.5, y + 0.5);
        const double depth = -(ray.direction * view.axes).z * hit.distance;
        field.validity(x, y) = depth > view.near_plane ? MotionValidity::valid : MotionValidity::behind_camera;
    });
    return field;
}

}  // namespace aleph
