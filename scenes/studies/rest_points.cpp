#include "scenes/studies/rest_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "engine/base/parallel.h"
#include "scenes/studies/reference_light.h"

namespace aleph {

namespace {

constexpr std::uint32_t probe_seed_mask = 0x70726f62u;
constexpr int probe_strata = 256;
constexpr double max_true_change = 0.01;  // thresholds
constexpr float min_reflected = 1e-3f;    // of a channel, to divide by it
constexpr float min_cosine = 0.95f;       // between normals of target pixels

bool reflects_enough(const Rgb& reflected) {
    return std::min({reflected.x, reflected.y, reflected.z}) > min_reflected;
}

/// The pixels around a position in the next frame, if all with a weight show the same surface.
bool find_targets(const StudyFrame& next, const PixelSurface& seen, const SurfacePoint& point, const glm::dvec2& at,
                  RestPoint& out) {
    const CameraView& view = next.posed.view;
    const double left = std::floor(at.x - 0.5), top = std::floor(at.y - 0.5);
    const double across = at.x - 0.5 - left, down = at.y - 0.5 - top;
    for (std::size_t i = 0; i < 4; ++i) {
        const bool right = i % 2 == 1, low = i / 2 == 1;
        out.weights[i] = static_cast<float>((right ? across : 1.0 - across) * (low ? down : 1.0 - down));
        if (out.weights[i] == 0.0f) continue;
        const int x = static_cast<int>(left) + right, y = static_cast<int>(top) + low;
        if (x < 0 || y < 0 || x >= view.width || y >= view.height) return false;
        if (next.centers.hits(x, y).instance != seen.hit.instance) return false;
        const PixelSurface there = surface_at(next, x, y);
        const glm::vec3 offset = there.point.position - point.position;
        if (glm::dot(there.point.normal, point.normal) < min_cosine) return false;
        if (std::abs(glm::dot(offset, point.geometric)) > there.footprint) return false;
        if (!reflects_enough(reflect_unit_irradiance(there))) return false;
        out.targets[i] = next.centers.hits.index(x, y);
    }
    return true;
}

Rgb probe(const StudyFrame& frame, const SurfacePoint& point, const RandomKey& key) {
    thread_local GatherScratch scratch;
    RayTask task(frame.rays);
    return gather_irradiance(frame.lighting(), task, point, choose_strata(probe_strata), key, scratch).irradiance;
}

std::optional<RestPoint> find_rest_point(const StudyFrame& now, const StudyFrame& next, std::uint32_t seed,
                                         const Image<float>& threshold, int x, int y) {
    const Hit& hit = now.centers.hits(x, y);
    if (hit.instance == no_index) return std::nullopt;
    if (std::ranges::find(now.plan.instances, hit.instance) != now.plan.instances.end()) return std::nullopt;
    const PixelSurface surface = surface_at(now, x, y);
    RestPoint out;
    out.reflected = reflect_unit_irradiance(surface);
    if (!reflects_enough(out.reflected)) return std::nullopt;
    out.pixel = now.centers.hits.index(x, y);
    out.threshold = threshold(x, y);

    const glm::dvec3 world = glm::dvec3(surface.point.position) + now.shading.anchor;
    const CameraView &view = now.posed.view, &next_view = next.posed.view;
    const glm::dvec3 here = to_camera(view, world), there = to_camera(next_view, world);
    if (-there.z <= next_view.near_plane) return std::nullopt;
    const glm::dvec2 moved = project_camera_point(next_view, there) - project_camera_point(view, here);
    const SurfacePoint point = make_surface_point(next.shading, hit, glm::vec3(world - next_view.position));
    if (point.front != surface.point.front) return std::nullopt;
    if (!find_targets(next, surface, point, glm::dvec2(x + 0.5, y + 0.5) + moved, out)) return std::nullopt;

    const RandomKey key{seed ^ probe_seed_mask, 0, surface.pixel, 0};
    const Rgb change = probe(next, point, key) - probe(now, surface.point, key);
    if (std::abs(now.display_luminance(out.reflected * change)) > max_true_change * out.threshold) return std::nullopt;
    return out;
}

}  // namespace

std::vector<RestPoint> find_rest_points(const StudyFrame& now, const StudyFrame& next, const RenderSettings& settings,
                                        const Image<float>& threshold, int block) {
    const PixelGrid grid{block};
    const int columns = grid.count(settings.width), rows = grid.count(settings.height);
    std::vector<std::vector<RestPoint>> found(static_cast<std::size_t>(rows));
    parallel_rows(rows, 1, [&](int row, int) {
        for (int column = 0; column < columns; ++column) {
            const glm::ivec2 at = grid.pixel(column, row, settings.width, settings.height);
            if (const auto point = find_rest_point(now, next, settings.seed, threshold, at.x, at.y))
                found[static_cast<std::size_t>(row)].push_back(*point);
        }
    });
    std::vector<RestPoint> all;
    for (const auto& row : found) all.insert(all.end(), row.begin(), row.end());
    return all;
}

Image<Rgb> find_irradiance(const StudyFrame& frame, const Image<Rgb>& indirect) {
    Image<Rgb> irradiance(indirect.width, indirect.height, Rgb(-1.0f));
    parallel_rows(indirect.height, 1, [&](int y, int) {
        for (int x = 0; x < indirect.width; ++x) {
            if (frame.centers.hits(x, y).instance == no_index) continue;
            const Rgb reflected = reflect_unit_irradiance(surface_at(frame, x, y));
            if (reflects_enough(reflected)) irradiance(x, y) = indirect(x, y) / reflected;
        }
    });
    return irradiance;
}

std::vector<double> measure_flicker(const StudyFrame& now, const std::vector<RestPoint>& points,
                                    const Image<Rgb>& irradiance_now, const Image<Rgb>& irradiance_next) {
    std::vector<double> changes;
    for (const RestPoint& point : points) {
        Rgb change = -irradiance_now.pixels[point.pixel];
        for (std::size_t i = 0; i < 4; ++i) {
            if (point.weights[i] > 0.0f) change += irradiance_next.pixels[point.targets[i]] * point.weights[i];
        }
        // The exposure is in the pictures already.
        const double luminance_change = luminance(point.reflected * change) * now.scene.viewing.display_white;
        changes.push_back(std::abs(luminance_change) / point.threshold);
    }
    std::ranges::sort(changes);
    return changes;
}

}  // namespace aleph
