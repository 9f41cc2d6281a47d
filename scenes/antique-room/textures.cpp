#include <array>

#include "scenes/antique-room/antique_room.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

/// Six rows of long dark boards.
glm::dvec3 color_boards(const glm::dvec2& uv) {
    const double across = uv.y * 6.0;
    const auto row = static_cast<std::int64_t>(across);
    const double along = glm::fract(uv.x + pick(201, row)) * 2.0;
    const double tone = pick(202, static_cast<std::int64_t>(along), row);
    const double bend = fractal_noise(uv, {4, 6}, 3, 203);
    const double grain = noise({uv.x * 12.0, glm::fract(uv.y + 0.02 * bend) * 160.0}, {12, 160}, 204);
    const double edge = std::min(
        {glm::fract(across), 1.0 - glm::fract(across), 9.0 * glm::fract(along), 9.0 * (1.0 - glm::fract(along))});
    const glm::dvec3 wood = glm::mix(hex(0x5c361e), hex(0xa0683c), 0.55 * tone + 0.3 * grain + 0.15 * bend);
    return wood * (edge < 0.035 ? 0.4 : 1.0);
}

/// Grain along u with the odd burl.
glm::dvec3 color_walnut(const glm::dvec2& uv) {
    const double bend = fractal_noise(uv, {2, 3}, 4, 211);
    const double rings = 0.5 + 0.5 * std::sin(2.0 * pi * (5.0 * uv.y + 3.2 * bend));
    const double pores = noise(uv * glm::dvec2(10, 110), {10, 110}, 212);
    return glm::mix(hex(0x5a3019), hex(0xab6a3a), 0.5 * rings + 0.3 * pores + 0.2 * bend);
}

/// Ogees with a palmette in each, two greens.
glm::dvec3 color_damask(const glm::dvec2& uv) {
    const glm::dvec3 ground = hex(0x46695a), figure = hex(0x7b9a7a);
    double cover = 0.0;
    for (const double half : {0.0, 0.5}) {
        const glm::dvec2 at(std::abs(glm::fract(uv.x + half) - 0.5), glm::fract(uv.y + half) - 0.5);
        // A leaf of nine lobes around the middle of each ogee.
        const double reach = glm::length(at * glm::dvec2(1.25, 0.82)), angle = std::atan2(at.x, at.y + 0.1);
        const double lobes = 0.165 + 0.045 * std::cos(9.0 * angle) - 0.03 * std::cos(3.0 * angle);
        if (reach < lobes && reach > 0.42 * lobes) cover = 1.0;
        if (reach < 0.24 * lobes) cover = 1.0;
        if (std::abs(at.x - 0.25 - 0.17 * std::sin(2.0 * pi * (glm::fract(uv.y + half) + 0.25))) < 0.012)
            cover = std::max(cover, 0.75);
    }
    const double silk = noise({uv.x * 160.0, uv.y * 12.0}, {160, 12}, 221) - 0.5;
    return glm::mix(ground, figure, cover) + 9.0 * silk;
}

/// Border, guard stripes, a field of small flowers and a medallion, with two axes of symmetry.
glm::dvec3 color_rug(const glm::dvec2& uv) {
    const glm::dvec2 size(3.0, 2.0);
    const glm::dvec2 at = glm::abs(uv - 0.5) * size;
    const double inset = std::min(0.5 * size.x - at.x, 0.5 * size.y - at.y);
    const double wool = fractal_noise(uv, {90, 60}, 2, 231) - 0.5;
    const glm::dvec3 red = hex(0x8c2323), blue = hex(0x1f2f52), ivory = hex(0xe6d6b4), gold = hex(0xc0893c),
                     teal = hex(0x3c6a68);
    const auto flower = [](const glm::dvec2& p, double scale, int petals) {
        const double angle = std::atan2(p.y, p.x);
        return glm::length(p) / scale - (0.72 + 0.28 * std::cos(petals * angle));
    };
    const auto cell = [](const glm::dvec2& p, double step) { return (p / step - glm::floor(p / step) - 0.5) * step; };
    glm::dvec3 color = red;
    if (inset < 0.02) {
        color = ivory * 0.9;
    } else if (inset < 0.06 || (inset > 0.27 && inset < 0.31)) {
        color = glm::fract((at.x + at.y) * 14.0) < 0.5 ? gold : blue;
    } else if (inset < 0.27) {
        const glm::dvec2 p = cell(at + glm::dvec2(0.0, 0.065), 0.2);
        const double f = flower(p, 0.085, 8);
        color = f < -0.55 ? gold : f < 0.0 ? ivory : f < 0.18 ? red : blue;
    } else {
        const double angle = std::atan2(at.y, at.x);
        const double medallion = glm::length(at * glm::dvec2(0.78, 1.1)) - 0.4 - 0.055 * std::cos(12.0 * angle);
        const double corner = glm::distance(at, glm::dvec2(1.19, 0.69)) - 0.36 - 0.03 * std::cos(10.0 * angle);
        if (medallion < 0.0) {
            const double star = glm::length(at) - 0.17 - 0.05 * std::cos(8.0 * angle);
            const double f = flower(cell(at, 0.11), 0.04, 6);
            color = medallion > -0.03 ? gold
                    : star < -0.11    ? red
                    : star < 0.0      ? ivory
                    : star < 0.02     ? gold
                    : f < 0.0         ? gold
                                      : blue;
        } else if (corner < 0.0) {
            color = corner > -0.025 ? gold : flower(cell(at, 0.12), 0.045, 6) < 0.0 ? ivory : teal;
        } else {
            const double f = flower(cell(at + glm::dvec2(0.07, 0.07), 0.14), 0.05, 5);
            color = f < -0.5 ? blue : f < 0.0 ? gold : f < 0.12 ? blue : red;
        }
    }
    return color + 26.0 * wool;
}

/// Ten past ten; strokes for hours, dots for minutes.
glm::dvec3 color_dial(const glm::dvec2& uv) {
    const glm::dvec2 p = (uv - 0.5) * 2.0;
    const double reach = glm::length(p), angle = std::atan2(p.x, -p.y);
    const auto hand = [](double turn, double length) { return length * glm::dvec2(std::sin(turn), -std::cos(turn)); };
    const glm::dvec3 ink = hex(0x1c1a22), cream = hex(0xf3ead2), brass = hex(0xb8863c);
    if (reach > 0.97) return brass;
    if (distance_to_segment(p, hand(2.0 * pi * (10.0 + 1.0 / 6.0) / 12.0, -0.1),
                            hand(2.0 * pi * (10.0 + 1.0 / 6.0) / 12.0, 0.42)) < 0.03)
        return ink;
    if (distance_to_segment(p, hand(2.0 * pi / 6.0, -0.12), hand(2.0 * pi / 6.0, 0.66)) < 0.02) return ink;
    if (reach < 0.05) return brass;
    const double hour = std::round(angle * 6.0 / pi), minute = std::round(angle * 30.0 / pi);
    const double from_hour = std::abs(angle - hour * pi / 6.0) * reach;
    if (reach > 0.62 && reach < 0.82 && from_hour < (static_cast<int>(hour + 12.0) % 3 == 0 ? 0.035 : 0.018))
        return ink;
    if (std::abs(reach - 0.88) < 0.02 && std::abs(angle - minute * pi / 30.0) * reach < 0.014) return ink;
    if (std::abs(reach - 0.93) < 0.006 || std::abs(reach - 0.58) < 0.006) return brass;
    return cream - 12.0 * reach * reach;
}

/// An old globe: seas of faded blue, land of ochre, a net of degrees.
glm::dvec3 color_globe(const glm::dvec2& uv) {
    const double land = fractal_noise(uv, {5, 3}, 5, 241) + 0.1 * std::cos(2.0 * pi * (uv.y - 0.5)) - 0.05;
    const double cloud = fractal_noise(uv, {8, 4}, 4, 242) - 0.5;
    const glm::dvec3 sea = hex(0x7fa39a) + 30.0 * cloud;
    const glm::dvec3 ground =
        glm::mix(hex(0xd9b36c), hex(0x9a6a3a), std::clamp((land - 0.54) * 7.0, 0.0, 1.0)) + 24.0 * cloud;
    const bool net = std::min(glm::fract(uv.x * 24.0), 1.0 - glm::fract(uv.x * 24.0)) < 0.03 ||
                     std::min(glm::fract(uv.y * 12.0), 1.0 - glm::fract(uv.y * 12.0)) < 0.03;
    glm::dvec3 color = land > 0.54 ? ground : sea;
    if (std::abs(land - 0.54) < 0.006) color = hex(0x4a3320);
    if (uv.y < 0.05 || uv.y > 0.95) color = hex(0xe8dfc6);
    return net ? color * 0.72 : color;
}

/// A book spine: raised bands and a label, tinted by the base colour.
glm::dvec3 color_spine(const glm::dvec2& uv) {
    const double wear = fractal_noise(uv, {6, 24}, 3, 251) - 0.5;
    const double band = std::abs(glm::fract(uv.y * 6.0) - 0.5);
    const double round = 0.72 + 0.28 * std::sin(pi * uv.x);
    if (uv.y > 0.17 && uv.y < 0.3) return hex(0xf2d79a) * (uv.y < 0.185 || uv.y > 0.285 ? 0.6 : 1.0) * round;
    return (glm::dvec3(176.0) + 40.0 * wear) * round * (band < 0.05 ? 1.35 : 1.0);
}

glm::dvec3 color_stone(const glm::dvec2& uv) {
    const double bend = fractal_noise(uv, {2, 2}, 4, 261);
    const double vein = std::pow(1.0 - std::abs(std::sin(2.0 * pi * (uv.x - uv.y) + 8.0 * bend)), 6.0);
    return hex(0xe4ded2) + 22.0 * (fractal_noise(uv, {4, 4}, 4, 262) - 0.5) - glm::dvec3(60, 70, 74) * vein;
}

glm::dvec3 color_velvet(const glm::dvec2& uv) {
    const double nap = fractal_noise(uv, {10, 10}, 4, 271) - 0.5;
    const double stripe = std::abs(glm::fract(uv.x * 4.0) - 0.5) < 0.1 ? 1.15 : 1.0;
    return (glm::dvec3(190.0) + 60.0 * nap) * stripe;
}

/// A ship under full sail in front of dark clouds.
glm::dvec3 color_ship(const glm::dvec2& uv) {
    const double cloud = fractal_noise(uv, {3, 5}, 5, 281);
    glm::dvec3 color = glm::mix(hex(0x6f8fa3), hex(0xf0d9b0), std::clamp(1.5 * uv.y + 1.4 * (cloud - 0.5), 0.0, 1.0));
    const double wave = 0.7 + 0.012 * std::sin(26.0 * uv.x + 5.0 * cloud);
    const auto inside = [&](const glm::dvec2& middle, const glm::dvec2& size, double belly) {
        const glm::dvec2 d = (uv - middle) / size;
        return std::abs(d.y) < 1.0 && d.x > -1.0 + belly * (1.0 - d.y * d.y) && d.x < 1.0 + belly * (1.0 - d.y * d.y);
    };
    const double hull = (uv.x - 0.5) / 0.2;
    if (std::abs(hull) < 1.0 && uv.y > 0.655 - 0.03 * hull * hull && uv.y < 0.735 - 0.05 * std::abs(hull * hull * hull))
        color = uv.y < 0.675 ? hex(0xc79a52) : hex(0x33211a);
    for (const double mast : {0.38, 0.5, 0.61}) {
        const double top = mast == 0.5 ? 0.16 : 0.24;
        if (std::abs(uv.x - mast) < 0.004 && uv.y > top && uv.y < 0.66) color = hex(0x3a281c);
        for (int i = 0; i < 3; ++i) {
            const double y = top + 0.08 + 0.145 * i * (0.64 - top) / 0.48, width = 0.03 + 0.012 * i;
            if (inside({mast, y}, {width, 0.055}, 0.35))
                color = glm::mix(hex(0xfaf0d7), hex(0xb99f78), std::clamp((uv.x - mast) / 0.08 + 0.4, 0.0, 1.0));
        }
    }
    if (uv.y > wave) {
        const double foam = fractal_noise(uv, {6, 30}, 4, 282);
        const double deep = (uv.y - wave) / 0.3;
        color = glm::mix(hex(0x5f8583), hex(0x16302f), deep) + 60.0 * std::max(0.0, foam - 0.56) * 3.0;
    }
    return color * (0.86 + 0.2 * fractal_noise(uv, {40, 30}, 2, 283));
}

/// Fields and a river between hills, trees in front.
glm::dvec3 color_valley(const glm::dvec2& uv) {
    const double cloud = fractal_noise(uv, {4, 6}, 5, 291);
    glm::dvec3 color = glm::mix(hex(0x8fb0c9), hex(0xf7e2bb), std::clamp(2.0 * uv.y + 1.2 * (cloud - 0.5), 0.0, 1.0));
    const std::array hills = {hex(0x9fb0b4), hex(0x7f9a86), hex(0x6d8f52), hex(0x55743a), hex(0x344a26)};
    for (std::size_t i = 0; i < hills.size(); ++i) {
        const double depth = static_cast<double>(i) / 4.0;
        const double top = 0.42 + 0.38 * depth * depth + 0.06 * depth -
                           0.15 * (fractal_noise({uv.x, 0.3 * depth}, {3 + static_cast<int>(i), 4}, 3,
                                                 292u + static_cast<std::uint32_t>(i)) -
                                   0.4);
        if (uv.y > top)
            color = hills[i] * (1.12 - 0.9 * (uv.y - top)) + 26.0 * (fractal_noise(uv, {24, 40}, 3, 297) - 0.5);
    }
    const double bed = 0.55 + 0.16 * std::sin(7.0 * uv.y) * (1.1 - uv.y),
                 width = 0.012 + 0.16 * (uv.y - 0.52) * (uv.y - 0.52);
    if (uv.y > 0.53 && uv.y < 0.86 && std::abs(uv.x - bed) < width)
        color = glm::mix(hex(0xd9e3df), hex(0x8fb0c9), uv.y);
    for (int i = 0; i < 5; ++i) {
        const glm::dvec2 crown(0.06 + 0.05 * i + (i > 2 ? 0.62 : 0.0), 0.6 + 0.05 * pick(298, i));
        const glm::dvec2 d = (uv - crown) / glm::dvec2(0.065, 0.15);
        const double edge = 0.75 + 0.5 * fractal_noise(uv, {20, 16}, 3, 299);
        if (std::abs(uv.x - crown.x) < 0.006 && uv.y > crown.y && uv.y < 0.95) color = hex(0x3b2a1a);
        if (glm::length(d) < edge)
            color = glm::mix(hex(0x7a8f3e), hex(0x25381c), std::clamp(0.5 + 0.6 * (d.x + d.y), 0.0, 1.0)) +
                    30.0 * (edge - 1.0);
    }
    return color;
}

/// A park under a summer sky, as a window shows it: trees far and near, a lawn.
glm::dvec3 color_garden(const glm::dvec2& uv) {
    const double cloud = std::clamp(3.0 * (fractal_noise(uv * glm::dvec2(1.0, 1.6), {3, 8}, 5, 311) - 0.5), 0.0, 1.0);
    glm::dvec3 color = glm::mix(hex(0x8fb4dc), hex(0xd9e4ea), std::clamp(1.35 * uv.y, 0.0, 1.0));
    color = glm::mix(color, hex(0xf6f2ea), 0.85 * cloud);
    struct Row {
        double top, rough;
        glm::dvec3 light, dark;
    };
    const Row rows[] = {{0.61, 0.05, hex(0xa9bcc0), hex(0x98adb0)},
                        {0.63, 0.16, hex(0x8fa687), hex(0x6c8768)},
                        {0.68, 0.3, hex(0x758f4c), hex(0x42592c)}};
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const Row& row = rows[i];
        const auto seed = 312u + 4u * static_cast<std::uint32_t>(i);
        const double crowns = noise({uv.x * (5.0 + static_cast<double>(i)), 0.0}, {5 + static_cast<int>(i), 1}, seed);
        const double leaves = fractal_noise(uv, {18, 24}, 3, seed + 1u);
        const double top = row.top - row.rough * (crowns - 0.35) - 0.35 * row.rough * (leaves - 0.5);
        if (uv.y > top)
            color = glm::mix(row.light, row.dark, std::clamp(3.0 * (uv.y - top) + 1.6 * (leaves - 0.45), 0.0, 1.0));
    }
    if (uv.y > 0.78) {
        const double mown = fractal_noise(uv, {6, 60}, 3, 330);
        color = glm::mix(hex(0x9fb56a), hex(0x6d8a3e), std::clamp((uv.y - 0.78) / 0.22 + mown - 0.5, 0.0, 1.0));
        if (uv.y < 0.79 + 0.006 * mown) color = hex(0x55702f);
    }
    return color;
}

/// An iris on old paper.
glm::dvec3 color_iris(const glm::dvec2& uv) {
    const double stain = fractal_noise(uv, {4, 6}, 4, 305) - 0.5;
    glm::dvec3 color = hex(0xeadfc4) + 24.0 * stain;
    const glm::dvec2 p((uv.x - 0.5) * 0.75, uv.y);
    const auto leaf = [&](double x, double bend, double low, double high, double width) {
        const double t = (p.y - high) / (low - high);
        return t > 0.0 && t < 1.0 &&
               std::abs(p.x - x - bend * (1.0 - t) * (1.0 - t)) < width * std::sqrt(t) * (1.25 - t);
    };
    if (leaf(0.02, -0.16, 0.95, 0.46, 0.034) || leaf(-0.02, 0.2, 0.95, 0.52, 0.03))
        color = hex(0x5d7a4a) + 30.0 * stain;
    if (leaf(0.03, 0.1, 0.95, 0.6, 0.026)) color = hex(0x7f9a5e);
    if (leaf(0.0, 0.01, 0.95, 0.36, 0.011)) color = hex(0x566f40);
    const glm::dvec2 d = p - glm::dvec2(0.01, 0.3);
    const double angle = std::atan2(d.x, -d.y), reach = glm::length(d);
    const double petal = std::pow(std::abs(std::cos(1.5 * angle)), 0.6) * (std::abs(angle) < 0.6 ? 0.16 : 0.19);
    if (reach < petal) {
        const double vein = 0.5 + 0.5 * std::cos(34.0 * angle);
        color = glm::mix(hex(0x4a3a8c), hex(0x9a86cf), std::clamp(reach / 0.18 + 0.25 * vein - 0.1, 0.0, 1.0));
        if (std::abs(std::sin(1.5 * angle)) < 0.28 && reach < 0.1 && std::abs(angle) > 0.6) color = hex(0xe2b23a);
    }
    return color;
}

}  // namespace

std::vector<DrawnTexture> make_antique_textures() {
    return {draw_texture("boards", 320, 256, 2, color_boards), draw_texture("walnut", 256, 128, 2, color_walnut),
            draw_texture("damask", 192, 192, 3, color_damask), draw_texture("rug", 480, 320, 3, color_rug),
            draw_texture("dial", 192, 192, 3, color_dial),     draw_texture("globe", 384, 192, 2, color_globe),
            draw_texture("spine", 48, 160, 2, color_spine),    draw_texture("stone", 160, 160, 2, color_stone),
            draw_texture("velvet", 128, 128, 2, color_velvet), draw_texture("ship", 320, 240, 2, color_ship),
            draw_texture("valley", 320, 224, 2, color_valley), draw_texture("iris", 168, 224, 3, color_iris),
            draw_texture("garden", 240, 280, 2, color_garden)};
}

}  // namespace aleph
