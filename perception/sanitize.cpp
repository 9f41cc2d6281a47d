#include "perception/sanitize.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr double firefly_quantile = 0.999;
constexpr double firefly_factor = 10.0;
constexpr float max_component = 1e30f;  // luminance stays finite

enum class PixelState : std::uint8_t { valid, invalid, queued };

/// Lower median of each component over the valid 8-neighbours; false without any.
bool median_of_neighbours(const Image<Rgb>& image, const Image<PixelState>& state, int x, int y, Rgb& median) {
    float values[3][8];
    int count = 0;
    visit_around(image, x, y, 1, [&](int nx, int ny) {
        if (state(nx, ny) != PixelState::valid) return;
        for (int c = 0; c < 3; ++c) values[c][count] = image(nx, ny)[c];
        ++count;
    });
    if (count == 0) return false;
    for (int c = 0; c < 3; ++c) {
        float* const middle = values[c] + (count - 1) / 2;
        std::nth_element(values[c], middle, values[c] + count);
        median[c] = *middle;
    }
    return true;
}

struct Replacement {
    int x, y;
    Rgb value;
};

/// Fills invalid pixels from the rim inwards: each ring from the pixels that were valid before it.
void fill_invalid(Image<Rgb>& image, Image<PixelState>& state) {
    std::vector<Replacement> ring;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            Rgb value;
            if (state(x, y) != PixelState::invalid || !median_of_neighbours(image, state, x, y, value)) continue;
            ring.push_back({x, y, value});
        }
    }
    while (!ring.empty()) {
        for (const Replacement& r : ring) {
            image(r.x, r.y) = r.value;
            state(r.x, r.y) = PixelState::valid;
        }
        std::vector<Replacement> next;
        for (const Replacement& r : ring) {
            visit_around(image, r.x, r.y, 1, [&](int nx, int ny) {
                Rgb value;
                if (state(nx, ny) != PixelState::invalid) return;
                median_of_neighbours(image, state, nx, ny, value);
                state(nx, ny) = PixelState::queued;
                next.push_back({nx, ny, value});
            });
        }
        ring = std::move(next);
    }
}

/// Nearest-rank quantile; reorders `values`.
float quantile(std::vector<float>& values, double q) {
    const double rank = std::ceil(q * static_cast<double>(values.size()));
    const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + index, values.end());
    return values[index];
}

std::uint64_t clamp_fireflies(Image<Rgb>& estimate) {
    std::vector<float> values(estimate.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = luminance(estimate.pixels[i]);
    const std::vector<float> luminances = values;
    float typical = quantile(values, firefly_quantile);
    if (!(typical > 0.0f)) {
        std::erase_if(values, [](float v) { return !(v > 0.0f); });
        if (values.empty()) return 0;
        typical = quantile(values, firefly_quantile);
    }
    const double limit = firefly_factor * typical;
    std::uint64_t clamped = 0;
    for (std::size_t i = 0; i < luminances.size(); ++i) {
        if (!(luminances[i] > limit)) continue;
        estimate.pixels[i] *= static_cast<float>(limit / luminances[i]);
        ++clamped;
    }
    return clamped;
}

}  // namespace

SanitizeCounts sanitize_estimate(Image<Rgb>& estimate) {
    SanitizeCounts counts;
    if (estimate.empty()) return counts;
    Image<PixelState> state(estimate.width, estimate.height, PixelState::valid);
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        Rgb& pixel = estimate.pixels[i];
        if (is_finite(pixel)) {
            for (int c = 0; c < 3; ++c) pixel[c] = pixel[c] > 0.0f ? std::min(pixel[c], max_component) : 0.0f;
        } else {
            pixel = Rgb(0.0f);  // the result if no pixel of the frame is valid
            state.pixels[i] = PixelState::invalid;
            ++counts.replaced;
        }
    }
    if (counts.replaced > 0) fill_invalid(estimate, state);
    counts.clamped = clamp_fireflies(estimate);
    return counts;
}

}  // namespace aleph
