#include "engine/surface/revolved.h"

#include <cmath>
#include <numbers>

namespace aleph {

namespace {

/// Calls visit(upper, lower) for neighbouring points that have surface between them.
template <class Visit>
void for_each_band(const std::vector<OutlineStrip>& outline, const Visit& visit) {
    for (const OutlineStrip& strip : outline) {
        for (std::size_t i = 0; i + 1 < strip.size(); ++i) {
            if (strip[i].position.x > 0.0 || strip[i + 1].position.x > 0.0) visit(strip, i);
        }
    }
}

/// First vertex of a row. On the axis every segment has a vertex of its own, in its middle.
std::uint32_t add_row(Mesh& mesh, const Shape& shape, const OutlinePoint& point) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const bool pole = !(point.position.x > 0.0);
    const int count = pole ? shape.segments : shape.segments + 1;
    for (int i = 0; i < count; ++i) {
        const double column = pole ? i + 0.5 : i;
        const glm::dvec3 out = around(column, shape.segments);
        const glm::dvec3 up(0.0, 1.0, 0.0);
        mesh.positions.emplace_back(out * point.position.x + up * point.position.y);
        mesh.normals.emplace_back(out * point.normal.x + up * point.normal.y);
        mesh.uv[0].emplace_back(glm::dvec2(column / shape.segments, point.v) * shape.uv_scale);
    }
    return first;
}

}  // namespace

glm::dvec3 around(double column, int segments) {
    const double turn = std::fmod(column, segments) / segments;
    const double angle = 2.0 * std::numbers::pi * (turn - 0.5);
    return {std::sin(angle), 0.0, std::cos(angle)};
}

std::size_t count_revolved_triangles(const std::vector<OutlineStrip>& outline, int segments) {
    std::size_t count = 0;
    for_each_band(outline, [&](const OutlineStrip& strip, std::size_t i) {
        const bool pole = !(strip[i].position.x > 0.0 && strip[i + 1].position.x > 0.0);
        count += static_cast<std::size_t>(segments) * (pole ? 1 : 2);
    });
    return count;
}

void add_revolved(Mesh& mesh, const Shape& shape, const std::vector<OutlineStrip>& outline) {
    const OutlineStrip* strip_before = nullptr;
    std::size_t row_before = 0;
    std::uint32_t lower = 0;
    for_each_band(outline, [&](const OutlineStrip& strip, std::size_t i) {
        const bool follows = strip_before == &strip && row_before + 1 == i;
        const std::uint32_t upper = follows ? lower : add_row(mesh, shape, strip[i]);
        lower = add_row(mesh, shape, strip[i + 1]);
        strip_before = &strip;
        row_before = i;
        const bool top_pole = !(strip[i].position.x > 0.0), bottom_pole = !(strip[i + 1].position.x > 0.0);
        for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(shape.segments); ++c) {
            if (!bottom_pole) mesh.triangles.emplace_back(upper + c, lower + c, lower + c + 1);
            if (!top_pole) mesh.triangles.emplace_back(upper + c, lower + c + (bottom_pole ? 0 : 1), upper + c + 1);
        }
    });
}

}  // namespace aleph
