#include "engine/cage_level.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <utility>

#include "engine/cage_validate.h"
#include "engine/camera_view.h"
#include "engine/pose.h"
#include "engine/pose_parts.h"
#include "engine/subdivide.h"

namespace aleph {

namespace {

int highest_level(const Cage& cage) {
    return std::clamp(cage.max_level, 0, max_subdivision_level);
}

double distance_to_segment(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? std::clamp(-glm::dot(a, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(a + t * along);
}

/// Of the origin to a triangle.
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

/// Longest edge of the cage's faces in view, pixels; 0 where none is in view.
double longest_edge(const Cage& cage, const std::vector<glm::dvec3>& points, const CameraView& view) {
    double longest = 0.0;
    std::size_t begin = 0;
    for (const int size : cage.face_sizes) {
        const int* face = &cage.face_points[begin];
        begin += static_cast<std::size_t>(size);
        const auto point = [&](int k) -> const glm::dvec3& { return points[static_cast<std::size_t>(face[k % size])]; };
        unsigned outside = ~0u;
        for (int k = 0; k < size; ++k) outside &= beyond(view, point(k));
        if (outside != 0) continue;
        double edge = 0.0, nearest = std::numeric_limits<double>::infinity();
        glm::dvec3 centre(0.0);
        for (int k = 0; k < size; ++k) centre += point(k) / static_cast<double>(size);
        for (int k = 0; k < size; ++k) {
            edge = std::max(edge, glm::length(point(k + 1) - point(k)));
            // Other polygons fall into quads about their centres, with half as many segments.
            if (size > 4) edge = std::max(edge, 2.0 * glm::length(point(k) - centre));
            nearest = std::min(nearest, distance_to_triangle(point(k), point(k + 1), centre));
        }
        const double distance = view.orthographic ? 1.0 : std::max(nearest, view.near_plane);
        longest = std::max(longest, edge * view.pixels_per_unit / distance);
    }
    return longest;
}

/// Nodes and instances of the scene at a moment, without its deforming meshes.
SceneFrame place_nodes(const Scene& scene, double seconds, std::vector<Instance> instances) {
    SceneFrame frame;
    frame.seconds = seconds;
    frame.world.resize(scene.nodes.size());
    frame.visible.resize(scene.nodes.size());
    frame.instances = std::move(instances);
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        place_node(scene, static_cast<int>(node), seconds, frame);
    return frame;
}

int find_camera_node(const Scene& scene, int camera) {
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].camera != no_index && camera-- == 0) return static_cast<int>(node);
    }
    return no_index;
}

/// Longest edge of every cage over the frames.
std::vector<double> longest_edges(const Scene& scene, int camera_node, int width, int height, int samples) {
    std::vector<Instance> instances = list_instances(scene);
    std::erase_if(instances, [&](const Instance& instance) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        return mesh.cage == no_index || mesh.limit.surface == nullptr;
    });
    std::vector<double> longest(scene.cages.size(), 0.0);
    const FrameRange range = frame_range(scene);
    const std::int64_t steps = std::min<std::int64_t>(samples - 1, range.last - range.first);
    for (std::int64_t step = 0; step <= steps; ++step) {
        const std::int64_t frame_number =
            steps == 0
                ? range.first
                : range.first +
                      static_cast<std::int64_t>(std::llround(static_cast<double>(range.last - range.first) *
                                                             static_cast<double>(step) / static_cast<double>(steps)));
        const double seconds = scene.frame_rate.seconds_of(frame_number);
        const SceneFrame frame = place_nodes(scene, seconds, instances);
        const CameraView view = make_camera_view(
            pose_camera(scene, camera_node, frame.world[static_cast<std::size_t>(camera_node)], seconds), width,
            height);
        std::set<std::pair<int, int>> done;  // parts of a cage stand under one node
        for (std::size_t i = 0; i < instances.size(); ++i) {
            const int cage_index = scene.meshes[static_cast<std::size_t>(instances[i].mesh)].cage;
            if (!is_shown(scene, frame, i) || !done.insert({instances[i].node, cage_index}).second) continue;
            const Cage& cage = scene.cages[static_cast<std::size_t>(cage_index)];
            std::vector<glm::dvec3> points = cage_points_at(scene, cage, seconds);
            const glm::dmat4& world = frame.world[static_cast<std::size_t>(instances[i].node)];
            for (glm::dvec3& p : points) p = to_camera(view, glm::dvec3(world * glm::dvec4(p, 1.0)));
            double& edge = longest[static_cast<std::size_t>(cage_index)];
            edge = std::max(edge, longest_edge(cage, points, view));
        }
    }
    return longest;
}

std::size_t count_triangles(const Cage& cage, int level) {
    std::size_t pieces = 0;  // triangles at level 0 were every face a quad or a Loop triangle
    for (const int size : cage.face_sizes) {
        pieces += cage.scheme == Cage::Scheme::loop ? 2u : size == 4 ? 4u : static_cast<std::size_t>(size);
    }
    return pieces * (std::size_t{1} << (2 * level)) / 2;
}

}  // namespace

std::vector<int> choose_cage_levels(const Scene& scene, int camera, int width, int height,
                                    const CageLevelSettings& settings) {
    std::vector<int> levels;
    for (const Cage& cage : scene.cages) levels.push_back(std::min(cage.level, highest_level(cage)));
    const int camera_node = find_camera_node(scene, camera);
    if (levels.empty() || camera_node == no_index) return levels;

    const std::vector<double> edges = longest_edges(scene, camera_node, width, height, settings.samples);
    for (std::size_t c = 0; c < levels.size(); ++c) {
        if (!(edges[c] > 0.0)) continue;
        const double level = std::ceil(std::log2(edges[c] / settings.edge_pixels));
        levels[c] = static_cast<int>(std::clamp(level, 0.0, static_cast<double>(highest_level(scene.cages[c]))));
    }
    for (;;) {
        std::size_t total = 0, most = 0, largest = levels.size();
        for (std::size_t c = 0; c < levels.size(); ++c) {
            const std::size_t count = count_triangles(scene.cages[c], levels[c]);
            total += count;
            if (levels[c] > 0 && count > most) {
                most = count;
                largest = c;
            }
        }
        if (total <= settings.max_triangles || largest == levels.size()) return levels;
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
