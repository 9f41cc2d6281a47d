#include "engine/base/opponent_color.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr float max_linear = 1e15f;

/// glm takes columns; the papers print rows.
glm::dmat3 from_rows(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::transpose(glm::dmat3(a, b, c));
}

/// IEC 61966-2-1, Rec.709 primaries, white D65.
glm::dmat3 xyz_from_rgb() {
    return from_rows({0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505});
}

/// Meyer 1988; Bolin and Meyer 1995.
glm::dmat3 opponent_from_xyz() {
    return from_rows({-0.0177, 1.0090, 0.0073}, {-1.5370, 1.0821, 0.3209}, {0.1946, -0.2045, 0.5264});
}

glm::dmat3 opponent_from_rgb(bool neutral) {
    glm::dmat3 m = opponent_from_xyz() * xyz_from_rgb();
    if (!neutral) return m;
    const glm::dvec3 grey = m * glm::dvec3(1.0);
    const glm::dmat3 xyz = xyz_from_rgb();
    for (int column = 0; column < 3; ++column) {
        m[column] -= glm::dvec3(0.0, grey.y, grey.z) * xyz[column].y;
    }
    return m;
}

float clamp_component(float c) {
    return c > 0.0f ? (c < max_linear ? c : max_linear) : 0.0f;
}

}  // namespace

Image<float> compute_opponent(const Image<Rgb>& rgb, OpponentChannel channel, bool neutral) {
    const glm::dmat3 m = opponent_from_rgb(neutral);
    const int row = static_cast<int>(channel);
    const auto r = static_cast<float>(m[0][row]), g = static_cast<float>(m[1][row]), b = static_cast<float>(m[2][row]);
    Image<float> out(rgb.width, rgb.height);
    parallel_pixels(rgb, rows_per_band, [&](int x, int y) {
        const Rgb& c = rgb(x, y);
        out(x, y) = r * clamp_component(c.x) + g * clamp_component(c.y) + b * clamp_component(c.z);
    });
    return out;
}

}  // namespace aleph
