// Outlines of round shapes. A lathe's smooth outline is a centripetal Catmull-Rom spline (Yuksel, Schaefer, Keyser
// 2011, "Parameterization and applications of Catmull-Rom curves"): it neither loops nor overshoots between points.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "engine/surface/revolved.h"

namespace aleph {

namespace {

/// A point of the profile and whether the outline has an edge there.
struct Knot {
    glm::dvec2 point;
    bool sharp = false;
};

struct Profile {
    std::vector<Knot> knots;  ///< neighbours differ
    bool closed = false;      ///< the last is the first
};

/// Twice over pi what the profile encloses together with the axis; above 0 where it runs up the outer side.
double signed_volume(const std::vector<Knot>& knots) {
    double sum = 0.0;
    for (std::size_t i = 1; i < knots.size(); ++i) {
        const glm::dvec2 a = knots[i - 1].point, b = knots[i].point;
        sum += (a.x * a.x + a.x * b.x + b.x * b.x) * (b.y - a.y);
    }
    return sum;
}

/// Running so that the outside lies on its left.
Profile read_profile(const Shape& shape) {
    Profile profile;
    std::vector<Knot>& knots = profile.knots;
    double extent = 0.0;
    for (const glm::dvec2& point : shape.profile) {
        extent = std::max(extent, glm::distance(shape.profile.front(), point));
    }
    for (const glm::dvec2& point : shape.profile) {
        if (!knots.empty() && glm::distance(knots.back().point, point) <= 1e-9 * extent) {
            knots.back().sharp = true;
        } else {
            knots.push_back({point, !shape.smooth});
        }
    }
    profile.closed = knots.size() > 3 && knots.front().point == knots.back().point;
    if (profile.closed) knots.front().sharp = knots.back().sharp = knots.front().sharp || knots.back().sharp;
    const double volume = signed_volume(knots);
    // An outline that encloses nothing is a flat ring or disc: it faces up.
    if (volume > 0.0 || (volume == 0.0 && knots.back().point.x < knots.front().point.x)) {
        std::reverse(knots.begin(), knots.end());
    }
    return profile;
}

/// A cubic from one knot to the next, in Hermite's form over [0, 1].
struct Span {
    glm::dvec2 from, to, from_tangent, to_tangent;

    glm::dvec2 point(double s) const {
        const double r = 1.0 - s;
        return from * (r * r * (1.0 + 2.0 * s)) + to * (s * s * (3.0 - 2.0 * s)) + from_tangent * (s * r * r) -
               to_tangent * (s * s * r);
    }
    /// Unit; the chord's where the cubic stands still.
    glm::dvec2 direction(double s) const {
        const glm::dvec2 chord = to - from;
        const glm::dvec2 slope = chord * (6.0 * s * (1.0 - s)) + from_tangent * ((1.0 - s) * (1.0 - 3.0 * s)) +
                                 to_tangent * (s * (3.0 * s - 2.0));
        return glm::normalize(glm::length(slope) > 1e-9 * glm::length(chord) ? slope : chord);
    }
};

/// Derivative at b of the spline through a, b, c by the knots' distances.
glm::dvec2 middle_tangent(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const double before = std::sqrt(glm::distance(a, b)), after = std::sqrt(glm::distance(b, c));
    return (b - a) / before - (c - a) / (before + after) + (c - b) / after;
}

/// The tangent that a knot with smooth neighbours has; nothing at edges and at ends off the axis.
std::optional<glm::dvec2> knot_tangent(const Profile& profile, std::size_t i) {
    const std::vector<Knot>& knots = profile.knots;
    const Knot& knot = knots[i];
    const bool first = i == 0, last = i + 1 == knots.size();
    if (knot.sharp) return std::nullopt;
    if (!first && !last) return middle_tangent(knots[i - 1].point, knot.point, knots[i + 1].point);
    if (profile.closed) return middle_tangent(knots[knots.size() - 2].point, knot.point, knots[1].point);
    if (knot.point.x > 0.0) return std::nullopt;
    // On the axis the outline goes on as its own mirror image: the surface is round there.
    const glm::dvec2 inner = knots[first ? 1 : i - 1].point, mirrored(-inner.x, inner.y);
    return first ? middle_tangent(mirrored, knot.point, inner) : middle_tangent(inner, knot.point, mirrored);
}

Span make_span(const Profile& profile, std::size_t i) {
    const glm::dvec2 from = profile.knots[i].point, to = profile.knots[i + 1].point;
    const double length = std::sqrt(glm::distance(from, to));
    const glm::dvec2 chord = to - from;
    const auto begin = knot_tangent(profile, i), end = knot_tangent(profile, i + 1);
    Span span{from, to, chord, chord};
    if (begin) span.from_tangent = *begin * length;
    if (end) span.to_tangent = *end * length;
    // A free end does not bend.
    if (!begin && end) span.from_tangent = 0.5 * (3.0 * chord - span.to_tangent);
    if (begin && !end) span.to_tangent = 0.5 * (3.0 * chord - span.from_tangent);
    return span;
}

/// As many as a circle of `segments` has over the angle by which the span turns.
int count_pieces(const Span& span, int segments) {
    constexpr int steps = 16;
    double turn = 0.0;
    glm::dvec2 before = span.direction(0.0);
    for (int i = 1; i <= steps; ++i) {
        const glm::dvec2 now = span.direction(static_cast<double>(i) / steps);
        turn += std::abs(std::atan2(before.x * now.y - before.y * now.x, glm::dot(before, now)));
        before = now;
    }
    const double pieces = std::ceil(turn * segments / (2.0 * std::numbers::pi) - 1e-6);
    return std::clamp(static_cast<int>(pieces), 1, segments);
}

glm::dvec2 left_of(const glm::dvec2& direction) {
    return {-direction.y, direction.x};
}

std::vector<OutlineStrip> make_lathe_outline(const Shape& shape) {
    const Profile profile = read_profile(shape);
    std::vector<OutlineStrip> strips;
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < profile.knots.size(); ++i) {
        const Span span = make_span(profile, i);
        const int pieces = count_pieces(span, shape.segments);
        if (i == 0 || profile.knots[i].sharp) strips.push_back({{span.from, left_of(span.direction(0.0)), length}});
        for (int piece = 1; piece <= pieces; ++piece) {
            const double s = static_cast<double>(piece) / pieces;
            glm::dvec2 point = piece == pieces ? span.to : span.point(s);
            point.x = std::max(point.x, 0.0);
            length += glm::distance(strips.back().back().position, point);
            strips.back().push_back({point, left_of(span.direction(s)), length});
        }
    }
    for (OutlineStrip& strip : strips) {
        for (OutlinePoint& point : strip) point.v /= length;
    }
    return strips;
}

/// From the inner circle over the top and back: the middle of an image lies on the outer circle.
std::vector<OutlineStrip> make_torus_outline(const Shape& shape) {
    const int rows = std::max(3, shape.segments / 2);
    OutlineStrip strip;
    for (int i = 0; i <= rows; ++i) {
        const double v = static_cast<double>(i) / rows;
        const double angle = std::numbers::pi * (1.0 - 2.0 * static_cast<double>(i % rows) / rows);
        const glm::dvec2 normal(std::cos(angle), std::sin(angle));
        strip.push_back({glm::dvec2(shape.radius, 0.0) + normal * shape.tube_radius, normal, v});
    }
    return {strip};
}

/// From pole to pole.
std::vector<OutlineStrip> make_sphere_outline(const Shape& shape) {
    const int rows = std::max(2, shape.segments / 2);
    OutlineStrip strip;
    for (int i = 0; i <= rows; ++i) {
        const double v = static_cast<double>(i) / rows, polar = std::numbers::pi * v;
        const glm::dvec2 normal(i == rows ? 0.0 : std::sin(polar), std::cos(polar));
        strip.push_back({normal * shape.radius, normal, v});
    }
    return {strip};
}

/// Without the caps.
std::vector<OutlineStrip> make_cylinder_outline(const Shape& shape) {
    const glm::dvec2 out(1.0, 0.0), top(shape.radius, 0.5 * shape.height), bottom(shape.radius, -0.5 * shape.height);
    return {{{top, out, 0.0}, {bottom, out, 1.0}}};
}

}  // namespace

std::vector<OutlineStrip> make_outline(const Shape& shape) {
    switch (shape.kind) {
        case Shape::Kind::sphere:
            return make_sphere_outline(shape);
        case Shape::Kind::cylinder:
            return make_cylinder_outline(shape);
        case Shape::Kind::torus:
            return make_torus_outline(shape);
        default:
            return make_lathe_outline(shape);
    }
}

std::size_t count_outline_pieces(const Shape& shape) {
    const Profile profile = read_profile(shape);
    std::size_t pieces = 0;
    for (std::size_t i = 0; i + 1 < profile.knots.size(); ++i) {
        pieces += static_cast<std::size_t>(count_pieces(make_span(profile, i), shape.segments));
    }
    return pieces;
}

}  // namespace aleph
