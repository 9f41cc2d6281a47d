// The textures of the scene, drawn from formulas. All have features at every scale that image-based motion can follow.

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/boomerang/boomerang_scene.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

const glm::dvec3 ivory(248, 240, 222), cobalt(26, 58, 150), vermilion(214, 50, 28);
const glm::dvec3 night(24, 40, 62), teal(28, 112, 118), sand(226, 190, 132), ochre(206, 134, 52), rust(168, 66, 36),
    cream(244, 230, 200), leaf(98, 128, 62), coal(32, 26, 28), sky(148, 196, 204), gold(240, 184, 62);

/// 1 inside a disc of a lattice with shifted rows, 0 outside. Lengths in the units of `at`.
double dots(glm::dvec2 at, double spacing, double radius) {
    const double row = std::floor(at.y / spacing);
    at.x += std::fmod(std::abs(row), 2.0) * 0.5 * spacing;
    const glm::dvec2 cell = glm::floor(at / spacing) + 0.5;
    return glm::distance(at, cell * spacing) < radius ? 1.0 : 0.0;
}

/// Height of the top of a range of hills: the sum of two waves.
double hill(double x, double base, double height, double length, double phase) {
    return base + height * std::sin(2.0 * pi * x / length + phase) +
           0.35 * height * std::sin(2.0 * pi * x / (0.37 * length) + 2.3 * phase);
}

/// A layer of the mural: paint with rows of dots that follow its upper edge, and a line along that edge.
glm::dvec3 paint_hill(const glm::dvec2& at, double edge, const glm::dvec3& color, const glm::dvec3& dot,
                      double spacing) {
    const double depth = at.y - edge;
    if (depth < 0.018) return coal;
    if (depth < 0.032) return dot;
    const glm::dvec3 shaded = color * (1.0 - 0.22 * std::clamp(depth / 0.6, 0.0, 1.0));
    return dots({at.x, depth}, spacing, 0.27 * spacing) > 0.0 && depth > 0.05 ? dot : shaded;
}

/// Metres, x to the right, y down from the wall's top; the wall is 5.2 by 3.
glm::dvec3 color_mural(const glm::dvec2& uv) {
    const glm::dvec2 at(5.2 * uv.x, 3.0 * uv.y);
    const glm::dvec2 sun(3.55, 0.95);
    const glm::dvec2 from_sun = at - sun;
    const double radius = glm::length(from_sun), angle = std::atan2(from_sun.y, from_sun.x);
    const struct {
        double base, height, length, phase, spacing;
        glm::dvec3 color, dot;
    } hills[] = {{2.42, 0.1, 1.9, 0.4, 0.062, leaf, cream},
                 {2.02, 0.14, 2.6, 2.1, 0.075, rust, gold},
                 {1.62, 0.17, 3.3, 4.0, 0.062, ochre, night},
                 {1.28, 0.2, 2.9, 5.6, 0.075, teal, sand}};
    for (const auto& h : hills) {
        const double edge = hill(at.x, h.base, h.height, h.length, h.phase);
        if (at.y > edge) return paint_hill(at, edge, h.color, h.dot, h.spacing);
    }
    if (radius < 0.33) return std::fmod(radius, 0.11) < 0.035 ? rust : gold;
    if (radius < 0.36) return coal;
    const double ray = std::abs(std::fmod(angle / (2.0 * pi) * 24.0 + 48.0, 1.0) - 0.5);
    if (radius < 0.62 && ray < 0.16) return gold;
    if (radius > 0.66 && radius < 1.5 && std::fmod(radius, 0.14) < 0.06) {
        const double along = std::fmod(angle / (2.0 * pi) * std::floor(radius / 0.14) * 9.0 + 1000.0, 1.0);
        return along < 0.55 ? cream : sky;
    }
    return glm::mix(sky, night, std::clamp((0.5 - at.y) * 0.9, 0.0, 0.6)) * (1.0 - 0.25 * dots(at, 0.11, 0.026));
}

/// Four cement tiles: quarter circles that form rings where four tiles meet, and a star in the middle of each tile.
glm::dvec3 color_tiles(const glm::dvec2& uv) {
    const glm::dvec2 tile = glm::fract(2.0 * uv);
    const glm::dvec2 corner = glm::min(tile, 1.0 - tile), middle = glm::abs(tile - 0.5);
    const double from_corner = glm::length(corner), from_middle = glm::length(middle);
    if (std::min(corner.x, corner.y) < 0.012) return {120, 108, 94};  // the joint
    if (from_corner < 0.15) return rust;
    if (from_corner < 0.19) return cream;
    if (from_corner < 0.34) return dots(tile, 0.083, 0.024) > 0.0 ? sand : teal;
    if (from_corner < 0.38) return cream;
    const double turn = std::atan2(middle.y, middle.x);
    const double star = 0.16 + 0.09 * std::cos(8.0 * turn);
    if (from_middle < 0.06) return gold;
    if (from_middle < star) return night;
    if (std::abs(from_middle - star) < 0.018) return cream;
    return glm::dvec3(214, 196, 164);
}

/// Trowelled clay: three scales of soft noise.
glm::dvec3 color_plaster(const glm::dvec2& uv) {
    const double broad = fractal_noise(uv, {4, 4}, 3, 11), fine = fractal_noise(uv, {24, 12}, 3, 23);
    return glm::dvec3(198, 104, 70) * (0.72 + 0.36 * broad + 0.2 * fine);
}

/// The top of the blade, from tip to tip (s, in blade widths) and from leading to trailing edge (c, in [-1, 1]).
glm::dvec3 color_top(double s, double c) {
    const double blade = 8.9;  // widths from tip to tip
    const double from_tip = blade * (0.5 - std::abs(s - 0.5)), from_elbow = blade * std::abs(s - 0.5);
    const auto ring = [&](double at) {
        const glm::dvec2 p(from_elbow - at, 0.5 * c);
        const double r = glm::length(p);
        return r < 0.09 ? 1 : r < 0.17 ? 2 : r < 0.25 ? 3 : 0;
    };
    if (from_tip < 0.6) return vermilion;
    if (from_tip < 0.72) return coal;
    if (from_tip < 1.4) return dots({from_tip, 0.5 * c + 5.0}, 0.17, 0.055) > 0.0 ? ivory : cobalt;
    if (from_tip < 1.52) return coal;
    if (std::abs(c) > 0.82) return vermilion;
    if (std::abs(c) > 0.68) return std::fmod(from_elbow, 0.16) < 0.09 ? cobalt : ivory;
    if (from_elbow < 0.8) {
        // Chevrons point to the elbow.
        const double band = std::fmod(from_elbow + 0.28 * std::abs(c) + 0.02, 0.27);
        return band < 0.11 ? vermilion : band < 0.16 ? coal : gold;
    }
    for (const double at : {1.3, 1.95, 2.6}) {
        const int circle = ring(at);
        if (circle != 0) return circle == 2 ? gold : circle == 1 ? vermilion : coal;
    }
    const double wave = 0.4 * std::sin(2.0 * pi * (from_elbow - 0.65) / 0.65);
    if (std::abs(c - wave) < 0.08 || std::abs(c + wave) < 0.08) return cobalt;
    return ivory;
}

/// The lower side: bare wood with its grain along the blade, and a band at each tip.
glm::dvec3 color_bottom(const glm::dvec2& uv) {
    const double from_tip = 8.9 * (0.5 - std::abs(uv.x - 0.5));
    if (from_tip < 0.6) return vermilion;
    if (from_tip < 0.72) return coal;
    const double grain = fractal_noise(uv, {6, 96}, 3, 41);
    return glm::dvec3(188, 134, 82) * (0.7 + 0.45 * grain);
}

glm::dvec3 color_paint(const glm::dvec2& uv) {
    return uv.y < 0.5 ? color_top(uv.x, 4.0 * uv.y - 1.0) : color_bottom({uv.x, 2.0 * uv.y - 1.0});
}

}  // namespace

std::vector<DrawnTexture> make_boomerang_textures() {
    return {draw_texture("mural", 1040, 600, 4, color_mural), draw_texture("tiles", 256, 256, 4, color_tiles),
            draw_texture("plaster", 256, 256, 1, color_plaster), draw_texture("paint", 1024, 192, 4, color_paint)};
}

}  // namespace aleph
