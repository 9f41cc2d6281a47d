#include "render/frame/camera_blur.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aleph {

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

}  // namespace aleph
