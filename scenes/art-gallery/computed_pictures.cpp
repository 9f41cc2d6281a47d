// Paintings computed point by point.

#include <array>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

/// The outside of a filled Julia set, coloured by escape time.
glm::dvec3 color_julia(const glm::dvec2& uv) {
    static const std::array colors = {hex(0x0d1b2a), hex(0x1b3a5c), hex(0x3f7cac), hex(0x95d0c5),
                                      hex(0xfaf3dd), hex(0xf4a259), hex(0xbc4b51), hex(0x3a0f2b)};
    glm::dvec2 z((uv.x - 0.5) * 3.1, (uv.y - 0.5) * 2.1);
    const glm::dvec2 c(-0.7454, 0.1130);
    for (int i = 0; i < 160; ++i) {
        const double size = glm::dot(z, z);
        if (size > 64.0) return gradient(colors, std::pow((i - std::log2(0.5 * std::log2(size))) / 160.0, 0.45));
        z = glm::dvec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
    }
    return hex(0x140710);
}

/// Quarter circles that join into bands, two sizes of tile.
glm::dvec3 color_truchet(const glm::dvec2& uv) {
    static const std::array bands = {hex(0x264653), hex(0x2a9d8f), hex(0xe9c46a), hex(0xf4a261), hex(0xe76f51)};
    const glm::dvec2 grid = uv * glm::dvec2(6.0, 8.0);
    const glm::dvec2 cell = glm::floor(grid);
    glm::dvec2 at = grid - cell;
    if (pick(51, static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y)) < 0.5) at.x = 1.0 - at.x;
    const double reach = std::min(glm::length(at), glm::distance(at, glm::dvec2(1.0)));
    const double band = std::abs(reach - 0.5);
    const double tone = fractal_noise(uv, {2, 3}, 2, 52);
    if (band > 0.27) return hex(0xf7f0e3);
    if (band > 0.23) return hex(0x2b2b2b);
    const double across = (reach - 0.27) / 0.46;
    return bands[static_cast<std::size_t>(std::clamp(std::floor(across * 3.0) + 2.6 * tone, 0.0, 4.0))];
}

/// Soft fields of one colour on another, brushed.
glm::dvec3 color_fields(const glm::dvec2& uv) {
    const double brush = fractal_noise(uv, {5, 60}, 3, 61) - 0.5, cloud = fractal_noise(uv, {3, 4}, 4, 62) - 0.5;
    struct Field {
        double low, high;
        glm::dvec3 color;
    };
    static const Field fields[] = {
        {0.06, 0.40, hex(0xf2a33a)}, {0.45, 0.60, hex(0xf7d9a0)}, {0.645, 0.94, hex(0x7d1128)}};
    glm::dvec3 color = hex(0xb8321f) + 26.0 * cloud + 10.0 * brush;
    for (const Field& field : fields) {
        const double rough = 0.012 * (fractal_noise(uv, {9, 12}, 3, 63) - 0.5) * 3.0;
        const auto soft = [&](double inside) { return glm::smoothstep(-0.012, 0.022, inside + rough); };
        const double cover = soft(uv.y - field.low) * soft(field.high - uv.y) * soft(uv.x - 0.07) * soft(0.93 - uv.x);
        color = glm::mix(color, field.color + 34.0 * cloud + 20.0 * brush, 0.93 * cover);
    }
    return color;
}

/// Noise warped twice by noise: veins of poured paint.
glm::dvec3 color_pour(const glm::dvec2& uv) {
    static const std::array colors = {hex(0x0b0c2a), hex(0x27187e), hex(0x6a4c93), hex(0xf06292),
                                      hex(0xffd6c0), hex(0xffffff), hex(0x48bfe3), hex(0x064789)};
    const auto wrap = [](const glm::dvec2& p) { return p - glm::floor(p); };
    const glm::dvec2 once(fractal_noise(uv, {3, 3}, 4, 71), fractal_noise(uv, {3, 3}, 4, 72));
    const glm::dvec2 moved = wrap(uv + 0.55 * once);
    const glm::dvec2 twice(fractal_noise(moved, {3, 3}, 4, 73), fractal_noise(moved, {3, 3}, 4, 74));
    const double value = fractal_noise(wrap(uv + 0.7 * twice), {4, 4}, 4, 75);
    return gradient(colors, glm::fract(2.2 * value + 0.6 * once.x));
}

/// Leaded glass: the panes are the cells of scattered points.
glm::dvec3 color_panes(const glm::dvec2& uv) {
    static const std::array colors = {hex(0x1d3557), hex(0x457b9d), hex(0xa8dadc), hex(0xe63946),
                                      hex(0xf4a261), hex(0xffe066), hex(0x2a9d8f), hex(0x8338ec)};
    const glm::dvec2 grid = uv * glm::dvec2(9.0, 12.0);
    double nearest = 9.0, second = 9.0;
    glm::i64vec2 pane(0);
    glm::dvec2 middle(0.0);
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            const glm::i64vec2 cell = glm::i64vec2(glm::floor(grid)) + glm::i64vec2(i, j);
            const glm::dvec2 point =
                glm::dvec2(cell) + 0.15 + 0.7 * glm::dvec2(pick(81, cell.x, cell.y), pick(82, cell.x, cell.y));
            const double distance = glm::distance(grid, point);
            if (distance < nearest) {
                second = nearest;
                nearest = distance;
                pane = cell;
                middle = point;
            } else {
                second = std::min(second, distance);
            }
        }
    }
    if (second - nearest < 0.07) return hex(0x16161a);
    // A sun of warm panes in the middle, cool ones around it.
    const double reach = glm::distance(middle / glm::dvec2(9.0, 12.0), glm::dvec2(0.5, 0.42)) * 2.2;
    const double tone = pick(83, pane.x, pane.y);
    const std::size_t index = reach < 0.32 + 0.2 * tone ? 5
                              : reach < 0.75            ? 3 + static_cast<std::size_t>(2.0 * tone)
                              : tone < 0.12             ? 7
                                                        : static_cast<std::size_t>(tone * 2.99);
    return colors[index] * (0.82 + 0.3 * pick(84, pane.x, pane.y)) + 26.0 * (0.5 - nearest);
}

/// Black and white stripes of varying width, so that the plane seems to fold.
glm::dvec3 color_waves(const glm::dvec2& uv) {
    const double bend = 0.055 * std::sin(2.0 * pi * (1.5 * uv.y + 0.12 * std::sin(4.0 * pi * uv.x)));
    const double along = uv.x + bend;
    const double phase = 15.0 * along + 1.7 * std::sin(2.0 * pi * along);
    return glm::fract(phase) < 0.5 ? hex(0x15151a) : hex(0xf3efe6);
}

/// Quarter circles, halves and leaves on squares.
glm::dvec3 color_quilt(const glm::dvec2& uv) {
    static const std::array colors = {hex(0xe63946), hex(0xf1faee), hex(0x1d3557),
                                      hex(0xffb703), hex(0x2a9d8f), hex(0xf4e1c1)};
    const glm::dvec2 cell = glm::floor(uv * 5.0);
    glm::dvec2 at = uv * 5.0 - cell;
    const auto value = [&](std::uint32_t seed) {
        return pick(seed, static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y));
    };
    for (int turn = static_cast<int>(4.0 * value(91)); turn > 0; --turn) at = {at.y, 1.0 - at.x};
    const auto ground = static_cast<std::size_t>(6.0 * value(92));
    const auto figure = (ground + 1 + static_cast<std::size_t>(4.99 * value(93))) % 6;
    bool inside = false;
    switch (static_cast<int>(5.0 * value(94))) {
        case 0:
            inside = glm::length(at) < 1.0;
            break;
        case 1:
            inside = glm::length(at) < 1.0 && glm::distance(at, glm::dvec2(1.0)) < 1.0;
            break;
        case 2:
            inside = glm::distance(at, glm::dvec2(0.5, 0.0)) < 0.5 || glm::distance(at, glm::dvec2(0.5, 1.0)) < 0.5;
            break;
        case 3:
            inside = at.x + at.y < 1.0;
            break;
        default:
            inside = std::abs(glm::distance(at, glm::dvec2(0.5)) - 0.3) < 0.14;
            break;
    }
    return colors[inside ? figure : ground];
}

/// Scales of the sea, a boat's moon over them.
glm::dvec3 color_seigaiha(const glm::dvec2& uv) {
    const double moon = glm::distance(uv * glm::dvec2(1.5, 1.0), glm::dvec2(1.05, 0.27));
    const double horizon = 0.45 + 0.012 * std::sin(20.0 * uv.x);
    if (uv.y < horizon) {
        const double cloud = fractal_noise(uv, {2, 9}, 4, 101);
        const glm::dvec3 sky = glm::mix(hex(0xf6d8ae), hex(0xe4572e), std::clamp(1.2 - 2.0 * uv.y, 0.0, 1.0) * 0.75);
        if (moon < 0.13) return hex(0xfff7e6);
        return glm::mix(sky, hex(0xfbe9cf), glm::smoothstep(0.52, 0.62, cloud));
    }
    // Rows of fans overlap downwards; the lowest one that covers the point is visible.
    const double size = 0.085;
    for (int row = static_cast<int>((uv.y - horizon) / (0.5 * size)) + 2; row >= -1; --row) {
        const double y = horizon + 0.5 * size * row;
        const double shift = row % 2 == 0 ? 0.0 : 0.5;
        const double x = (std::floor(uv.x * 1.5 / size - shift + 0.5) + shift) * size;
        const double reach = glm::distance(glm::dvec2(uv.x * 1.5, uv.y), glm::dvec2(x, y + 0.5 * size)) / (0.52 * size);
        if (uv.y > y + 0.5 * size || reach > 1.0) continue;
        const double ring = glm::fract(reach * 3.5);
        const glm::dvec3 deep = glm::mix(hex(0x2e86ab), hex(0x0b3954), (uv.y - horizon) / 0.55);
        return ring < 0.5 ? deep : hex(0xe8f1f2);
    }
    return hex(0x0b3954);
}

}  // namespace

std::vector<DrawnTexture> make_computed_pictures() {
    return {draw_texture("julia", 420, 285, 3, color_julia),   draw_texture("truchet", 288, 384, 3, color_truchet),
            draw_texture("fields", 260, 340, 2, color_fields), draw_texture("pour", 340, 340, 2, color_pour),
            draw_texture("panes", 270, 360, 3, color_panes),   draw_texture("waves", 320, 320, 3, color_waves),
            draw_texture("quilt", 320, 320, 3, color_quilt),   draw_texture("seigaiha", 420, 280, 3, color_seigaiha)};
}

}  // namespace aleph
