#include <fmt/format.h>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scenes/common/texture_tools.h"
#include "scenes/pool/textures.h"

namespace aleph {

namespace {

constexpr double pi = std::numbers::pi;

// Five columns, seven rows, a bit per dot, the leftmost the highest.
constexpr std::array<std::array<int, 7>, 10> digits = {{{14, 17, 19, 21, 25, 17, 14},
                                                        {4, 12, 4, 4, 4, 4, 14},
                                                        {14, 17, 1, 2, 4, 8, 31},
                                                        {31, 2, 4, 2, 1, 17, 14},
                                                        {2, 6, 10, 18, 31, 2, 2},
                                                        {31, 16, 30, 1, 1, 17, 14},
                                                        {6, 8, 16, 30, 17, 17, 14},
                                                        {31, 1, 2, 4, 8, 8, 8},
                                                        {14, 17, 17, 14, 17, 17, 14},
                                                        {14, 17, 17, 15, 1, 2, 12}}};

const std::array<glm::dvec3, 8> solid_colors = {{{240, 190, 36},
                                                 {28, 66, 160},
                                                 {202, 38, 30},
                                                 {92, 44, 128},
                                                 {232, 106, 26},
                                                 {22, 112, 66},
                                                 {128, 28, 38},
                                                 {26, 26, 29}}};
const glm::dvec3 ivory(240, 233, 216);
const glm::dvec3 ink(20, 20, 22);

/// Is there ink at a place of the number's square, both coordinates in [-1, 1], y down?
bool is_ink(int number, const glm::dvec2& at) {
    const int places = number < 10 ? 1 : 2;
    const double dot = places == 1 ? 0.155 : 0.115;  // size of one dot of the font
    const double columns = places == 1 ? 5.0 : 11.0;
    const double x = at.x / dot + 0.5 * columns, y = at.y / dot + 3.5;
    if (x < 0.0 || x >= columns || y < 0.0 || y >= 7.0) return false;
    const int column = static_cast<int>(x) % 6;
    if (column == 5) return false;  // between two digits
    const int digit = places == 1 || x >= 6.0 ? number % 10 : number / 10;
    return (digits[static_cast<std::size_t>(digit)][static_cast<std::size_t>(y)] >> (4 - column) & 1) != 0;
}

/// The cue ball has six spots, so that its spin shows.
glm::dvec3 color_cue_ball(const glm::dvec2& uv) {
    const double polar = pi * uv.y, turn = 2.0 * pi * uv.x;
    const glm::dvec3 p(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
    const glm::dvec3 size = glm::abs(p);
    return std::max({size.x, size.y, size.z}) > std::cos(0.17) ? glm::dvec3(190, 44, 36) : ivory;
}

glm::dvec3 color_numbered_ball(int number, const glm::dvec2& uv) {
    const glm::dvec3& color = solid_colors[static_cast<std::size_t>((number - 1) % 8)];
    // Radians on the sphere from the nearer number, near enough at this distance from the poles.
    const double across = (uv.x < 0.5 ? uv.x - 0.25 : uv.x - 0.75) * 2.0 * pi, down = (uv.y - 0.5) * pi;
    const double spot = 0.52;
    if (std::hypot(across, down) < spot) return is_ink(number, glm::dvec2(across, down) / spot) ? ink : ivory;
    const bool striped = number > 8;
    return striped && std::abs(down) > 0.62 ? ivory : color;
}

}  // namespace

std::vector<DrawnTexture> make_ball_textures() {
    std::vector<DrawnTexture> textures;
    for (int number = 0; number <= 15; ++number) {
        const std::string name = fmt::format("ball_{:02}", number);
        textures.push_back(draw_texture(name.c_str(), 256, 128, 4, [&](const glm::dvec2& uv) {
            return number == 0 ? color_cue_ball(uv) : color_numbered_ball(number, uv);
        }));
    }
    return textures;
}

}  // namespace aleph
