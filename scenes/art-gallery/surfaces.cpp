// Textures of floors, furniture, balls and the top.

#include <fmt/format.h>

#include <array>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

/// Herringbone: planks of 1 x 4 cells, across and upright in turn; the pattern repeats every 8 cells.
glm::dvec3 color_parquet(const glm::dvec2& uv) {
    const double cells = 8.0;
    const glm::dvec2 at = uv * cells;
    const glm::i64vec2 cell(glm::floor(at));
    const auto wrap = [](std::int64_t v, std::int64_t n) { return (v % n + n) % n; };
    const std::int64_t stair = wrap(cell.x - cell.y, 8);
    const bool across = stair < 4;
    // Along a plank, 0 to 4, and across it, 0 to 1.
    const double along = across ? static_cast<double>(stair) + glm::fract(at.x)
                                : static_cast<double>(wrap(7 - stair, 4)) + glm::fract(at.y);
    const double side = across ? glm::fract(at.y) : glm::fract(at.x);
    const glm::i64vec2 plank = across ? glm::i64vec2(wrap(cell.x - stair, 8), cell.y)
                                      : glm::i64vec2(cell.x + 16, wrap(cell.y - wrap(7 - stair, 4), 8));
    const double tone = pick(111, plank.x, plank.y);
    const glm::dvec2 grain_at = across ? glm::dvec2(at.x * 2.0, at.y * 14.0) : glm::dvec2(at.y * 2.0, at.x * 14.0);
    const double grain = noise(grain_at, {16, 112}, 112) - 0.5;
    const double edge = std::min({side, 1.0 - side, along, 4.0 - along});
    const glm::dvec3 wood = glm::mix(hex(0x9c6b3f), hex(0xcb9a63), tone) + 22.0 * grain;
    return wood * (edge < 0.04 ? 0.55 : 1.0);
}

/// White marble: thin grey veins where warped noise crosses its middle.
glm::dvec3 color_marble(const glm::dvec2& uv) {
    const double bend = fractal_noise(uv, {2, 2}, 4, 121);
    const double wave = std::abs(std::sin(2.0 * pi * (uv.x + 2.0 * uv.y) + 7.0 * bend));
    const double vein = std::pow(1.0 - wave, 5.0), cloud = fractal_noise(uv, {3, 3}, 4, 122) - 0.5;
    return hex(0xe9e6df) + 20.0 * cloud - glm::dvec3(96, 92, 84) * vein;
}

glm::dvec3 color_oak(const glm::dvec2& uv) {
    const double bend = fractal_noise(uv, {2, 3}, 3, 131);
    const double rings = 0.5 + 0.5 * std::sin(2.0 * pi * (6.0 * uv.y + 2.0 * bend));
    const double pores = noise(uv * glm::dvec2(8, 96), {8, 96}, 132);
    return glm::mix(hex(0x7a4e2b), hex(0xb07a48), 0.45 * rings + 0.35 * pores + 0.2 * bend);
}

/// Woven threads, nearly white, so that the base colour tints them.
glm::dvec3 color_weave(const glm::dvec2& uv) {
    const glm::dvec2 at = uv * 24.0;
    const glm::i64vec2 cell(glm::floor(at));
    const bool over = (cell.x + cell.y) % 2 == 0;
    const double round = over ? std::sin(pi * glm::fract(at.y)) : std::sin(pi * glm::fract(at.x));
    const double tone = over ? pick(141, cell.y) : pick(142, cell.x);
    return glm::dvec3(158.0 + 70.0 * round + 24.0 * tone);
}

/// A Greek key between bands, for a vase: u around, v from the top.
glm::dvec3 color_terracotta(const glm::dvec2& uv) {
    static const std::array<const char*, 7> key = {"########", ".......#", ".#####.#", ".#...#.#",
                                                   ".#.###.#", ".#.....#", ".#######"};
    const double grain = fractal_noise(uv, {24, 24}, 2, 151) - 0.5;
    const glm::dvec3 clay = hex(0xc4683a) + 18.0 * grain, black = hex(0x231815) + 8.0 * grain;
    const auto band = [&](double low, double high) { return uv.y >= low && uv.y < high; };
    if (band(0.34, 0.44)) {
        const auto row = static_cast<std::size_t>((uv.y - 0.34) / 0.1 * 6.999);
        return key[row][static_cast<std::size_t>(glm::fract(uv.x * 20.0) * 8.0)] == '#' ? black : clay;
    }
    if (band(0.32, 0.33) || band(0.45, 0.46) || band(0.66, 0.68)) return black;
    if (band(0.72, 0.92)) return std::abs(glm::fract(uv.x * 24.0) - 0.5) < 0.5 * (0.92 - uv.y) / 0.2 ? black : clay;
    if (band(0.5, 0.62)) {
        const double wave = 0.56 + 0.03 * std::sin(2.0 * pi * 12.0 * uv.x);
        return std::abs(uv.y - wave) < 0.014 ? black : clay;
    }
    return uv.y < 0.14 || uv.y > 0.96 ? black : clay;
}

/// Spiral sectors, so that spin and precession are both visible.
glm::dvec3 color_top(const glm::dvec2& uv) {
    static const std::array colors = {hex(0xe4332b), hex(0xf7f2e4), hex(0x1d4e9e), hex(0xf6c02c)};
    if (uv.y < 0.12) return hex(0x2a1a12);
    if (std::abs(uv.y - 0.45) < 0.016) return hex(0x1b1b1f);
    const double turn = glm::fract(uv.x + (uv.y < 0.45 ? 0.9 : -0.9) * uv.y);
    return colors[static_cast<std::size_t>(turn * 8.0) % 4];
}

glm::dvec3 color_ball(int number, const glm::dvec2& uv) {
    const double polar = pi * uv.y, turn = 2.0 * pi * uv.x;
    const glm::dvec3 p(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
    switch (number) {
        case 0: {  // a beach ball
            static const std::array colors = {hex(0xe4332b), hex(0xf7f2e4), hex(0x1f6fc4),
                                              hex(0xf7f2e4), hex(0xf6c02c), hex(0xf7f2e4)};
            return std::abs(p.y) > 0.965 ? hex(0xf7f2e4) : colors[static_cast<std::size_t>(uv.x * 5.9999)];
        }
        case 1:  // stars
            return std::min(uv.y, 1.0 - uv.y) > 0.2 && std::abs(uv.y - 0.5) < 0.1 ? hex(0xf6e9c8)
                   : glm::fract(6.0 * uv.x + 2.0 * uv.y) < 0.5                    ? hex(0x6a2c91)
                                                                                  : hex(0xf29ad0);
        case 2: {  // a swirl
            const double s = glm::fract(3.0 * uv.x + 1.6 * uv.y);
            return s < 0.33 ? hex(0x0fa3b1) : s < 0.66 ? hex(0xf9f7ef) : hex(0xf7a072);
        }
        case 3:  // squares
            return ((p.x > 0.0) != (p.y > 0.0)) != (p.z > 0.0) ? hex(0x18181c) : hex(0xf4f1e8);
        case 4: {  // spots
            const glm::dvec3 a = glm::abs(p);
            const double spot = std::max({a.x, a.y, a.z, (a.x + a.y + a.z) / std::sqrt(3.0)});
            return spot > 0.945 ? hex(0xfff6da) : hex(0x2f9e44);
        }
        default: {  // marbled
            const double v = std::sin(5.0 * p.x + 3.0 * std::sin(4.0 * p.y + 2.0 * p.z));
            return glm::mix(hex(0xd6283f), hex(0xffc94d), 0.5 + 0.5 * v);
        }
    }
}

}  // namespace

std::vector<DrawnTexture> make_gallery_surfaces() {
    std::vector<DrawnTexture> textures = {draw_texture("parquet", 320, 320, 2, color_parquet),
                                          draw_texture("marble", 192, 192, 2, color_marble),
                                          draw_texture("oak", 192, 128, 2, color_oak),
                                          draw_texture("weave", 96, 96, 2, color_weave),
                                          draw_texture("terracotta", 640, 256, 3, color_terracotta),
                                          draw_texture("top", 256, 192, 3, color_top)};
    for (int number = 0; number < 6; ++number) {
        textures.push_back(draw_texture(fmt::format("ball_{}", number).c_str(), 192, 96, 4,
                                        [&](const glm::dvec2& uv) { return color_ball(number, uv); }));
    }
    return textures;
}

}  // namespace aleph
