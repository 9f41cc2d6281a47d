#include "render/compare/compare_flicker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/errors.h"

namespace aleph {

namespace {

/// A pixel that contributes to a bilinear value.
struct Tap {
    std::size_t index;
    double weight;  ///< above 0; a target's weights add up to 1
};

struct Taps {
    std::array<Tap, 4> taps{};
    std::size_t count = 0;
};

/// The part of a target on one axis: its lower pixel and the weight of the next one.
struct Coordinate {
    int lower = 0;
    double fraction = 0.0;
};

/// Nothing if the target is outside the pixel centres by more than the rest limit.
std::optional<Coordinate> locate(double target, int size) {
    if (!(target >= -rest_limit && target <= size - 1 + rest_limit)) return std::nullopt;
    const double rounded = std::round(std::clamp(target, 0.0, size - 1.0) * 1000.0) / 1000.0;
    const double lower = std::floor(rounded);
    return Coordinate{static_cast<int>(lower), rounded - lower};
}

std::optional<Taps> find_taps(const Image<double>& image, double x, double y) {
    const auto column = locate(x, image.width), row = locate(y, image.height);
    if (!column || !row) return std::nullopt;
    Taps taps;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const double weight =
                (dx ? column->fraction : 1.0 - column->fraction) * (dy ? row->fraction : 1.0 - row->fraction);
            if (weight <= 0.0) continue;
            taps.taps[taps.count++] = {image.index(column->lower + dx, row->lower + dy), weight};
        }
    }
    return taps;
}

void check_size(const char* what, int width, int height, const Image<double>& error) {
    if (width == error.width && height == error.height) return;
    throw InputError("", what,
                     fmt::format("is {}x{}, the pictures are {}x{}", width, height, error.width, error.height));
}

/// One pixel's change.
struct Change {
    double difference = 0.0;  ///< cd/m2, not negative
    double variance = 0.0;    ///< (cd/m2)^2
};

/// Nothing if the target is another object or an error is not finite.
std::optional<Change> change_of(const LuminanceError& now, const LuminanceError& next, std::size_t i, const Taps& taps,
                                const Image<float>& objects, const Image<float>& next_objects) {
    const bool has_variance = !now.variance.empty() && !next.variance.empty();
    double difference = -now.error.pixels[i];
    Change change{0.0, has_variance ? now.variance.pixels[i] : 0.0};
    for (std::size_t k = 0; k < taps.count; ++k) {
        const auto [index, weight] = taps.taps[k];
        if (!objects.empty() && !next_objects.empty() && next_objects.pixels[index] != objects.pixels[i]) {
            return std::nullopt;
        }
        difference += weight * next.error.pixels[index];
        if (has_variance) change.variance += weight * weight * next.variance.pixels[index];
    }
    if (!std::isfinite(difference)) return std::nullopt;
    change.difference = std::abs(difference);
    return change;
}

}  // namespace

std::optional<FlickerMaps> make_flicker_maps(const ChannelImage& maps) {
    const Image<float>*u = maps.find("forward.u"), *v = maps.find("forward.v"), *valid = maps.find("motion.valid");
    const Image<float>*own = maps.find("threshold.flicker"), *object = maps.find("objectId.X");
    const Image<float>* threshold = own ? own : maps.find("threshold.Y");
    if (!u || !v || !valid || !threshold) return std::nullopt;
    return FlickerMaps{*u, *v, *valid, object ? *object : Image<float>{}, *threshold, own != nullptr};
}

void FlickerSum::add(const FlickerSum& other) {
    rest.add(other.rest);
    moving.add(other.moving);
    left_out += other.left_out;
}

FlickerSum measure_flicker(const LuminanceError& now, const LuminanceError& next, const FlickerMaps& maps,
                           const Image<float>& next_objects) {
    check_size("next frame", next.error.width, next.error.height, now.error);
    check_size("threshold map", maps.threshold.width, maps.threshold.height, now.error);
    if (!next_objects.empty()) {
        check_size("threshold map of the next frame", next_objects.width, next_objects.height, now.error);
    }
    FlickerSum sum;
    for (int y = 0; y < now.error.height; ++y) {
        for (int x = 0; x < now.error.width; ++x) {
            const std::size_t i = now.error.index(x, y);
            const double u = maps.u.pixels[i], v = maps.v.pixels[i];
            const bool rests = std::hypot(u, v) <= rest_limit;
            std::optional<Change> change;
            if (maps.valid.pixels[i] == 1.0f) {
                const auto taps = rests ? find_taps(next.error, x, y) : find_taps(next.error, x + u, y - v);
                if (taps) change = change_of(now, next, i, *taps, maps.object, next_objects);
            }
            if (!change) {
                ++sum.left_out;
                continue;
            }
            ThresholdSum& part = rests ? sum.rest : sum.moving;
            if (now.variance.empty() || next.variance.empty()) {
                part.add(change->difference, maps.threshold.pixels[i]);
            } else {
                part.add(change->difference, maps.threshold.pixels[i], change->variance);
            }
        }
    }
    return sum;
}

double FlickerFigures::percent_beyond() const {
    return pixels() == 0 ? 0.0 : 100.0 * static_cast<double>(beyond()) / static_cast<double>(pixels());
}

FlickerFigures summarize(const FlickerSum& sum, bool own_threshold) {
    return {summarize(sum.rest), summarize(sum.moving), sum.left_out, own_threshold};
}

}  // namespace aleph
