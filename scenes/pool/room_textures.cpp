#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/common/texture_tools.h"
#include "scenes/pool/pool_scene.h"

namespace aleph {

namespace {

glm::dvec3 color_felt(const glm::dvec2& uv) {
    // Short fibres that lie along the table, over broad wear.
    const double fibres = noise(uv * glm::dvec2(64, 160), {64, 160}, 11) - 0.5;
    const double broad = fractal_noise(uv, {4, 4}, 3, 12) - 0.5;
    return glm::dvec3(20, 92, 76) + glm::dvec3(14, 24, 20) * fibres + glm::dvec3(10, 20, 16) * broad;
}

/// Grain along u, between two colours.
double wood_grain(const glm::dvec2& uv, const glm::i64vec2& cells, std::uint32_t seed) {
    const double bend = fractal_noise(uv, {2, 4}, 3, seed);
    const double rings = 0.5 + 0.5 * std::sin(2.0 * pi * (static_cast<double>(cells.y) * 0.5 * uv.y + 2.5 * bend));
    const double pores = noise(uv * glm::dvec2(cells.x, 8 * cells.y), {cells.x, 8 * cells.y}, seed + 9);
    return 0.5 * rings + 0.25 * bend + 0.25 * pores;
}

glm::dvec3 color_rail(const glm::dvec2& uv) {
    return glm::mix(glm::dvec3(84, 38, 20), glm::dvec3(148, 78, 42), wood_grain(uv, {12, 8}, 21));
}

/// Eight rows of planks with different joints and tones.
glm::dvec3 color_floor(const glm::dvec2& uv) {
    const int rows = 8;
    const double across = uv.y * rows;
    const auto row = static_cast<std::int64_t>(across);
    const double along = glm::fract(uv.x + pick(31, row)) * 2.0;
    const auto plank = static_cast<std::int64_t>(along);
    const double tone = pick(32, plank, row);
    const double grain = noise({uv.x * 10.0, uv.y * 128.0}, {10, 128}, 33);
    const double edge = std::min(
        {glm::fract(across), 1.0 - glm::fract(across), 8.0 * glm::fract(along), 8.0 * (1.0 - glm::fract(along))});
    const glm::dvec3 wood = glm::mix(glm::dvec3(124, 82, 50), glm::dvec3(182, 132, 86), 0.7 * tone + 0.3 * grain);
    return edge < 0.045 ? 0.45 * wood : wood;
}

/// A leaf-shaped spot: 1 inside, 0 outside.
double leaf(const glm::dvec2& at, const glm::dvec2& center, double angle, double length, double width) {
    const glm::dvec2 d = at - center;
    const double along = (d.x * std::cos(angle) + d.y * std::sin(angle)) / length;
    const double aside = (d.y * std::cos(angle) - d.x * std::sin(angle)) / width;
    return std::abs(along) < 1.0 && std::abs(aside) < 1.0 - along * along ? 1.0 : 0.0;
}

/// Flowers of eight leaves in a half-drop repeat, thin stems between them.
glm::dvec3 color_wallpaper(const glm::dvec2& uv) {
    double flower = 0.0, heart = 0.0;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            for (const double half : {0.0, 0.5}) {
                const glm::dvec2 center(i + half + 0.25, j + half + 0.25);
                for (int k = 0; k < 8; ++k) {
                    const double angle = k * pi / 4.0, reach = k % 2 == 0 ? 0.125 : 0.095;
                    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
                    flower = std::max(flower, leaf(uv, center + reach * direction, angle, 0.085, 0.032));
                }
                if (glm::distance(uv, center) < 0.035) heart = 1.0;
            }
        }
    }
    const double wave = 0.05 * std::sin(4.0 * pi * uv.y);
    const double stem =
        std::min(std::abs(glm::fract(uv.x + wave) - 0.5), std::abs(glm::fract(uv.x + 0.5 - wave) - 0.5)) < 0.012;
    const double paper = fractal_noise(uv, {16, 16}, 2, 41) - 0.5;
    glm::dvec3 color(214, 192, 150);
    color = glm::mix(color, glm::dvec3(166, 150, 108), stem);
    color = glm::mix(color, glm::dvec3(122, 136, 104), flower);
    color = glm::mix(color, glm::dvec3(186, 88, 62), heart);
    return color + 8.0 * paper;
}

/// One raised panel with upright grain; u across, v down.
glm::dvec3 color_wainscot(const glm::dvec2& uv) {
    const glm::dvec3 wood =
        glm::mix(glm::dvec3(106, 66, 40), glm::dvec3(156, 104, 64), wood_grain({uv.y, uv.x}, {8, 6}, 51));
    const glm::dvec2 inset = 0.5 - glm::abs(uv - 0.5);
    const double distance = std::min(inset.x - 0.1, inset.y - 0.1);
    if (std::abs(distance) > 0.022) return wood;
    // The bevel: light from above falls on its lower side.
    const bool sideways = inset.x - 0.1 < inset.y - 0.1;
    const double light = sideways ? 0.78 : (uv.y > 0.5 ? 1.25 : 0.55);
    return light * wood;
}

glm::dvec3 color_sunset(const glm::dvec2& uv) {
    const double horizon = 0.62;
    const double ripple = fractal_noise({glm::fract(uv.x), uv.y}, {3, 14}, 4, 61) - 0.5;
    const double sun = glm::distance(uv * glm::dvec2(1.5, 1.0), glm::dvec2(0.98, 0.5));
    if (uv.y < horizon) {
        const double t = std::clamp(uv.y / horizon + 0.25 * ripple, 0.0, 1.0);
        const glm::dvec3 sky = glm::mix(glm::dvec3(44, 66, 128), glm::dvec3(238, 138, 74), t * t);
        return sun < 0.11 ? glm::dvec3(252, 226, 150)
                          : glm::mix(glm::dvec3(252, 200, 120), sky, std::min(1.0, 3.0 * sun));
    }
    const double t = (uv.y - horizon) / (1.0 - horizon);
    const double glint = std::abs(uv.x - 0.653) < 0.05 + 0.12 * t && ripple > 0.04 ? 1.0 : 0.0;
    return glm::mix(glm::mix(glm::dvec3(146, 92, 96), glm::dvec3(26, 44, 84), t) + 50.0 * ripple,
                    glm::dvec3(248, 196, 120), 0.8 * glint);
}

glm::dvec3 color_blocks(const glm::dvec2& uv) {
    struct Block {
        glm::dvec2 low, high;
        glm::dvec3 color;
    };
    static const Block blocks[] = {
        {{0.0, 0.0}, {0.32, 0.4}, {206, 44, 34}},     {{0.36, 0.0}, {1.0, 0.16}, {238, 232, 214}},
        {{0.36, 0.2}, {0.78, 0.62}, {238, 200, 60}},  {{0.82, 0.2}, {1.0, 0.62}, {236, 230, 212}},
        {{0.0, 0.44}, {0.32, 0.78}, {232, 226, 208}}, {{0.0, 0.82}, {0.32, 1.0}, {30, 70, 150}},
        {{0.36, 0.66}, {0.6, 1.0}, {234, 228, 210}},  {{0.64, 0.66}, {1.0, 1.0}, {36, 86, 166}}};
    for (const Block& block : blocks)
        if (uv.x >= block.low.x && uv.x < block.high.x && uv.y >= block.low.y && uv.y < block.high.y)
            return block.color;
    return {26, 24, 24};
}

glm::dvec3 color_circles(const glm::dvec2& uv) {
    const glm::dvec2 cell = glm::floor(uv * 3.0), at = uv * 3.0 - cell - 0.5;
    const auto color = [&](int ring) {
        static const glm::dvec3 palette[] = {{206, 60, 44},  {240, 186, 66}, {32, 84, 120}, {232, 222, 196},
                                             {70, 130, 110}, {224, 126, 60}, {84, 50, 96}};
        const double value = pick(71, static_cast<std::int64_t>(cell.x) * 3 + ring, static_cast<std::int64_t>(cell.y));
        return palette[static_cast<int>(7.0 * value)];
    };
    const double distance = glm::length(at) * (1.0 + 0.12 * (noise(uv * 12.0, {12, 12}, 72) - 0.5));
    return distance > 0.46 ? color(0) : color(distance > 0.3 ? 1 : 2) * (distance < 0.13 ? 0.5 : 1.0);
}

/// An hour after sunset: warm over dark hills, blue above, thin clouds.
glm::dvec3 color_sky(const glm::dvec2& uv) {
    const double hills = 0.86 + 0.07 * (fractal_noise({uv.x, 0.5}, {3, 1}, 4, 81) - 0.5) + 0.02 * std::sin(5.0 * uv.x);
    if (uv.y > hills)
        return glm::mix(glm::dvec3(66, 62, 84), glm::dvec3(34, 40, 50), std::min(1.0, (uv.y - hills) / 0.1));
    const double height = 1.0 - uv.y / hills;  // 0 at the hills
    glm::dvec3 sky = glm::mix(glm::dvec3(250, 196, 142), glm::dvec3(208, 190, 196), glm::smoothstep(0.0, 0.3, height));
    sky = glm::mix(sky, glm::dvec3(96, 140, 204), glm::smoothstep(0.15, 1.0, height));
    const double cloud = fractal_noise(uv, {2, 9}, 4, 82);
    return glm::mix(sky, glm::dvec3(246, 206, 186), 0.5 * glm::smoothstep(0.52, 0.8, cloud) * (1.0 - 0.6 * height));
}

}  // namespace

std::vector<DrawnTexture> make_room_textures() {
    return {draw_texture("felt", 256, 256, 1, color_felt),
            draw_texture("rail", 512, 64, 2, color_rail),
            draw_texture("floor", 256, 256, 2, color_floor),
            draw_texture("wallpaper", 256, 256, 3, color_wallpaper),
            draw_texture("wainscot", 192, 256, 2, color_wainscot),
            draw_texture("sunset", 192, 128, 3, color_sunset),
            draw_texture("blocks", 96, 128, 3, color_blocks),
            draw_texture("circles", 144, 144, 3, color_circles),
            draw_texture("sky", 160, 144, 2, color_sky)};
}

}  // namespace aleph
