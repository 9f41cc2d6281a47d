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
    bool counterpart = false;  ///< in the other frame too
    bool still = false;        ///< both projections are the same bits
    bool deforms = false;
    bool fast = false;  ///< turns too far for one chord
    const Mesh* mesh = nullptr;
    const PosedMesh* shape_now = nullptr;
    const PosedMesh* shape_other = nullptr;
    // Place and shape at the time of a step.
    CameraFromObject step;
    const PosedMesh* shape_step = nullptr;
};

struct PreparedMotion {
    CameraView now, other, step;
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
    double near_now = 0.0, near_other = 0.0;  ///< depths that count as before the camera
};

/// Not inlined, so that the code for rigid objects stays short.
[[gnu::noinline]] glm::dvec3 find_deforming_point(const ObjectMotion& object, const PosedMesh& shape, const Hit& hit) {
    return surface_point(*object.mesh, shape, hit);
}

[[gnu::always_inline]] inline SurfacePlace find_place(const PreparedMotion& all, const ObjectMotion& object,
                                                      const Hit& hit, double x, double y) {
    if (hit.instance == no_index) {
        // At infinity every direction before the camera is beyond the near plane.
        constexpr double smallest = 1e-12;
        const glm::dvec3 direction(unproject_pixel(all.now, x, y), -1.0);
        return {direction, direction, smallest, smallest};
    }
    const double near_now = nearest_depth(all.now), near_other = nearest_depth(all.other);
    if (object.deforms) {
        return {find_deforming_point(object, *object.shape_now, hit),
                find_deforming_point(object, *object.shape_other, hit), near_now, near_other};
    }
    const glm::dvec3 point = surface_point(*object.mesh, hit);
    return {point, point, near_now, near_other};
}

/// Where a place is seen at both times, pixels.
struct Chord {
    glm::dvec2 start, end;
};

/// The same function projects both, so that equal bits give exactly 0. Nothing for what is behind a camera.
[[gnu::always_inline]] inline std::optional<Chord> find_chord(const PreparedMotion& all, const ObjectMotion& object,
                                                              const SurfacePlace& place) {
    const glm::dvec3 from = object.now(place.now);
    const glm::dvec3 to = object.still ? from : object.other(place.other);
    if (!(-from.z > place.near_now) || !(-to.z > place.near_other)) return std::nullopt;
    const glm::dvec2 start = project_camera_point(all.now, from);
    return Chord{start, object.still ? start : project_camera_point(all.other, to)};
}

bool is_on_screen(const CameraView& view, const glm::dvec2& p) {
    return p.x >= 0.0 && p.x <= view.width && p.y >= 0.0 && p.y <= view.height;
}

/// The motion along the chord.
PixelMotion compute_pixel_motion(const PreparedMotion& all, const ObjectMotion& object, const Hit& hit, double x,
                                 double y) {
    if (!object.counterpart) return {.validity = MotionValidity::no_counterpart};
    const bool is_background = hit.instance == no_index;
    PixelMotion motion;
    if (is_background) motion.validity = MotionValidity::background;
    if (is_background && object.still) return motion;
    const std::optional<Chord> chord = find_chord(all, object, find_place(all, object, hit, x, y));
    if (!chord) {
        if (!is_background) motion.validity = MotionValidity::behind_camera;
        return motion;
    }
    motion.displacement = cap_length(all.sign * (chord->end - chord->start), all.diagonal);
    motion.path_length = glm::length(motion.displacement);
    if (!is_background && !is_on_screen(all.other, chord->end)) motion.validity = MotionValidity::leaves_screen;
    return motion;
}

/// The way of a pixel whose object is fast, up to a step.
struct PixelPath {
    int x = 0, y = 0;
    bool known = true;     ///< false: behind the camera at the last step
    glm::dvec2 last{0.0};  ///< pixels
};

/// Adds the chord to the next step; a chord with an end behind the camera adds nothing.
void extend(PixelPath& path, const glm::dvec2& next, double diagonal, double& sum) {
    if (path.known) sum += glm::length(cap_length(next - path.last, diagonal));
    path.last = next;
    path.known = true;
}

/// Adds the chord to the step that `all` holds.
void extend_to_step(const PreparedMotion& all, const ObjectMotion& object, const Hit& hit, PixelPath& path,
                    double& sum) {
    const bool moved = object.deforms && !object.shape_step->positions.empty();
    const glm::dvec3 point = moved ? find_deforming_point(object, *object.shape_step, hit)
                                   : find_place(all, object, hit, path.x + 0.5, path.y + 0.5).now;
    const glm::dvec3 p = object.step(point);
    if (-p.z > nearest_depth(all.step)) {
        extend(path, project_camera_point(all.step, p), all.diagonal, sum);
    } else {
        path.known = false;
    }
}

bool same_projection(const CameraView& a, const CameraView& b) {
    return a.width == b.width && a.height == b.height && a.orthographic == b.orthographic &&
           a.pixels_per_unit == b.pixels_per_unit && a.axis_offset == b.axis_offset;
}

/// Objects and background at both frames. Refers to the scene and to both poses.
PreparedMotion prepare_motion(const Scene& scene, const PosedView& now, const PosedView& other, OtherFrame which,
                              const SeenInstances& seen) {
    PreparedMotion motion;
    motion.now = now.view;
    motion.other = other.view;
    motion.sign = displacement_sign(which);
    motion.diagonal = std::hypot(now.view.width, now.view.height);
    const bool same = same_projection(motion.now, motion.other);

    motion.background.counterpart = true;
    const glm::dmat3 axes = background_axes(now.view, now.pose);
    motion.background.now = make_background_map(axes, axes);
    motion.background.other = make_background_map(axes, background_axes(other.view, other.pose));
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
        object.other = make_camera_from_object(motion.other, other.pose.world[instance.node]);
        object.shape_now = &now.pose.meshes[instance.mesh];
        object.shape_other = &other.pose.meshes[instance.mesh];
        // Lost is what rays can meet now and not then; hits on other things are not of rays.
        const bool lost = is_traceable(now.pose.world[instance.node]) && !is_traceable(other.pose.world[instance.node]);
        object.counterpart = other.pose.shown[place] != 0 && !lost && are_traceable(object.shape_other->positions);
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

void ModelMotion::sum_paths(PreparedMotion& all, const PosedView& now, const PosedView& other, const Image<Hit>& hits,
                            MotionField& field) {
    const int camera_node = now.pose.cameras[now.camera].node;
    const double begin = now.pose.seconds, end = other.pose.seconds;
    const std::vector<double> times = turns_.subdivide(camera_node, begin, end, max_chord_turn);
    if (times.empty()) return;

    turns_.find(camera_node, begin, end);
    all.background.fast = !now.view.orthographic && turns_.background() > max_chord_turn;
    const auto instance_of = [&](std::size_t i) { return now.pose.instances[seen_.instances()[i]]; };
    for (std::size_t i = 0; i < all.objects.size(); ++i)
        all.objects[i].fast = all.objects[i].counterpart && turns_.of_node(instance_of(i).node) > max_chord_turn;

    const auto object_of = [&](const PixelPath& path) -> const ObjectMotion& {
        const Hit& hit = hits(path.x, path.y);
        return hit.instance == no_index ? all.background : all.objects[seen_.number(hit.instance)];
    };
    const auto chord_of = [&](const PixelPath& path) {
        const ObjectMotion& object = object_of(path);
        return find_chord(all, object, find_place(all, object, hits(path.x, path.y), path.x + 0.5, path.y + 0.5));
    };
    std::vector<PixelPath> paths;
    for (int y = 0; y < hits.height; ++y) {
        for (int x = 0; x < hits.width; ++x) {
            PixelPath path{x, y};
            const std::optional<Chord> chord = object_of(path).fast ? chord_of(path) : std::nullopt;
            if (!chord) continue;
            path.last = chord->start;
            field.path_length(x, y) = 0.0;
            paths.push_back(path);
        }
    }
    constexpr std::size_t paths_per_chunk = 1024;
    for (const double seconds : times) {  // outside, so that one pose lives at a time
        const ScenePose& posed = pose_between(seconds);
        all.step = make_camera_view(posed.cameras[now.camera], now.view.width, now.view.height);
        all.background.step =
            make_background_map(background_axes(now.view, now.pose), background_axes(all.step, posed));
        for (std::size_t i = 0; i < all.objects.size(); ++i) {
            all.objects[i].step = make_camera_from_object(all.step, posed.world[instance_of(i).node]);
            all.objects[i].shape_step = &posed.meshes[instance_of(i).mesh];
        }
        parallel_each(paths.size(), paths_per_chunk, [&](std::size_t i) {
            PixelPath& path = paths[i];
            extend_to_step(all, object_of(path), hits(path.x, path.y), path, field.path_length(path.x, path.y));
        });
    }
    parallel_each(paths.size(), paths_per_chunk, [&](std::size_t i) {
        extend(paths[i], chord_of(paths[i])->end, all.diagonal, field.path_length(paths[i].x, paths[i].y));
    });
}

MotionField ModelMotion::compute(const PosedView& now, const PosedView& other, const Image<Hit>& hits,
                                 OtherFrame which) {
    ALEPH_CHECK(hits.width == now.view.width && hits.height == now.view.height,
                fmt::format("{}x{} hits, {}x{} view", hits.width, hits.height, now.view.width, now.view.height));
    if (which == OtherFrame::none) return make_motion_field(hits.width, hits.height, MotionValidity::no_counterpart);
    MotionField field = make_motion_field(hits.width, hits.height, MotionValidity::background);
    seen_.find(hits, now.pose.instances.size());
    PreparedMotion all = prepare_motion(scene_, now, other, which, seen_);
    constexpr int rows_per_chunk = 8;
    parallel_pixels(hits, rows_per_chunk, [&](int x, int y) {
        const Hit& hit = hits(x, y);
        const ObjectMotion& object =
            hit.instance == no_index ? all.background : all.objects[seen_.number(hit.instance)];
        const PixelMotion motion = compute_pixel_motion(all, object, hit, x + 0.5, y + 0.5);
        field.displacement(x, y) = motion.displacement;
        field.path_length(x, y) = motion.path_length;
        field.validity(x, y) = motion.validity;
    });
    sum_paths(all, now, other, hits, field);
    return field;
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
