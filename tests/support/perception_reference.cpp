#include "tests/support/perception_reference.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "tests/support/all_pixels.h"
#include "tests/support/vision_formulas.h"

namespace aleph {

namespace {

constexpr double kernel[5] = {0.05, 0.25, 0.4, 0.25, 0.05};

int mirror(int i, int n) {
    if (n == 1) return 0;
    while (i < 0 || i >= n) i = i < 0 ? -i : 2 * (n - 1) - i;
    return i;
}

DoubleImage from_function(int width, int height, const auto& f) {
    DoubleImage out(width, height);
    for (const auto [x, y] : all_pixels(width, height)) out(x, y) = f(x, y);
    return out;
}

template <class T>
Image<T> filter(const Image<T>& image, double gain_x, double gain_y) {
    Image<T> rows(image.width, image.height), out(image.width, image.height);
    for (const auto [x, y] : all_pixels(image)) {
        for (int k = -2; k <= 2; ++k) rows(x, y) += gain_x * kernel[k + 2] * image(mirror(x + k, image.width), y);
    }
    for (const auto [x, y] : all_pixels(image)) {
        for (int k = -2; k <= 2; ++k) out(x, y) += gain_y * kernel[k + 2] * rows(x, mirror(y + k, image.height));
    }
    return out;
}

DoubleImage orientation(const DoubleImage& level, double degrees) {
    const DoubleImage low = reference_low_pass(level);
    const double k = std::numbers::pi / 2, angle = degrees * std::numbers::pi / 180;
    Image<std::complex<double>> wave(level.width, level.height);
    for (const auto [x, y] : all_pixels(level)) {
        wave(x, y) = (level(x, y) - low(x, y)) * std::polar(1.0, k * (x * std::cos(angle) + y * std::sin(angle)));
    }
    const auto filtered = filter(wave, 1.0, 1.0);
    return from_function(level.width, level.height, [&](int x, int y) { return std::abs(filtered(x, y)); });
}

void add_normalized(DoubleImage& sum, const DoubleImage& map, double floor) {
    const auto [low, high] = std::minmax_element(map.pixels.begin(), map.pixels.end());
    if (!(*high - *low > floor)) return;
    const double weight = reference_weight(map, floor);
    for (std::size_t i = 0; i < sum.size(); ++i) sum.pixels[i] += weight * (map.pixels[i] - *low) / (*high - *low);
}

/// The six maps of a pyramid, each added to the channel's conspicuity.
void add_features(DoubleImage& conspicuity, const std::vector<DoubleImage>& pyramid, double floor) {
    std::vector<DoubleImage> full(9);
    for (int level = 2; level <= 8; ++level) {
        full[level] = reference_full_size(pyramid, level);
    }
    constexpr std::pair<int, int> pairs[6] = {{2, 5}, {2, 6}, {3, 6}, {3, 7}, {4, 7}, {4, 8}};
    for (const auto& [c, s] : pairs) {
        const DoubleImage& center = full[c];
        const DoubleImage& surround = full[s];
        add_normalized(conspicuity,
                       from_function(center.width, center.height,
                                     [&](int x, int y) { return std::abs(center(x, y) - surround(x, y)); }),
                       floor);
    }
}

}  // namespace

DoubleImage reference_low_pass(const DoubleImage& image) {
    return filter(image, 1.0, 1.0);
}

DoubleImage reference_reduce(const DoubleImage& image) {
    const DoubleImage low = reference_low_pass(image);
    return from_function((image.width + 1) / 2, (image.height + 1) / 2,
                         [&](int x, int y) { return low(2 * x, 2 * y); });
}

DoubleImage reference_expand(const DoubleImage& image, int width, int height) {
    // An axis of size 1 is copied, without inserted zeros.
    const bool copy_x = image.width == 1, copy_y = image.height == 1;
    const DoubleImage spread = from_function(width, height, [&](int x, int y) {
        if ((!copy_x && x % 2 != 0) || (!copy_y && y % 2 != 0)) return 0.0;
        return image(copy_x ? 0 : x / 2, copy_y ? 0 : y / 2);
    });
    return filter(spread, copy_x ? 1.0 : 2.0, copy_y ? 1.0 : 2.0);
}

std::vector<DoubleImage> reference_pyramid(const DoubleImage& image, int count) {
    std::vector<DoubleImage> levels = {image};
    while (static_cast<int>(levels.size()) < count) levels.push_back(reference_reduce(levels.back()));
    return levels;
}

DoubleImage reference_full_size(const std::vector<DoubleImage>& pyramid, int from) {
    DoubleImage out = pyramid[from];
    for (int level = from - 1; level >= 0; --level) {
        const DoubleImage& finer = pyramid[level];
        out = reference_expand(out, finer.width, finer.height);
    }
    return out;
}

double reference_weight(const DoubleImage& map, double floor) {
    const auto [low, high] = std::minmax_element(map.pixels.begin(), map.pixels.end());
    const double range = *high - *low;
    if (!(range > floor)) return 0.0;
    Image<int> quantised(map.width, map.height), label(map.width, map.height, -1);
    for (std::size_t i = 0; i < map.size(); ++i) {
        quantised.pixels[i] = static_cast<int>(std::floor((map.pixels[i] - *low) / range * 65535.0 + 0.5));
    }
    std::vector<double> maxima;
    for (const auto [x, y] : all_pixels(map)) {
        if (label(x, y) >= 0) continue;
        bool highest = true;
        std::vector<std::pair<int, int>> stack = {{x, y}};
        label(x, y) = 1;
        while (!stack.empty()) {
            const auto [cx, cy] = stack.back();
            stack.pop_back();
            for (int ny = std::max(0, cy - 1); ny <= std::min(map.height - 1, cy + 1); ++ny) {
                for (int nx = std::max(0, cx - 1); nx <= std::min(map.width - 1, cx + 1); ++nx) {
                    if (quantised(nx, ny) > quantised(x, y)) highest = false;
                    if (quantised(nx, ny) != quantised(x, y) || label(nx, ny) >= 0) continue;
                    label(nx, ny) = 1;
                    stack.push_back({nx, ny});
                }
            }
        }
        const double value = quantised(x, y) / 65535.0;
        if (highest && value >= 0.1) maxima.push_back(value);
    }
    std::sort(maxima.begin(), maxima.end());
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < maxima.size(); ++i) sum += maxima[i];
    const double mean = maxima.size() > 1 ? sum / static_cast<double>(maxima.size() - 1) : 0.0;
    return (1 - mean) * (1 - mean);
}

ReferenceMaps reference_perception(const Image<Rgb>& estimate, const Image<float>& velocity) {
    const int w = estimate.width, h = estimate.height;
    const auto channel = [&](double x_weight, double y_weight, double z_weight) {
        return from_function(w, h, [&](int x, int y) {
            const glm::dvec3 c(estimate(x, y));
            return x_weight * (0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z) +
                   y_weight * (0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z) +
                   z_weight * (0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z);
        });
    };
    const auto a = reference_pyramid(channel(-0.0177, 1.0090, 0.0073), 9);
    const auto c1 = reference_pyramid(channel(-1.5370, 1.0821, 0.3209), 9);
    const auto c2 = reference_pyramid(channel(0.1946, -0.2045, 0.5264), 9);
    const auto motion = reference_pyramid(
        from_function(w, h, [&](int x, int y) { return velocity(x, y) < 1e-3 / 31 * 30 ? 0.0 : velocity(x, y); }), 9);
    const double floor = 1e-6 * *std::max_element(a[0].pixels.begin(), a[0].pixels.end());

    std::array<DoubleImage, 4> conspicuity;
    conspicuity.fill(DoubleImage(w, h));
    add_features(conspicuity[0], a, floor);
    add_features(conspicuity[1], c1, floor);
    add_features(conspicuity[1], c2, floor);
    for (const double degrees : {0.0, 45.0, 90.0, 135.0}) {
        std::vector<DoubleImage> oriented;
        for (const DoubleImage& level : a) oriented.push_back(orientation(level, degrees));
        add_features(conspicuity[2], oriented, floor);
    }
    add_features(conspicuity[3], motion, 1e-3);

    ReferenceMaps out;
    out.saliency = DoubleImage(w, h);
    for (const DoubleImage& c : conspicuity) add_normalized(out.saliency, c, 1e-6);
    const auto [low, high] = std::minmax_element(out.saliency.pixels.begin(), out.saliency.pixels.end());
    const double minimum = *low, range = *high - *low;
    out.fallback = !(range > 1e-6);
    for (double& s : out.saliency.pixels) s = out.fallback ? 0.82 : (s - minimum) / range;

    std::vector<DoubleImage> full(8);
    for (int level = 0; level < 8; ++level) full[level] = reference_full_size(a, level);
    out.bands.fill(DoubleImage(w, h));
    out.band_sum = DoubleImage(w, h);
    out.aleph = DoubleImage(w, h);
    for (std::size_t p = 0; p < out.aleph.size(); ++p) {
        std::array<double, 7> l;
        double sum = 0.0;
        for (std::size_t i = 0; i < 7; ++i) sum += l[i] = std::abs(full[i].pixels[p] - full[i + 1].pixels[p]);
        out.band_sum.pixels[p] = sum / std::max(std::abs(full[0].pixels[p]), std::abs(full[7].pixels[p]));
        const EyeMotion moved{.retinal = written_retinal_velocity(velocity.pixels[p], out.saliency.pixels[p])};
        for (std::size_t i = 0; i < 7; ++i) {
            const double flat = i == 6 ? 1.0 : 0.0;
            out.bands[i].pixels[p] = out.band_sum.pixels[p] > 1e-5 ? l[i] / sum : flat;
            out.aleph.pixels[p] += out.bands[i].pixels[p] *
                                   written_elevation(&thesis_vision(), std::ldexp(16.0, -static_cast<int>(i)), moved);
        }
    }
    return out;
}

}  // namespace aleph
