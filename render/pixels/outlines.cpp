#include "render/pixels/outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr double least_step = 0.5;        // pixels, from a plane
constexpr double different_motion = 0.5;  // pixels per frame
constexpr float least_contrast = 0.5f;    // of what is tolerated
constexpr float strong_contrast = 8.0f;   // likewise
constexpr double small_object = 1.5;      // pixels, largest radius

/// Returns whether three neighbours in a row do not lie on a plane.
bool bends(const CameraView& view, const Hit& before, const Hit& here, const Hit& after) {
    const double a = before.distance, b = here.distance, c = after.distance;
    const double bend = view.orthographic ? a - 2.0 * b + c : b / a - 2.0 + b / c;
    return std::abs(bend) * view.pixels_per_unit > least_step;
}

bool has_outline(const CameraView& view, const Image<Hit>& hits, int x, int y) {
    const int own = hits(x, y).instance;
    bool several = false;
    visit_around(hits, x, y, 1, [&](int nx, int ny) { several = several || hits(nx, ny).instance != own; });
    if (several) return true;
    if (own == no_index || x == 0 || y == 0 || x == hits.width - 1 || y == hits.height - 1) return false;
    constexpr std::array<std::array<int, 2>, 4> axes{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    return std::ranges::any_of(axes, [&](const auto& axis) {
        return bends(view, hits(x - axis[0], y - axis[1]), hits(x, y), hits(x + axis[0], y + axis[1]));
    });
}

bool moves_differently(const Image<glm::dvec2>& displacement, int x, int y) {
    if (displacement.empty()) return false;
    const glm::dvec2 own = displacement(x, y);
    bool differs = false;
    visit_around(displacement, x, y, 1, [&](int nx, int ny) {
        const glm::dvec2 other = displacement(nx, ny);
        differs = differs || std::hypot(other.x - own.x, other.y - own.y) > different_motion;
    });
    return differs;
}

struct SmallObject {
    glm::dvec2 place{0.0};  ///< pixels
    double nearest = 0.0;   ///< m, from the camera
};

/// An object that is small in the picture. Two of its vertices rule most others out.
std::optional<SmallObject> find_if_small(const CameraView& view, const ShadingScene& shading,
                                         const PosedInstance& instance) {
    if (!instance.visible || instance.mesh->positions.empty()) return std::nullopt;
    const auto vertices = static_cast<std::uint32_t>(instance.mesh->positions.size());
    const glm::vec3 first = instance.place(0), middle = instance.place(vertices / 2);
    const double extent = 0.5 * static_cast<double>(glm::length(middle - first));
    // The centre of a small object is at least half as far away as a vertex: twice its size there is enough.
    if (!project_small_sphere(view, shading.anchor + glm::dvec3(first), extent, 2.0 * small_object))
        return std::nullopt;
    const BoundingSphere sphere = find_bounds(instance).sphere;
    const glm::dvec3 center = shading.anchor + glm::dvec3(sphere.center);
    const std::optional<glm::dvec2> at = project_small_sphere(view, center, sphere.radius, small_object);
    if (!at) return std::nullopt;
    const glm::dvec3 p = to_camera(view, center);
    return SmallObject{*at, (view.orthographic ? -p.z : glm::length(p)) - sphere.radius};
}

}  // namespace

void mark_small_objects(Image<Outline>& outlines, const CameraView& view, const Image<Hit>& hits,
                        const ShadingScene& shading) {
    for (const PosedInstance& instance : shading.instances) {
        const std::optional<SmallObject> object = find_if_small(view, shading, instance);
        if (!object) continue;
        const glm::dvec2 at = object->place;
        if (!(at.x >= 0.0 && at.x < outlines.width && at.y >= 0.0 && at.y < outlines.height)) continue;
        const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
        bool hidden = true;
        visit_around(hits, x, y, 1, [&](int nx, int ny) {
            const Hit& hit = hits(nx, ny);
            hidden = hidden && hit.instance != no_index && hit.distance < object->nearest;
        });
        if (!hidden) visit_around(outlines, x, y, 1, [&](int nx, int ny) { outlines(nx, ny) = Outline::small; });
    }
}

Image<Outline> find_outlines(const CameraView& view, const Image<Hit>& hits, const MotionField& motion) {
    Image<Outline> outlines(hits.width, hits.height);
    parallel_pixels(hits, 16, [&](int x, int y) {
        if (has_outline(view, hits, x, y))
            outlines(x, y) = moves_differently(motion.displacement, x, y) ? Outline::moving : Outline::still;
    });
    return outlines;
}

void mark_contrasts(Image<Outline>& outlines, const Image<Rgb>& estimate, const Image<float>& threshold,
                    double tolerated) {
    const auto find_contrast = [&](int x, int y) {
        float low = luminance(estimate(x, y)), high = low;
        visit_around(estimate, x, y, 1, [&](int nx, int ny) {
            low = std::min(low, luminance(estimate(nx, ny)));
            high = std::max(high, luminance(estimate(nx, ny)));
        });
        return high - low;
    };
    parallel_pixels(outlines, 16, [&](int x, int y) {
        Outline& outline = outlines(x, y);
        if (outline != Outline::none && outline != Outline::still) return;
        const float contrast = find_contrast(x, y), unit = static_cast<float>(tolerated) * threshold(x, y);
        if (contrast > strong_contrast * unit) {
            outline = Outline::strong;
        } else if (contrast > least_contrast * unit) {
            outline = Outline::still;
        }
    });
}

}  // namespace aleph
