#pragma once
// A camera with the size of its image: pixel to ray, and point to pixel. All in double.
// Pixels: x right, y down, pixel centres at +.5, row 0 on top.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "engine/pose/pose.h"

namespace aleph {

struct CameraView {
    int width = 0, height = 0;  ///< pixels
    bool orthographic = false;
    glm::dvec3 position{0.0};      ///< world, m
    glm::dmat3 axes{1.0};          ///< columns right, up, back
    double pixels_per_unit = 1.0;  ///< perspective: focal length in pixels; orthographic: pixels per metre
    double near_plane = 1e-4;      ///< m
    /// Pixels, x right and y down: where the optical axis meets the picture, from its middle (film offset).
    glm::dvec2 axis_offset{0.0};
};

/// @throws InputError where the field of view or half height is not positive and finite, the film offset is not finite,
/// or the size is not positive
CameraView make_camera_view(const CameraValues& camera, int width, int height);
/// The same, where the error names the scene's file and the camera.
CameraView make_camera_view(const Scene& scene, const CameraValues& camera, int width, int height);

/// A point in the camera's own axes: x right, y up, z back (negative in front). The difference is taken first, so
/// it stays exact far from the origin.
inline glm::dvec3 to_camera(const CameraView& view, const glm::dvec3& world) {
    return (world - view.position) * view.axes;  // row vector times columns: transpose(axes) * difference
}

/// Pixel position of a point in camera axes. Valid only where -z > near_plane; finite wherever z != 0.
inline glm::dvec2 project_camera_point(const CameraView& view, const glm::dvec3& p) {
    const double scale = view.orthographic ? view.pixels_per_unit : view.pixels_per_unit / -p.z;
    return {0.5 * view.width + view.axis_offset.x + p.x * scale, 0.5 * view.height + view.axis_offset.y - p.y * scale};
}

/// Pixel position of a sphere's centre (world, m); nothing where it is not before the camera, or the sphere is larger.
inline std::optional<glm::dvec2> project_small_sphere(const CameraView& view, const glm::dvec3& center, double radius,
                                                      double most_pixels) {
    const glm::dvec3 p = to_camera(view, center);
    if (!(-p.z > view.near_plane)) return std::nullopt;
    const double scale = view.orthographic ? view.pixels_per_unit : view.pixels_per_unit / -p.z;
    return radius * scale <= most_pixels ? std::optional(project_camera_point(view, p)) : std::nullopt;
}

/// Where a pixel position lies on the plane z = -1 (perspective) or z = 0, m (orthographic), in camera axes.
inline glm::dvec2 unproject_pixel(const CameraView& view, double x, double y) {
    return {(x - (0.5 * view.width + view.axis_offset.x)) / view.pixels_per_unit,
            (0.5 * view.height + view.axis_offset.y - y) / view.pixels_per_unit};
}

/// Start (world, m) and direction (unit, world) of the ray through a pixel position. Orthographic rays start on the
/// camera's plane.
struct CameraRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
    /// m, Ray::near: some roundings of a position. A surface through the camera is not met; else half of the rays,
    /// at random, would meet it at distance 0.
    float near = 0.0f;
    float choice = -1.0f;  ///< Ray::choice
};
CameraRay make_camera_ray(const CameraView& view, double x, double y);

/// Origin of the coordinates in which rays are traced, m: the camera's position rounded to a coarse grid, finer for a
/// near plane below 1e-4 m. Depends on the camera alone.
glm::dvec3 compute_anchor(const CameraView& view);

}  // namespace aleph
