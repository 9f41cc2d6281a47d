// Paintings made of overlapping strokes and marks.

#include <array>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

/// Strokes that follow a field of directions, long and thin, from dark to light.
DrawnTexture paint_flow() {
    Canvas canvas(420, 420, hex(0x10202e));
    const std::array colors = {hex(0x123a5a), hex(0x1d6f8c), hex(0x37a6a0), hex(0xf2d16b),
                               hex(0xf08a4b), hex(0xe2503f), hex(0xf6efe0)};
    for (int i = 0; i < 2600; ++i) {
        glm::dvec2 at(pick(1, i) * 420.0, pick(2, i) * 420.0);
        const double tone = 0.75 * fractal_noise(at / 420.0, {3, 3}, 2, 40) + 0.25 * pick(3, i);
        const glm::dvec3 color = gradient(colors, std::clamp((tone - 0.25) * 2.0, 0.0, 1.0)) * (0.8 + 0.4 * pick(4, i));
        const double width = 0.7 + 1.5 * pick(5, i) * pick(6, i);
        for (int step = 0; step < 46; ++step) {
            const double angle = 4.4 * pi * fractal_noise(at / 420.0, {2, 2}, 2, 7);
            const double taper = std::sin(pi * (step + 1.0) / 47.0);
            const glm::dvec2 next = at + 1.6 * glm::dvec2(std::cos(angle), std::sin(angle));
            canvas.line(at, next, width * taper, color, 0.55);
            at = next;
        }
    }
    return canvas.finish("flow");
}

/// Discs that do not touch, large ones first, each with a ring or a half in a second colour.
DrawnTexture paint_packing() {
    Canvas canvas(300, 380, hex(0xf1e8d6));
    const std::array colors = {hex(0xd1495b), hex(0xedae49), hex(0x00798c), hex(0x30638e),
                               hex(0x003d5b), hex(0xe9d8a6), hex(0x8ab17d)};
    std::vector<glm::dvec3> placed;  // x, y, radius
    for (int i = 0; i < 9000; ++i) {
        const glm::dvec2 at(pick(11, i) * 300.0, pick(12, i) * 380.0);
        double radius = i < 30 ? 58.0 : i < 300 ? 30.0 : 14.0;
        for (const glm::dvec3& other : placed)
            radius = std::min(radius, glm::distance(at, glm::dvec2(other)) - other.z - 2.0);
        if (radius < 2.2) continue;
        placed.emplace_back(at, radius);
        const auto color = [&](int k) { return colors[static_cast<std::size_t>(pick(13, i, k) * colors.size())]; };
        canvas.disc(at, radius, color(0));
        if (pick(14, i) < 0.45) canvas.disc(at, 0.62 * radius, color(1));
        if (pick(15, i) < 0.4) canvas.disc(at, 0.3 * radius, hex(0xf1e8d6));
    }
    return canvas.finish("packing");
}

/// Ridges behind one another in mist, a low sun.
DrawnTexture paint_ridges() {
    const int width = 480, height = 260;
    Canvas canvas(width, height, hex(0x000000));
    const std::array sky = {hex(0x2f4b7c), hex(0x8f7aa5), hex(0xf2a07b), hex(0xfbd9a0), hex(0xfdeecb)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) canvas.at(x, y) = gradient(sky, y / (0.62 * height));
    canvas.disc({330.0, 112.0}, 46.0, hex(0xfdf0cf), 0.35);
    canvas.disc({330.0, 112.0}, 27.0, hex(0xfff8e4));
    for (int ridge = 0; ridge < 7; ++ridge) {
        const double depth = ridge / 6.0;
        const glm::dvec3 color = glm::mix(hex(0xe0a68e), hex(0x14213d), std::pow(depth, 0.75));
        for (int x = 0; x < width; ++x) {
            const double u = x / static_cast<double>(width);
            const double top =
                (0.42 + 0.5 * depth * depth + 0.04 * depth) * height -
                (44.0 + 26.0 * depth) * (fractal_noise({u, 0.37 * ridge}, {4 + 2 * ridge, 8}, 5, 21u + ridge) - 0.25);
            for (int y = std::max(0, static_cast<int>(top)); y < height; ++y) {
                const double mist = 0.55 * std::exp(-(height - y) / 90.0) * (1.0 - depth);
                const double edge = std::clamp(y + 1.0 - top, 0.0, 1.0);
                canvas.at(x, y) = glm::mix(canvas.at(x, y), glm::mix(color, hex(0xf6c9a4), mist), edge);
            }
        }
    }
    // A flight of birds.
    for (int i = 0; i < 9; ++i) {
        const glm::dvec2 at(120.0 + 13.0 * i + 8.0 * pick(28, i), 62.0 + 5.0 * std::abs(i - 3) + 6.0 * pick(29, i));
        canvas.line(at, at + glm::dvec2(-5.0, -3.0), 0.7, hex(0x2b2d42));
        canvas.line(at, at + glm::dvec2(5.0, -3.5), 0.7, hex(0x2b2d42));
    }
    return canvas.finish("ridges");
}

/// The curve of two damped pendulums with frequencies 3 : 2.
DrawnTexture paint_harmonograph() {
    Canvas canvas(320, 320, hex(0x1b1725));
    const std::array colors = {hex(0xff5d8f), hex(0xffb86b), hex(0xfff1a8), hex(0x7bdff2), hex(0xb388eb)};
    glm::dvec2 last(0.0);
    const int count = 14000;
    for (int i = 0; i <= count; ++i) {
        const double t = i * 0.008, fade = std::exp(-0.0115 * t);
        const glm::dvec2 at = glm::dvec2(160.0) + 140.0 * fade *
                                                      glm::dvec2(std::sin(3.0 * t + 0.6) * std::cos(0.011 * t),
                                                                 std::sin(2.003 * t + 0.2) * std::cos(0.008 * t + 0.3));
        if (i > 0) canvas.line(last, at, 0.55, gradient(colors, static_cast<double>(i) / count), 0.5);
        last = at;
    }
    return canvas.finish("harmonograph");
}

/// Seeds of a sunflower at the golden angle.
DrawnTexture paint_phyllotaxis() {
    Canvas canvas(320, 320, hex(0x143642));
    const std::array colors = {hex(0xfff3b0), hex(0xf9c74f), hex(0xf8961e), hex(0xd1495b), hex(0x6a2c70)};
    const double golden = pi * (3.0 - std::sqrt(5.0));
    for (int i = 620; i >= 1; --i) {
        const double reach = 6.15 * std::sqrt(i), angle = golden * i;
        const glm::dvec2 at = glm::dvec2(160.0) + reach * glm::dvec2(std::cos(angle), std::sin(angle));
        const double size = 1.6 + 3.6 * reach / 153.0;
        canvas.disc(at, size, 0.5 * gradient(colors, reach / 153.0));
        canvas.disc(at - 0.22 * size, 0.78 * size, gradient(colors, reach / 153.0));
    }
    return canvas.finish("phyllotaxis");
}

/// A city at night: towers, lit windows, and their light in the water.
DrawnTexture paint_city() {
    const int width = 400, height = 280, shore = 196;
    Canvas canvas(width, height, hex(0x000000));
    const std::array sky = {hex(0x0b132b), hex(0x1c2541), hex(0x5b4b8a), hex(0xe07a5f)};
    for (int y = 0; y < shore; ++y)
        for (int x = 0; x < width; ++x) canvas.at(x, y) = gradient(sky, y / static_cast<double>(shore));
    for (int i = 0; i < 70; ++i) canvas.disc({400.0 * pick(31, i), 90.0 * pick(32, i)}, 0.5, hex(0xf4f1de), 0.8);
    canvas.disc({72.0, 48.0}, 17.0, hex(0xf4f1de));
    canvas.disc({79.0, 44.0}, 15.0, hex(0x141d38));
    for (int layer = 0; layer < 3; ++layer) {
        for (int i = 0; i < 26; ++i) {
            const double x = 400.0 * (i + 0.6 * pick(33, i, layer)) / 26.0 - 8.0, w = 12.0 + 16.0 * pick(34, i, layer);
            const double tall = (42.0 + 88.0 * pick(35, i, layer)) * (1.0 - 0.24 * layer);
            const glm::dvec3 wall = glm::mix(hex(0x3d3b62), hex(0x0e1024), 0.5 * layer);
            for (int py = static_cast<int>(shore - tall); py < shore; ++py) {
                for (int px = std::max(0, static_cast<int>(x)); px < std::min(width, static_cast<int>(x + w)); ++px) {
                    const int column = (px - static_cast<int>(x)), row = py - static_cast<int>(shore - tall);
                    const bool window = column % 4 >= 2 && column > 1 && column < w - 2 && row % 5 >= 2 && row > 3;
                    const bool lit =
                        window && pick(36u + static_cast<std::uint32_t>(layer), i * 50 + column / 4, row / 5) < 0.4;
                    canvas.at(px, py) =
                        lit ? glm::mix(hex(0xffd97d), hex(0xfff4d6), pick(39, column / 4, row / 5)) : wall;
                }
            }
        }
    }
    for (int y = shore; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double down = y - shore;
            const double sway =
                5.0 * (fractal_noise({x / 400.0, down / 84.0}, {6, 26}, 2, 45) - 0.5) * (0.3 + down / 30.0);
            const int sx = std::clamp(static_cast<int>(x + sway), 0, width - 1);
            const int sy = std::clamp(static_cast<int>(shore - 1.0 - 1.7 * down - 2.0 * sway), 0, shore - 1);
            canvas.at(x, y) = glm::mix(canvas.at(sx, sy) * 0.72, hex(0x101a38), 0.25 + 0.3 * down / 84.0);
        }
    }
    return canvas.finish("city");
}

}  // namespace

std::vector<DrawnTexture> make_painted_pictures() {
    return {paint_flow(), paint_packing(), paint_ridges(), paint_harmonograph(), paint_phyllotaxis(), paint_city()};
}

}  // namespace aleph
