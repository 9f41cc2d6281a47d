#include "render/surface/environment_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/parallel.h"
#include "engine/base/sampling.h"
#include "render/settings/numbers.h"
#include "render/surface/environment_cells.h"
#include "render/surface/texture_texels.h"

namespace aleph {

namespace {

/// In [0,1)^2, v downwards.
glm::vec2 to_uv(const glm::vec3& direction) {
    const float u = 0.5f + std::atan2(direction.x, -direction.z) / (2.0f * pi);
    // From both components: acos alone would lose the poles' digits.
    const float v = std::atan2(std::hypot(direction.x, direction.z), direction.y) / pi;
    return {std::clamp(u - std::floor(u), 0.0f, below_one), std::clamp(v, 0.0f, below_one)};
}

glm::vec3 to_direction(const glm::vec2& uv) {
    const float azimuth = (uv.x - 0.5f) * 2.0f * pi, polar = uv.y * pi;
    const float sine = std::sin(polar);
    return {sine * std::sin(azimuth), std::cos(polar), -sine * std::cos(azimuth)};
}

/// Channels that are NaN, infinite or negative become 0.
Rgb clean(Rgb value) {
    for (int c = 0; c < 3; ++c) {
        if (!(std::isfinite(value[c]) && value[c] >= 0.0f)) value[c] = 0.0f;
    }
    return value;
}

/// Mean luminance of the bilinear picture over a texel: the neighbours count by 1/8 along each axis.
double mean_luminance(const Image<Rgb>& texels, int x, int y) {
    constexpr double weights[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int j = -1; j <= 1; ++j) {
        const int row = std::clamp(y + j, 0, texels.height - 1);
        for (int i = -1; i <= 1; ++i) {
            const int column = (x + i + texels.width) % texels.width;
            sum += weights[j + 1] * weights[i + 1] * luminance(texels(column, row));
        }
    }
    return sum;
}

void build_distribution(EnvironmentMap& map) {
    const int width = map.texels.width, height = map.texels.height;
    std::vector<double> weights(map.texels.size()), row_sums(height, 0.0);
    double total = 0.0;
    for (int y = 0; y < height; ++y) {
        const double top = std::cos(std::numbers::pi * y / height);
        const double bottom = std::cos(std::numbers::pi * (y + 1) / height);
        for (int x = 0; x < width; ++x) {
            const double weight = mean_luminance(map.texels, x, y) * (top - bottom);
            weights[map.texels.index(x, y)] = weight;
            row_sums[y] += weight;
        }
        total += row_sums[y];
    }
    if (!(total > 0.0)) return;
    map.black = false;
    map.mean_luminance = total / (2.0 * width);  // weights are per column, of a height of 2 in all
    map.rows.resize(height);
    map.columns.resize(map.texels.size());
    map.probabilities.resize(map.texels.size());
    double row_end = 0.0;
    for (int y = 0; y < height; ++y) {
        row_end += row_sums[y];
        map.rows[y] = static_cast<float>(row_end / total);
        double end = 0.0;
        for (int x = 0; x < width; ++x) {
            const std::size_t i = map.texels.index(x, y);
            end += weights[i];
            map.columns[i] = row_sums[y] > 0.0 ? static_cast<float>(end / row_sums[y]) : 1.0f;
            map.probabilities[i] = static_cast<float>(weights[i] / total);
        }
        map.columns[map.texels.index(width - 1, y)] = 1.0f;
    }
    map.rows.back() = 1.0f;
}

/// Density of sample_environment within a texel, which is uniform per steradian.
float texel_density(const EnvironmentMap& map, int x, int y) {
    // cos(top) - cos(bottom), without cancellation at the poles: the angle is measured from the nearer one.
    const float half = 0.5f * pi / static_cast<float>(map.texels.height);
    const int from_pole = std::min(y, map.texels.height - 1 - y);
    const float height = 2.0f * std::sin(static_cast<float>(2 * from_pole + 1) * half) * std::sin(half);
    const float solid_angle = height * 2.0f * pi / static_cast<float>(map.texels.width);
    return map.probabilities[map.texels.index(x, y)] / solid_angle;
}

}  // namespace

int choose_part(std::span<const float> ends, float& u) {
    const auto found = std::upper_bound(ends.begin(), ends.end(), u);
    const int i = std::min(static_cast<int>(found - ends.begin()), static_cast<int>(ends.size()) - 1);
    const float low = i == 0 ? 0.0f : ends[i - 1];
    const float width = ends[i] - low;
    u = width > 0.0f ? std::clamp((u - low) / width, 0.0f, below_one) : 0.0f;
    return i;
}

EnvironmentMap make_environment_map(const SceneImage& image) {
    EnvironmentMap map;
    const int width = image.bytes.empty() ? image.floats.width : image.bytes.width;
    const int height = image.bytes.empty() ? image.floats.height : image.bytes.height;
    map.texels = Image<Rgb>(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            map.texels(x, y) = clean(Rgb(read_texel(image, x, y, TextureSpace::srgb)));
        }
    }
    if (map.texels.empty()) return map;
    build_distribution(map);
    const EnvironmentCells parts(map, ranges_step);
    map.ranges.resize(static_cast<std::size_t>(parts.count()));
    parallel_each(map.ranges.size(), 64, [&](std::size_t i) { map.ranges[i] = parts.find_range(static_cast<int>(i)); });
    return map;
}

BetweenTexels place_between_texels(const EnvironmentMap& map, const glm::vec3& direction) {
    const glm::vec2 uv = to_uv(direction);
    const float x = uv.x * static_cast<float>(map.texels.width) - 0.5f;
    const float y = uv.y * static_cast<float>(map.texels.height) - 0.5f;
    const float fx = std::floor(x), fy = std::floor(y);
    return {(static_cast<int>(fx) + map.texels.width) % map.texels.width, static_cast<int>(fy), x - fx, y - fy};
}

Rgb look_up(const EnvironmentMap& map, const glm::vec3& direction) {
    const auto [x0, y, ax, ay] = place_between_texels(map, direction);
    const int x1 = (x0 + 1) % map.texels.width;
    const int y0 = std::max(y, 0), y1 = std::min(y + 1, map.texels.height - 1);
    return (1.0f - ay) * ((1.0f - ax) * map.texels(x0, y0) + ax * map.texels(x1, y0)) +
           ay * ((1.0f - ax) * map.texels(x0, y1) + ax * map.texels(x1, y1));
}

EnvironmentSample sample_environment(const EnvironmentMap& map, const glm::vec2& u) {
    if (map.black) return {};
    glm::vec2 within = u;
    const int y = choose_part(map.rows, within.y);
    const std::size_t width = static_cast<std::size_t>(map.texels.width);
    const int x = choose_part(std::span(map.columns).subspan(static_cast<std::size_t>(y) * width, width), within.x);
    const double height = map.texels.height;
    const double top = std::cos(std::numbers::pi * y / height), bottom = std::cos(std::numbers::pi * (y + 1) / height);
    const double polar = std::acos(top + (bottom - top) * within.y);
    const float column = (static_cast<float>(x) + within.x) / static_cast<float>(map.texels.width);
    return {to_direction({column, static_cast<float>(polar / std::numbers::pi)}), texel_density(map, x, y)};
}

float pdf_environment(const EnvironmentMap& map, const glm::vec3& direction) {
    if (map.black) return 0.0f;
    const glm::vec2 uv = to_uv(direction);
    const int x = static_cast<int>(uv.x * static_cast<float>(map.texels.width));
    const int y = static_cast<int>(uv.y * static_cast<float>(map.texels.height));
    return texel_density(map, x, y);
}

}  // namespace aleph
