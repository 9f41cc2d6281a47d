#include "render/verify/probe_place.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr int most_side = 16;          // pixels, of a block
constexpr double root = 1.2207440846;  // of x^4 = x + 1

/// Where the sequence is along an axis, in [0, 1).
double at_axis(std::size_t number, int axis) {
    const double at = 0.5 + static_cast<double>(number + 1) * std::pow(root, -(axis + 1));
    return at - std::floor(at);
}

/// One of `count` parts, by a place in [0, 1).
int part_at(double place, int count) {
    return std::min(static_cast<int>(place * count), count - 1);
}

struct Span {
    int first, size;
};

Span choose_span(double place, int length) {
    const int count = (length + most_side - 1) / most_side, i = part_at(place, count);
    const int first = i * length / count;
    return {first, (i + 1) * length / count - first};
}

}  // namespace

ProbePlace place_probe(std::size_t number, std::span<const std::int64_t> frames, int width, int height) {
    const Span x = choose_span(at_axis(number, 1), width), y = choose_span(at_axis(number, 2), height);
    const int frame = part_at(at_axis(number, 0), static_cast<int>(frames.size()));
    return {frames[static_cast<std::size_t>(frame)], {x.first, y.first, x.size, y.size}};
}

}  // namespace aleph
