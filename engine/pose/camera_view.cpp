#include "engine/pose/camera_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr double usual_near = 1e-4;  // m, CameraView::near_plane if a scene gives none

}  // namespace

CameraView make_camera_view(const CameraValues& camera, int width, int height) {
    if (width <= 0 || height <= 0)
        throw InputError("", "size", fmt::format("{} x {} pixels; both must be positive", width, height));
    // Scales of nodes multiply: of 1e18 each, a few lead beyond what Embree takes.
    constexpr double farthest = 1e18;  // m
    const glm::dvec3& p = camera.position;
    if (!(std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest))
        throw InputError("", "camera",
                         fmt::format("it is at ({:g}, {:g}, {:g}); it must be within {:g} m", p.x, p.y, p.z, farthest));
    CameraView view{.width = width,
                    .height = height,
                    .orthographic = camera.orthographic,
                    .position = camera.position,
                    .axes = camera.axes,
                    .near_plane = camera.near_plane};
    if (camera.orthographic) {
        view.pixels_per_unit = 0.5 * height / camera.half_height;
        if (!(camera.half_height > 0.0 && std::isfinite(view.pixels_per_unit) && view.pixels_per_unit > 0.0))
            throw InputError(
                "", "camera",
                fmt::format("half its height is {} m; it must be positive and finite", camera.half_height));
    } else {
        view.pixels_per_unit = 0.5 * height / std::tan(0.5 * camera.fov);
        if (!(camera.fov > 0.0 && camera.fov < std::numbers::pi && std::isfinite(view.pixels_per_unit)))
            throw InputError("", "camera",
                             fmt::format("its field of view is {} degrees; it must lie between 0 and 180",
                                         camera.fov * 180.0 / std::numbers::pi));
    }
    // The view's centre moves right and up, so the axis moves left and down in the picture.
    view.axis_offset = {-camera.shift_x * height, camera.shift_y * height};
    if (!std::isfinite(view.axis_offset.x) || !std::isfinite(view.axis_offset.y))
        throw InputError("", "camera",
                         fmt::format("its film offset is ({}, {}) heights of the picture; it must be finite",
                                     camera.shift_x, camera.shift_y));
    return view;
}

CameraView make_camera_view(const Scene& scene, const CameraValues& camera, int width, int height) {
    try {
        return make_camera_view(camera, width, height);
    } catch (const InputError& e) {
        const Node& node = scene.nodes[camera.node];
        const std::string& own = scene.cameras[node.camera].name;
        throw InputError(scene.source.file,
                         fmt::format("{} \"{}\"", e.place(), printable(own.empty() ? node.name : own)), e.reason());
    }
}

CameraRay make_camera_ray(const CameraView& view, double x, double y) {
    const glm::dvec2 at = unproject_pixel(view, x, y);
    const auto near = static_cast<float>(0.05 * std::min(view.near_plane, usual_near));  // ten roundings or more
    if (view.orthographic) return {view.position + view.axes * glm::dvec3(at, 0.0), -view.axes[2], near};
    return {view.position, view.axes * safe_normalize(glm::dvec3(at, -1.0)), near};
}

glm::dvec3 compute_anchor(const CameraView& view) {
    // m: a float resolves .5 um near the camera, which rarely changes cell. What is nearer than usual is smaller.
    constexpr double usual_cell = 16.0, least_near = 1e-10;
    const double nearness = std::clamp(view.near_plane / usual_near, least_near / usual_near, 1.0);
    const double cell = std::scalbn(usual_cell, std::ilogb(nearness));
    const auto snap = [cell](double v) { return std::floor(v / cell + 0.5) * cell; };
    return {snap(view.position.x), snap(view.position.y), snap(view.position.z)};
}

}  // namespace aleph
