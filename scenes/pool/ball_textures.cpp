#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

#include "scenes/common/texture_tools.h"
#include "scenes/pool/pool_scene.h"

namespace aleph {

namespace {

// Digits as strokes, in heights of a digit.

constexpr double half_stroke = 0.075;

/// A line through points.
using Stroke = std::vector<glm::dvec2>;

/// Part of an ellipse, in degrees from +x towards +y (clockwise, as y points down), added to a stroke.
Stroke arc(Stroke stroke, const glm::dvec2& center, const glm::dvec2& radii, double from, double to) {
    const int steps = static_cast<int>(std::ceil(std::abs(to - from) / 10.0));
    for (int i = 0; i <= steps; ++i) {
        const double angle = glm::radians(from + (to - from) * i / steps);
        stroke.push_back(center + radii * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return stroke;
}

Stroke ellipse(const glm::dvec2& center, const glm::dvec2& radii) {
    return arc({}, center, radii, 0.0, 360.0);
}

Stroke followed_by(Stroke stroke, const Stroke& points) {
    stroke.insert(stroke.end(), points.begin(), points.end());
    return stroke;
}

struct Digit {
    double width;  ///< with the space beside it
    std::vector<Stroke> strokes;
};

std::array<Digit, 10> make_digits() {
    const std::vector<Stroke> six = {ellipse({0.0, 0.16}, {0.265, 0.27}),
                                     arc({}, {0.2, 0.16}, {0.465, 0.59}, 180, 266)};
    std::vector<Stroke> nine = six;  // upside down
    for (Stroke& stroke : nine)
        for (glm::dvec2& point : stroke) point = -point;
    const double wide = 0.72;
    return {
        {{wide, {ellipse({0.0, 0.0}, {0.265, 0.43})}},
         {0.44, {{{-0.13, -0.27}, {0.06, -0.43}, {0.06, 0.43}}}},
         {wide, {followed_by(arc({}, {0.0, -0.18}, {0.26, 0.25}, 190, 405), {{-0.27, 0.43}, {0.28, 0.43}})}},
         {wide, {arc({}, {-0.01, -0.225}, {0.235, 0.205}, 205, 450), arc({}, {-0.01, 0.205}, {0.27, 0.225}, 270, 515)}},
         {wide, {{{0.12, 0.43}, {0.12, -0.43}, {-0.29, 0.17}, {0.3, 0.17}}}},
         {wide, {arc({{0.23, -0.43}, {-0.2, -0.43}, {-0.235, -0.03}}, {-0.02, 0.14}, {0.27, 0.29}, 217, 510)}},
         {wide, six},
         {wide, {{{-0.27, -0.43}, {0.27, -0.43}, {-0.08, 0.43}}}},
         {wide, {ellipse({0.0, -0.23}, {0.225, 0.2}), ellipse({0.0, 0.2}, {0.27, 0.23})}},
         {wide, nine}}};
}

double distance_to_strokes(const std::vector<Stroke>& strokes, const glm::dvec2& at) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Stroke& stroke : strokes)
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i)
            nearest = std::min(nearest, distance_to_segment(at, stroke[i], stroke[i + 1]));
    return nearest;
}

/// Is there ink at a point? The number is centred; x to the right, y down, a digit is about 1 high. A single 6 or 9 is
/// underlined.
bool is_number_ink(int number, const glm::dvec2& at) {
    static const std::array<Digit, 10> digits = make_digits();
    if ((number == 6 || number == 9) && distance_to_segment(at, {-0.2, 0.64}, {0.2, 0.64}) < 0.8 * half_stroke)
        return true;
    const Digit& ones = digits[number % 10];
    if (number < 10) return distance_to_strokes(ones.strokes, at) < half_stroke;
    const Digit& tens = digits[number / 10];
    return distance_to_strokes(tens.strokes, at + glm::dvec2(0.5 * ones.width, 0.0)) < half_stroke ||
           distance_to_strokes(ones.strokes, at - glm::dvec2(0.5 * tens.width, 0.0)) < half_stroke;
}

const std::array<glm::dvec3, 8> solid_colors = {{{240, 190, 36},
                                                 {28, 66, 160},
                                                 {202, 38, 30},
                                                 {92, 44, 128},
                                                 {232, 106, 26},
                                                 {22, 112, 66},
                                                 {128, 28, 38},
                                                 {26, 26, 29}}};
const glm::dvec3 ball_white(240, 233, 216);
const glm::dvec3 ink(20, 20, 22);

/// The cue ball has six spots, so that its spin is visible.
glm::dvec3 color_cue_ball(const glm::dvec2& uv) {
    const double polar = pi * uv.y, turn = 2.0 * pi * uv.x;
    const glm::dvec3 p(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
    const glm::dvec3 size = glm::abs(p);
    return std::max({size.x, size.y, size.z}) > std::cos(0.17) ? glm::dvec3(190, 44, 36) : ball_white;
}

glm::dvec3 color_numbered_ball(int number, const glm::dvec2& uv) {
    const glm::dvec3& color = solid_colors[(number - 1) % 8];
    // The circle of the nearer number, seen from above, in radii of the ball.
    const double across = (uv.x < 0.5 ? uv.x - 0.25 : uv.x - 0.75) * 2.0 * pi, down = (uv.y - 0.5) * pi;
    const glm::dvec2 at(std::cos(down) * std::sin(across), std::sin(down));
    const double spot = 0.5;
    if (glm::length(at) < spot) {
        const double digit_height = number < 10 ? 0.64 : 0.54;
        return is_number_ink(number, at / digit_height) ? ink : ball_white;
    }
    const bool striped = number > 8;
    return striped && std::abs(down) > 0.62 ? ball_white : color;
}

}  // namespace

std::vector<DrawnTexture> make_ball_textures() {
    std::vector<DrawnTexture> textures;
    for (int number = 0; number <= 15; ++number) {
        const std::string name = fmt::format("ball_{:02}", number);
        textures.push_back(draw_texture(name.c_str(), 512, 256, 4, [&](const glm::dvec2& uv) {
            return number == 0 ? color_cue_ball(uv) : color_numbered_ball(number, uv);
        }));
    }
    return textures;
}

}  // namespace aleph
