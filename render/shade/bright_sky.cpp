#include "render/shade/bright_sky.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr double contrast = 4.0;    // of what counts to what is around
constexpr double part_size = 0.25;  // pixels: of the parts where cells are much smaller
constexpr int least_parts = 8;      // along a latitude: EnvironmentCells::surround
constexpr int places_along = 8;     // of a filter, along x and y, that tell what is around
constexpr double share_around = 0.75;

class BrightSky {
  public:
    BrightSky(const ShadingScene& shading, const CameraView& view, PixelFilter filter, double exposure,
              const EnvironmentCells& cells)
        : shading_(shading),
          view_(view),
          radius_(place_in_filter(filter, 1.0)),
          white_(1.0 / exposure),
          cells_(cells),
          ranges_(*shading.environment.map, ranges_step),
          rotation_(shading.environment.rotation) {
        for (int i = 0; i < places_along; ++i) places_[i] = place_in_filter(filter, (i + 0.5) / places_along);
        const Rgb& factor = shading.environment.radiance;
        least_factor_ = double{std::min({factor.x, factor.y, factor.z})};
        most_factor_ = double{std::max({factor.x, factor.y, factor.z})};
    }

    void add_pixel(int x, int y, std::vector<BrightPiece>& out) const {
        const glm::dvec2 middle(x + 0.5, y + 0.5);
        const CellRange range = find_range(middle);
        if (!may_count(range)) return;
        const double limit = std::max(least_bright * white_, contrast * std::min(find_around(middle), white_));
        cells_.visit_parts(range, [&](int part) {
            if (double{cells_.find_range(part).most} * most_factor_ < limit) return;
            const PicturePolygon polygon =
                clip_to_rectangle(project_cells(view_, shading_, cells_, part), middle - radius_, middle + radius_);
            if (area_of(polygon) > 0.0 && find_brightest(polygon, part) >= limit)
                out.push_back({.x = x, .y = y, .primitive = part});
        });
    }

  private:
    /// The cells in a pixel's filter, and around it.
    CellRange find_range(const glm::dvec2& middle) const {
        const auto look = [&](double x, double y) {
            return make_camera_ray(view_, middle.x + x, middle.y + y).direction * rotation_;
        };
        const glm::dvec3 axis = look(0.0, 0.0);
        double chord = 0.0;
        for (const double x : {-radius_, radius_}) {
            for (const double y : {-radius_, radius_}) chord = std::max(chord, glm::distance(axis, look(x, y)));
        }
        return cells_.find_in_cone(axis, 2.0 * std::asin(0.5 * chord));
    }

    /// Returns false if they are known to be dark, even, or all shown white.
    bool may_count(const CellRange& range) const {
        LuminanceRange all{std::numeric_limits<float>::infinity(), 0.0f};
        ranges_.visit_parts(range, [&](int part) {
            const LuminanceRange& of_part = shading_.environment.map->ranges[part];
            all = {std::min(all.least, of_part.least), std::max(all.most, of_part.most)};
        });
        const double least = double{all.least} * least_factor_;
        return least < white_ && double{all.most} * most_factor_ >= std::max(least_bright * white_, contrast * least);
    }

    double look_at(const glm::dvec2& place) const {
        const CameraRay ray = make_camera_ray(view_, place.x, place.y);
        return double{luminance(environment_radiance(shading_, glm::vec3(ray.direction)))};
    }

    /// Three quarters of the filter are no brighter.
    double find_around(const glm::dvec2& middle) const {
        std::array<double, places_along * places_along> seen;
        for (std::size_t i = 0; i < seen.size(); ++i)
            seen[i] = look_at(middle + glm::dvec2(places_[i % places_along], places_[i / places_along]));
        const auto at = seen.begin() + static_cast<std::ptrdiff_t>(share_around * seen.size());
        std::ranges::nth_element(seen, at);
        return *at;
    }

    /// Within a single cell that is larger than the filter: at the corners of what the filter shows of it.
    double find_brightest(const PicturePolygon& polygon, int part) const {
        if (cells_.step() > 1) return double{cells_.find_range(part).most} * most_factor_;
        double most = 0.0;
        for (int i = 0; i < polygon.count; ++i) most = std::max(most, look_at(polygon.corners[i]));
        return most;
    }

    const ShadingScene& shading_;
    const CameraView& view_;
    double radius_, white_, least_factor_ = 0.0, most_factor_ = 0.0;
    const EnvironmentCells& cells_;
    const EnvironmentCells ranges_;  ///< EnvironmentMap::ranges
    glm::dmat3 rotation_;
    std::array<double, places_along> places_;
};

}  // namespace

PicturePolygon project_cells(const CameraView& view, const ShadingScene& shading, const EnvironmentCells& cells,
                             int part) {
    const glm::dmat3 rotation(shading.environment.rotation);
    std::array<glm::dvec3, 4> corners = cells.surround(part);
    for (glm::dvec3& corner : corners) corner = rotation * corner;
    return project_directions(view, corners);
}

void add_bright_sky(const ShadingScene& shading, const CameraView& view, PixelFilter filter, double exposure,
                    BrightEdges& edges) {
    const EnvironmentMap* map = shading.environment.map;
    if (map == nullptr || view.orthographic) return;
    const double cell = std::numbers::pi / map->texels.height * view.pixels_per_unit;  // pixels
    const auto wanted = static_cast<unsigned>(std::clamp(part_size / cell, 1.0, 1024.0));
    const int step = static_cast<int>(std::bit_floor(wanted));
    if (map->texels.width < least_parts * step) return;
    edges.cells.emplace(*map, step);
    const BrightSky sky(shading, view, filter, exposure, *edges.cells);
    std::vector<std::vector<BrightPiece>> rows(static_cast<std::size_t>(view.height));
    parallel_each(rows.size(), 4, [&](std::size_t y) {
        for (int x = 0; x < view.width; ++x) sky.add_pixel(x, static_cast<int>(y), rows[y]);
    });
    for (const std::vector<BrightPiece>& row : rows) edges.pieces.insert(edges.pieces.end(), row.begin(), row.end());
}

}  // namespace aleph
