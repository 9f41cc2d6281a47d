#include "motion/model_motion.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "motion/reprojection.h"
#include "motion/turn.h"

namespace aleph {
namespace {

/// The turn (of an object or the camera) that one chord of the path may stand for, radians.
constexpr double max_chord_turn = 20.0 * std::numbers::pi / 180.0;

/// What is known about an object (or the background) before any pixel is looked at.
struct ObjectMotion {
    CameraFromObject now, other;
    bool counterpart = false;  ///< shown at the other moment too
    bool still = false;        ///< both projections are the same bits
    bool deforms = false;
    const Mesh* mesh = nullptr;
    const PosedMesh* shape_now = nullptr;
    const PosedMesh* shape_other = nullptr;
    /// Its place and shape at a moment.
    struct Moment {
        CameraFromObject place;
        PosedMesh shape;
    };
    /// Where it turns too far for a chord: the sub-frame moments, from now towards other. Else empty.
    std::vector<Moment> between;
};

/// Everything that a frame's pixels share.
struct FrameMotion {
    CameraView now, other;
    std::vector<CameraView> between;  ///< sub-frame moments, from now towards other
    std::vector<ObjectMotion> objects;
    ObjectMotion background;
    double sign = 1.0;  ///< -1: displacement is now - other
    double diagonal = 0.0;
};

/// Index of the scene's camera that both views look through; no_index for views made by hand.
int find_viewing_camera(const PosedView& now, const PosedView& other) {
    const auto matches = [](const CameraView& view, const CameraValues& camera) {
        return view.orthographic == camera.orthographic && view.position == camera.position && view.axes == camera.axes;
    };
    const std::size_t count = std::min(now.pose.cameras.size(), other.pose.cameras.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (matches(now.view, now.pose.cameras[i]) && matches(other.view, other.pose.cameras[i])) {
            return static_cast<int>(i);
        }
    }
    return no_index;
}

/// Between two views that no camera of the scene explains.
CameraView interpolate_view(const CameraView& a, const CameraView& b, double fraction) {
    CameraView view = a;
    view.position = glm::mix(a.position, b.position, fraction);
    view.axes = glm::mat3_cast(glm::slerp(glm::quat_cast(a.axes), glm::quat_cast(b.axes), fraction));
    view.pixels_per_unit = std::lerp(a.pixels_per_unit, b.pixels_per_unit, fraction);
    view.axis_offset = glm::mix(a.axis_offset, b.axis_offset, fraction);
    return view;
}

double turn_between(const CameraView& a, const CameraView& b) {
    return glm::angle(glm::normalize(glm::quat_cast(glm::transpose(a.axes) * b.axes)));
}

bool same_projection(const CameraView& a, const CameraView& b) {
    return a.width == b.width && a.height == b.height && a.orthographic == b.orthographic &&
           a.pixels_per_unit == b.pixels_per_unit && a.axis_offset == b.axis_offset && a.near_plane == b.near_plane;
}

/// The background lies at infinity: only rotation moves it. Its points are directions in the axes of `now`.
CameraFromObject make_background_map(const CameraView& now, const CameraView& view) {
    return {glm::transpose(view.axes) * now.axes, glm::dvec3(0.0)};
}

/// Poses the moments between, where something turns too far for a chord, and keeps what is needed of them.
void add_moments_between(FrameMotion& motion, const Scene& scene, const PosedView& now, const PosedView& other) {
    const int camera = find_viewing_camera(now, other);
    const int camera_node = camera == no_index ? no_index : now.pose.cameras[camera].node;
    const double limit = max_chord_turn;
    const double begin = now.pose.seconds, end = other.pose.seconds;
    const double view_turn = camera == no_index ? turn_between(now.view, other.view) : 0.0;
    const std::vector<double> times = subdivide_turns(scene, camera_node, begin, end, limit, view_turn);
    if (times.empty()) return;

    const Turns turns = compute_turns(scene, camera_node, begin, end);
    const bool background_turns = !now.view.orthographic && turns.background + view_turn > limit;
    for (const double seconds : times) {
        const ScenePose frame = pose(scene, seconds);
        const CameraView view = camera == no_index
                                    ? interpolate_view(now.view, other.view, (seconds - begin) / (end - begin))
                                    : make_camera_view(frame.cameras[camera], now.view.width, now.view.height);
        motion.between.push_back(view);
        if (background_turns) motion.background.between.push_back({make_background_map(now.view, view), {}});
        for (std::size_t i = 0; i < motion.objects.size(); ++i) {
            const auto node = static_cast<std::size_t>(now.pose.instances[i].node);
            if (motion.objects[i].counterpart && turns.nodes[node] + view_turn > limit) {
                const auto mesh = static_cast<std::size_t>(now.pose.instances[i].mesh);
                motion.objects[i].between.push_back(
                    {make_camera_from_object(view, frame.world[node]), frame.meshes[mesh]});
            }
        }
    }
}

FrameMotion prepare(const Scene& scene, const PosedView& now, const PosedView& other, OtherFrame which) {
    FrameMotion motion;
    motion.now = now.view;
    motion.other = other.view;
    motion.sign = displacement_sign(which);
    motion.diagonal = std::hypot(now.view.width, now.view.height);
    const bool same = same_projection(motion.now, motion.other);

    motion.background.counterpart = true;
    motion.background.now = make_background_map(motion.now, motion.now);
    motion.background.other = make_background_map(motion.now, motion.other);
    motion.background.still = motion.now.orthographic || (same && motion.background.now == motion.background.other);

    motion.objects.resize(now.pose.instances.size());
    for (std::size_t i = 0; i < motion.objects.size(); ++i) {
        const Instance& instance = now.pose.instances[i];
        const auto node = static_cast<std::size_t>(instance.node);
        ObjectMotion& object = motion.objects[i];
        object.mesh = &scene.meshes[instance.mesh];
        object.now = make_camera_from_object(motion.now, now.pose.world[node]);
        // The list of instances is the same at every time; two frames of different scenes have no counterparts.
        if (i >= other.pose.instances.size() || !(other.pose.instances[i] == instance)) continue;
        object.counterpart = other.pose.shown[i] != 0;
        object.other = make_camera_from_object(motion.other, other.pose.world[node]);
        object.shape_now = &now.pose.meshes[instance.mesh];
        object.shape_other = &other.pose.meshes[instance.mesh];
        object.deforms = !object.shape_now->positions.empty();
        object.still = same && object.now == object.other && *object.shape_now == *object.shape_other;
    }
    add_moments_between(motion, scene, now, other);
    return motion;
}

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

/// Q at both moments, in object space, m; or a direction of the background.
struct SurfacePlace {
    glm::dvec3 now{0.0}, other{0.0};
    const Hit* hit = nullptr;
};

/// Sum of the chords over the moments between; a chord with an end behind the camera counts nothing.
[[gnu::noinline]] double compute_path_length(const FrameMotion& frame, const ObjectMotion& object, SurfacePlace place,
                                             glm::dvec2 start, glm::dvec2 end) {
    double sum = 0.0;
    glm::dvec2 previous = start;
    bool known = true;
    const auto go_to = [&](const glm::dvec2& next) {
        if (known) sum += glm::length(cap_length(next - previous, frame.diagonal));
        previous = next;
        known = true;
    };
    for (std::size_t i = 0; i < object.between.size(); ++i) {
        const ObjectMotion::Moment& moment = object.between[i];
        const bool moved = object.deforms && !moment.shape.positions.empty();
        const glm::dvec3 p = moment.place(moved ? surface_point(*object.mesh, moment.shape, *place.hit) : place.now);
        if (-p.z > nearest_depth(frame.between[i])) {
            go_to(project_camera_point(frame.between[i], p));
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

/// Motion of a surface point or of a background direction. The same function projects both moments, so that equal bits
/// give exactly 0.
PixelMotion compute_point_motion(const FrameMotion& frame, const ObjectMotion& object, const SurfacePlace& place,
                                 double near_now, double near_other) {
    PixelMotion motion;
    const glm::dvec3 from = object.now(place.now);
    const glm::dvec3 to = object.still ? from : object.other(place.other);
    if (!(-from.z > near_now) || !(-to.z > near_other)) {
        motion.validity = MotionValidity::behind_camera;
        return motion;
    }
    const glm::dvec2 start = project_camera_point(frame.now, from);
    const glm::dvec2 end = object.still ? start : project_camera_point(frame.other, to);
    motion.displacement = cap_length(frame.sign * (end - start), frame.diagonal);
    motion.path_length = object.between.empty() ? glm::length(motion.displacement)
                                                : compute_path_length(frame, object, place, start, end);
    if (!is_on_screen(frame.other, end)) motion.validity = MotionValidity::leaves_screen;
    return motion;
}

PixelMotion compute_background_motion(const FrameMotion& frame, double x, double y) {
    PixelMotion motion;
    if (!frame.background.still || !frame.background.between.empty()) {
        const glm::dvec3 direction(unproject_pixel(frame.now, x, y), -1.0);
        // At infinity every direction before the camera is beyond the near plane.
        constexpr double smallest = 1e-12;
        motion = compute_point_motion(frame, frame.background, {direction, direction}, smallest, smallest);
    }
    motion.validity = MotionValidity::background;
    return motion;
}

/// Apart, so that what is rigid stays one short path.
[[gnu::noinline]] PixelMotion compute_deforming_motion(const FrameMotion& frame, const ObjectMotion& object,
                                                       const Hit& hit) {
    const SurfacePlace place{surface_point(*object.mesh, *object.shape_now, hit),
                             surface_point(*object.mesh, *object.shape_other, hit), &hit};
    return compute_point_motion(frame, object, place, nearest_depth(frame.now), nearest_depth(frame.other));
}

PixelMotion compute_hit_motion(const FrameMotion& frame, const Hit& hit) {
    const ObjectMotion& object = frame.objects[hit.instance];
    if (!object.counterpart) return {.validity = MotionValidity::no_counterpart};
    if (object.deforms) return compute_deforming_motion(frame, object, hit);
    const glm::dvec3 point = surface_point(*object.mesh, hit);
    return compute_point_motion(frame, object, {point, point, &hit}, nearest_depth(frame.now),
                                nearest_depth(frame.other));
}

}  // namespace

MotionField compute_model_motion(const Scene& scene, const PosedView& now, const PosedView& other,
                                 const Image<Hit>& hits, OtherFrame which) {
    ALEPH_CHECK(hits.width == now.view.width && hits.height == now.view.height,
                fmt::format("{}x{} hits, {}x{} view", hits.width, hits.height, now.view.width, now.view.height));
    MotionField field;
    field.displacement = Image<glm::dvec2>(hits.width, hits.height);
    field.path_length = Image<double>(hits.width, hits.height);
    field.validity = Image<MotionValidity>(hits.width, hits.height);

    if (which == OtherFrame::none) {
        for (std::size_t i = 0; i < hits.size(); ++i) {
            field.validity.pixels[i] =
                hits.pixels[i].instance == no_index ? MotionValidity::background : MotionValidity::no_counterpart;
        }
        return field;
    }
    const FrameMotion frame = prepare(scene, now, other, which);
    constexpr int rows_per_chunk = 8;
    parallel_rows(hits.height, rows_per_chunk, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < hits.width; ++x) {
                const Hit& hit = hits(x, y);
                const PixelMotion motion = hit.instance == no_index ? compute_background_motion(frame, x + 0.5, y + 0.5)
                                                                    : compute_hit_motion(frame, hit);
                field.displacement(x, y) = motion.displacement;
                field.path_length(x, y) = motion.path_length;
                field.validity(x, y) = motion.validity;
            }
        }
    });
    return field;
}

}  // namespace aleph
