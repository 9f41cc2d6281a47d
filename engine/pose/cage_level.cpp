#include "engine/pose/cage_level.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numeric>

#include "engine/base/parallel.h"
#include "engine/pose/camera_view.h"
#include "engine/pose/closest_pass.h"
#include "engine/pose/parts.h"
#include "engine/pose/pose.h"
#include "engine/scene/points.h"
#include "engine/surface/cage_checks.h"
#include "engine/surface/limit_surface.h"

namespace aleph {

namespace {

// A triangle is fine enough where one of the two holds: none of its edges is longer, or the limit surface is no farther
// from its edges.
constexpr double edge_pixels = 4.0, bend_pixels = 0.1;
constexpr int examined_frames = 33;  // spread evenly over the range with both its ends

int highest_level(const Cage& cage) {
    return std::clamp(cage.max_level, 0, max_subdivision_level);
}

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? std::clamp(-glm::dot(a, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(a + t * along);
}

/// The distance of the origin to a triangle.
double distance_to_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double square = glm::dot(n, n);
    if (square > 0.0) {
        const glm::dvec3 foot = n * (glm::dot(a, n) / square);
        const bool inside = glm::dot(glm::cross(b - a, foot - a), n) >= 0.0 &&
                            glm::dot(glm::cross(c - b, foot - b), n) >= 0.0 &&
                            glm::dot(glm::cross(a - c, foot - c), n) >= 0.0;
        if (inside) return glm::length(foot);
    }
    return std::min({distance_to_segment(a, b), distance_to_segment(b, c), distance_to_segment(c, a)});
}

/// Sides of the picture (and the camera's plane) beyond which a point in camera axes lies, as bits.
unsigned beyond(const CameraView& view, const glm::dvec3& p) {
    const glm::dvec2 low = unproject_pixel(view, 0.0, view.height), high = unproject_pixel(view, view.width, 0.0);
    const double depth = view.orthographic ? 1.0 : -p.z;
    return (p.x < low.x * depth ? 1u : 0u) | (p.x > high.x * depth ? 2u : 0u) | (p.y < low.y * depth ? 4u : 0u) |
           (p.y > high.y * depth ? 8u : 0u) | (-p.z < view.near_plane ? 16u : 0u);
}

// How bends shrink is known from this level on; coarser cages are measured at it.
constexpr int lowest_measured_level = 2;

/// A part of a cage's surface at a time, by triangles.
struct SurfaceShape {
    std::shared_ptr<const LimitSurface> surface;
    std::vector<glm::uvec3> triangles;
    std::vector<glm::dvec3> positions;  ///< object space, m
    std::vector<double> bends;          ///< by triangle: how far the limit surface lies from its edges, m
};

/// Largest distance of the limit surface from the straight edges of a triangle, from two places on each.
double measure_bend(const LimitSurface& surface, int part, const std::vector<glm::dvec3>& control,
                    const std::vector<glm::dvec3>& positions, const glm::uvec3& corners, int triangle) {
    constexpr glm::dvec2 places[3] = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
    double bend = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const glm::dvec3 from = positions[corners[k]], along = positions[corners[next]] - from;
        const double square = glm::dot(along, along);
        if (!(square > 0.0)) continue;
        for (const double share : {1.0 / 3.0, 2.0 / 3.0}) {
            const glm::dvec2 place = (1.0 - share) * places[k] + share * places[next];
            const glm::dvec3 off = surface.evaluate(part, control, triangle, place.x, place.y) - from;
            bend = std::max(bend, glm::length(off - along * (glm::dot(off, along) / square)));
        }
    }
    return 9.0 / 8.0 * bend;  // an arc's height at a third of its chord, to that at its half
}

/// Fills what depends on time.
void place_shape(SurfaceShape& shape, const Scene& scene, const Mesh& mesh, double seconds) {
    const Cage& cage = scene.cages[mesh.subdivision.cage];
    const auto control = shape.surface->make_control_points(sample_points(scene.point_caches[cage.points], seconds));
    std::vector<glm::vec3> normals;
    shape.surface->evaluate_vertices(mesh.subdivision.part, control, shape.positions, normals);
    shape.bends.resize(shape.triangles.size());
    constexpr std::size_t triangles_per_chunk = 1024;
    parallel_each(shape.bends.size(), triangles_per_chunk, [&](std::size_t i) {
        shape.bends[i] = measure_bend(*shape.surface, mesh.subdivision.part, control, shape.positions,
                                      shape.triangles[i], static_cast<int>(i));
    });
}

/// The level that a shape needs, a fraction; -infinity where nothing of it is in view.
double find_level_needed(const SurfaceShape& shape, const glm::dmat4& world, const CameraView& view) {
    std::vector<glm::dvec3> points;
    points.reserve(shape.positions.size());
    for (const glm::dvec3& p : shape.positions) {
        points.push_back(to_camera(view, glm::dvec3(world * glm::dvec4(p, 1.0))));
    }
    const double scale = std::max(
        {glm::length(glm::dvec3(world[0])), glm::length(glm::dvec3(world[1])), glm::length(glm::dvec3(world[2]))});
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
        const glm::uvec3& t = shape.triangles[i];
        const glm::dvec3 &a = points[t.x], &b = points[t.y], &c = points[t.z];
        if ((beyond(view, a) & beyond(view, b) & beyond(view, c)) != 0) continue;
        const double edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        const double distance = view.orthographic ? 1.0 : std::max(distance_to_triangle(a, b, c), view.near_plane);
        const double pixels = view.pixels_per_unit / distance;
        // Each level halves edges and quarters bends.
        const double by_edge = std::log2(std::max(edge * pixels / edge_pixels, 1e-9));
        const double by_bend = 0.5 * std::log2(std::max(shape.bends[i] * scale * pixels / bend_pixels, 1e-18));
        most = std::max(most, std::min(by_edge, by_bend));
    }
    return shape.surface->level() + most;
}

/// Shapes of meshes; those of deforming cages are updated for every time.
class Shapes {
  public:
    explicit Shapes(const Scene& scene)
        : scene_(scene), probes_(scene.cages.size()), shapes_(scene.meshes.size()), seconds_(scene.meshes.size()) {}

    const SurfaceShape& at(int mesh_index, double seconds) {
        const auto m = static_cast<std::size_t>(mesh_index);
        const Mesh& mesh = scene_.meshes[m];
        const Cage& cage = scene_.cages[mesh.subdivision.cage];
        const PointCache& cache = scene_.point_caches[cage.points];
        SurfaceShape& shape = shapes_[m];
        const bool is_new = shape.surface == nullptr;
        if (is_new) choose_surface(shape, mesh, cage, cache.point_count());
        if (is_new || (cache.positions.size() > 1 && seconds_[m] != seconds)) {
            place_shape(shape, scene_, mesh, seconds);
            seconds_[m] = seconds;
        }
        return shape;
    }

  private:
    void choose_surface(SurfaceShape& shape, const Mesh& mesh, const Cage& cage, std::size_t points) {
        shape.surface = mesh.subdivision.limit.surface;
        shape.triangles = mesh.triangles;
        if (shape.surface->level() >= lowest_measured_level) return;
        auto& probe = probes_[mesh.subdivision.cage];
        if (probe == nullptr) probe = std::make_shared<const LimitSurface>(cage, points, lowest_measured_level);
        shape.surface = probe;
        shape.triangles = probe->triangles(mesh.subdivision.part);
    }

    const Scene& scene_;
    std::vector<std::shared_ptr<const LimitSurface>> probes_;  ///< by cage
    std::vector<SurfaceShape> shapes_;                         ///< by mesh
    std::vector<double> seconds_;
};

/// Evenly over the range, first and last included.
std::vector<std::int64_t> sample_frames(const FrameRange& range) {
    const std::int64_t steps = std::min<std::int64_t>(examined_frames - 1, range.last - range.first);
    std::vector<std::int64_t> frames{range.first};
    for (std::int64_t step = 1; step <= steps; ++step) {
        const double share = static_cast<double>(step) / static_cast<double>(steps);
        frames.push_back(range.first + std::llround(static_cast<double>(range.last - range.first) * share));
    }
    return frames;
}

/// By cage: the level that its triangles need over the sampled frames, and at the frame at which each instance comes
/// closest; -infinity where it is never in view.
std::vector<double> find_levels_needed(const Scene& scene, int camera_node, int width, int height) {
    std::vector<Instance> instances = list_instances(scene);
    std::erase_if(instances, [&](const Instance& instance) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        return mesh.subdivision.cage == no_index || mesh.subdivision.limit.surface == nullptr || mesh.triangles.empty();
    });
    std::vector<double> most(scene.cages.size(), -std::numeric_limits<double>::infinity());
    std::map<std::int64_t, std::vector<std::size_t>> looks;  // instances by frame
    for (const std::int64_t frame : sample_frames(frame_range(scene))) {
        looks[frame].resize(instances.size());
        std::iota(looks[frame].begin(), looks[frame].end(), std::size_t{0});
    }
    const auto passes = find_closest_passes(scene, camera_node, instances, width, height);
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (passes[i]) looks[*passes[i]].push_back(i);
    Shapes shapes(scene);
    for (const auto& [frame, which] : looks) {
        const double seconds = scene.film.frame_rate.seconds_of(frame);
        ScenePose posed = place_nodes(scene, seconds);
        posed.instances = instances;
        const CameraView view =
            make_camera_view(scene, pose_camera(scene, camera_node, posed.world[camera_node], seconds), width, height);
        for (const std::size_t i : which) {
            if (!is_shown(scene, posed, i)) continue;
            const Mesh& mesh = scene.meshes[instances[i].mesh];
            double& needed = most[mesh.subdivision.cage];
            needed = std::max(
                needed, find_level_needed(shapes.at(instances[i].mesh, seconds), posed.world[instances[i].node], view));
        }
    }
    return most;
}

}  // namespace

std::vector<int> choose_cage_levels(const Scene& scene, int camera, int width, int height, std::size_t max_triangles) {
    std::vector<int> levels;
    for (const Cage& cage : scene.cages) levels.push_back(std::min(cage.level, highest_level(cage)));
    const int camera_node = find_camera_node(scene, camera);
    if (levels.empty() || camera_node == no_index) return levels;

    const std::vector<double> needed = find_levels_needed(scene, camera_node, width, height);
    for (std::size_t c = 0; c < levels.size(); ++c) {
        const auto highest = static_cast<double>(highest_level(scene.cages[c]));
        levels[c] = static_cast<int>(std::clamp(std::ceil(needed[c]), static_cast<double>(levels[c]), highest));
    }
    for (;;) {
        std::size_t total = 0, most = 0, largest = levels.size();
        for (std::size_t c = 0; c < levels.size(); ++c) {
            const std::size_t count = count_triangles(scene.cages[c], levels[c]);
            total += count;
            if (levels[c] > scene.cages[c].level && count > most) {
                most = count;
                largest = c;
            }
        }
        if (total <= max_triangles || largest == levels.size()) return levels;
        --levels[largest];
    }
}

std::unique_ptr<Scene> make_scene_at_levels(const Scene& scene, std::span<const int> levels) {
    std::unique_ptr<Scene> copy;
    for (std::size_t c = 0; c < scene.cages.size(); ++c) {
        const int level = std::min(levels[c], highest_level(scene.cages[c]));
        if (level == scene.cages[c].level) continue;
        if (copy == nullptr) copy = std::make_unique<Scene>(scene);
        copy->cages[c].level = level;
        tessellate_cage(*copy, static_cast<int>(c));
    }
    return copy;
}

}  // namespace aleph
