#include "engine/scene_file/path_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr int pieces = 16;  ///< of a segment, each integrated by itself

}  // namespace

PathCurve::PathCurve(const std::vector<glm::dvec3>& points, bool closed) {
    take_points(points, closed);
    if (points_.size() < 2) return;
    make_segments(closed);
    add_distances();
}

void PathCurve::take_points(const std::vector<glm::dvec3>& points, bool closed) {
    for (const glm::dvec3& point : points) {
        const bool again = !points_.empty() && glm::distance(points_.back(), point) == 0.0;
        if (again) {
            corners_.back() = true;
        } else {
            points_.push_back(point);
            corners_.push_back(false);
        }
    }
    // A closed curve may name its first point again as its last.
    while (closed && points_.size() > 1 && glm::distance(points_.back(), points_.front()) == 0.0) {
        corners_.front() = corners_.front() || corners_.back();
        points_.pop_back();
        corners_.pop_back();
    }
}

/// Derivatives of the parabola through three points, over knots whose distances are the square roots of those of the
/// points. At ends and corners that of the parabola that the other end of the segment gives.
void PathCurve::make_segments(bool closed) {
    const std::size_t count = closed ? points_.size() : points_.size() - 1;
    segments_.resize(count);
    std::vector<double> knots(count);
    for (std::size_t i = 0; i < count; ++i) {
        segments_[i] = {.start = points_[i], .end = points_[(i + 1) % points_.size()]};
        knots[i] = std::sqrt(glm::distance(segments_[i].start, segments_[i].end));
    }
    const auto chord = [&](std::size_t i) { return segments_[i].end - segments_[i].start; };
    const auto is_smooth = [&](std::size_t point) {
        const bool end = !closed && (point == 0 || point + 1 == points_.size());
        return !end && !corners_[point % points_.size()];
    };
    /// At the start of segment i, by the knots.
    const auto tangent = [&](std::size_t i) {
        const std::size_t before = (i + count - 1) % count;
        const double share = knots[i] / (knots[before] + knots[i]);
        return chord(before) / knots[before] * share + chord(i) / knots[i] * (1.0 - share);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const bool start = is_smooth(i), end = is_smooth(i + 1);
        Segment& segment = segments_[i];
        segment.leaving = start ? tangent(i) * knots[i] : chord(i);
        segment.arriving = end ? tangent((i + 1) % count) * knots[i] : chord(i);
        if (!start && end) segment.leaving = 2.0 * chord(i) - segment.arriving;
        if (start && !end) segment.arriving = 2.0 * chord(i) - segment.leaving;
    }
}

void PathCurve::add_distances() {
    distances_.reserve(segments_.size() * pieces + 1);
    distances_.push_back(0.0);
    for (const Segment& segment : segments_) {
        for (int piece = 0; piece < pieces; ++piece) {
            const double from = piece / double{pieces}, to = (piece + 1) / double{pieces};
            distances_.push_back(distances_.back() + arc_length(segment, from, to));
        }
    }
}

glm::dvec3 PathCurve::derivative(const Segment& s, double u) {
    return (s.end - s.start) * (6.0 * u * (1.0 - u)) + s.leaving * ((3.0 * u - 4.0) * u + 1.0) +
           s.arriving * ((3.0 * u - 2.0) * u);
}

/// By Gauss and Legendre's rule with five points.
double PathCurve::arc_length(const Segment& segment, double from, double to) {
    constexpr std::array nodes{-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683, 0.906179845938664};
    constexpr std::array weights{0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                 0.236926885056189};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0.0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        sum += weights[i] * glm::length(derivative(segment, middle + half * nodes[i]));
    return sum * half;
}

PathCurve::Place PathCurve::at(double distance) const {
    const double inside = std::clamp(distance, 0.0, length());
    const auto above = std::upper_bound(distances_.begin() + 1, distances_.end() - 1, inside);
    const std::size_t piece = static_cast<std::size_t>(above - distances_.begin()) - 1;
    const Segment& segment = segments_[piece / pieces];
    const double from = static_cast<double>(piece % pieces) / pieces, left = inside - distances_[piece];
    // Newton's steps within a bracket.
    double low = from, high = from + 1.0 / pieces;
    double u = from + left / std::max(*above - distances_[piece], 1e-300) / pieces;
    for (int i = 0; i < 60; ++i) {
        u = std::clamp(u, low, high);
        const double beyond = arc_length(segment, from, u) - left, speed = glm::length(derivative(segment, u));
        (beyond > 0.0 ? high : low) = u;
        double next = u - beyond / speed;
        if (!(next >= low && next <= high)) next = 0.5 * (low + high);
        if (std::abs(next - u) <= 1e-14) break;
        u = next;
    }
    const double to_end = u * u * (3.0 - 2.0 * u);
    return {.position = segment.start + (segment.end - segment.start) * to_end +
                        segment.leaving * (u * (1.0 - u) * (1.0 - u)) - segment.arriving * (u * u * (1.0 - u)),
            .direction = safe_normalize(derivative(segment, u))};
}

}  // namespace aleph
