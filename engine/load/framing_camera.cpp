// A camera for a scene that has none.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/bounds.h"
#include "engine/load/warnings.h"
#include "engine/pose/pose.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr std::int64_t max_frames = 16;

/// Bounds of all visible meshes at up to max_frames frames, spread over the range, both ends included.
Bounds scene_bounds(const Scene& scene) {
    std::vector<Bounds> meshes(scene.meshes.size());
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        for (const glm::vec3& position : scene.meshes[i].positions) meshes[i].add(position);
    }
    Bounds bounds;
    const FrameRange range = frame_range(scene);
    const std::int64_t steps = std::min(max_frames, range.last - range.first + 1);
    for (std::int64_t step = 0; step < steps; ++step) {
        const std::int64_t frame =
            range.first + (steps == 1 ? 0
                                      : (range.last - range.first) / (steps - 1) * step +
                                            (range.last - range.first) % (steps - 1) * step / (steps - 1));
        const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
        for (std::size_t i = 0; i < now.instances.size(); ++i) {
            if (now.shown[i] == 0) continue;
            const int m = now.instances[i].mesh;
            const glm::dmat4& world = now.world[now.instances[i].node];
            if (now.meshes[m].positions.empty()) {
                if (!meshes[m].empty()) meshes[m].add_corners_to(bounds, world);
                continue;
            }
            Bounds deformed;
            for (const glm::dvec3& position : now.meshes[m].positions) deformed.add(position);
            deformed.add_corners_to(bounds, world);
        }
    }
    return bounds;
}

void shift(int& index) {
    if (index != no_index) ++index;
}

}  // namespace

void add_framing_camera(Scene& scene) {
    const Bounds bounds = scene_bounds(scene);
    const glm::dvec3 center = bounds.empty() ? glm::dvec3(0.0) : (bounds.low + bounds.high) * 0.5;
    const double extent = bounds.empty() ? 0.0 : 0.5 * glm::length(bounds.high - bounds.low);
    const double radius = extent > 0.0 && std::isfinite(extent) ? extent : 1.0;

    Camera camera;
    camera.name = "framing camera";
    const double fov = camera.fov.values.front();
    const double distance = 1.05 * radius / std::sin(0.5 * fov);
    camera.near_plane = std::min(camera.near_plane, 1e-3 * distance);
    camera.focus_distance = distance;

    Node node{.name = camera.name, .camera = 0};
    const glm::dvec3 eye = center + distance * safe_normalize(glm::dvec3(0.0, 0.3, 1.0));
    node.transform.translation = eye;
    node.transform.rotation =
        safe_normalize(glm::quat_cast(glm::dmat3(look_at(eye, center, glm::dvec3(0.0, 1.0, 0.0)))));

    for (Node& other : scene.nodes) {
        shift(other.parent);
        shift(other.camera);
    }
    for (Skin& skin : scene.skins) std::ranges::for_each(skin.joints, shift);
    for (Include& include : scene.source.includes) {
        shift(include.node);
        shift(include.content);
    }
    scene.nodes.insert(scene.nodes.begin(), std::move(node));
    scene.cameras.insert(scene.cameras.begin(), std::move(camera));
    scene.source.warnings.push_back(
        bounds.empty() ? "there is no camera and nothing to see: one was added that looks at the origin"
                       : fmt::format("there is no camera: one was added at {:.4g}, {:.4g}, {:.4g} that sees "
                                     "everything over the whole range",
                                     eye.x, eye.y, eye.z));
}

}  // namespace aleph
