#include "render/surface/environment_cells.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/color.h"

namespace aleph {

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double margin = 1.0 / 256.0;  // cells around a part: look-ups round to single precision

}  // namespace

CellRange EnvironmentCells::cells_of(int part) const {
    const glm::ivec2 first = step_ * glm::ivec2(part % columns_, part / columns_);
    const glm::ivec2 most(map_->texels.width - 1, map_->texels.height);
    return {first, glm::min(first + step_ - 1, most)};
}

LuminanceRange EnvironmentCells::find_range(int part) const {
    const Image<Rgb>& texels = map_->texels;
    const CellRange cells = cells_of(part);
    LuminanceRange range{std::numeric_limits<float>::infinity(), 0.0f};
    for (int y = std::max(0, cells.first.y - 1); y <= std::min(cells.last.y, texels.height - 1); ++y) {
        for (int x = cells.first.x; x <= cells.last.x + 1; ++x) {
            const float value = luminance(texels(x % texels.width, y));
            range = {std::min(range.least, value), std::max(range.most, value)};
        }
    }
    return range;
}

std::array<glm::dvec3, 4> EnvironmentCells::surround(int part) const {
    const double width = map_->texels.width, height = map_->texels.height;
    const CellRange cells = cells_of(part);
    const auto polar = [&](double row) { return half_turn * std::clamp((row - 0.5) / height, 0.0, 1.0); };
    const auto azimuth = [&](double column) { return half_turn * (2.0 * (column + 0.5) / width - 1.0); };
    const double top = polar(cells.first.y - margin), bottom = polar(cells.last.y + 1 + margin);
    const double left = azimuth(cells.first.x - margin), right = azimuth(cells.last.x + 1 + margin);
    // A great circle through two places of one latitude lies nearer to the pole between them. Where that is towards
    // the part, it touches the latitude between them instead.
    const double wider = 1.0 / std::cos(0.5 * (right - left));
    const double top_radius = std::sin(top) * (top > 0.5 * half_turn ? wider : 1.0);
    const double bottom_radius = std::sin(bottom) * (bottom < 0.5 * half_turn ? wider : 1.0);
    const auto corner = [](double angle, double y, double radius) {
        return glm::dvec3(radius * std::sin(angle), y, -radius * std::cos(angle));
    };
    return {corner(left, std::cos(top), top_radius), corner(right, std::cos(top), top_radius),
            corner(right, std::cos(bottom), bottom_radius), corner(left, std::cos(bottom), bottom_radius)};
}

CellRange EnvironmentCells::find_in_cone(const glm::dvec3& axis, double angle) const {
    const int width = map_->texels.width, height = map_->texels.height;
    const double radius = std::hypot(axis.x, axis.z), polar = std::atan2(radius, axis.y);
    const auto row = [&](double at) {
        return static_cast<int>(std::clamp(std::floor(at / half_turn * height + 0.5), 0.0, 1.0 * height));
    };
    CellRange cells{{0, row(polar - angle)}, {width - 1, row(polar + angle)}};
    if (!(std::sin(angle) < radius) || angle > 0.5 * half_turn) return cells;  // it meets a pole
    const double middle = std::atan2(axis.x, -axis.z), side = std::asin(std::sin(angle) / radius);
    const auto column = [&](double at) {
        return static_cast<int>(std::floor((0.5 + at / (2.0 * half_turn)) * width - 0.5));
    };
    const int first = column(middle - side), last = column(middle + side);
    if (last - first + step_ < width) {
        cells.first.x = first;
        cells.last.x = last;
    }
    return cells;
}

}  // namespace aleph
