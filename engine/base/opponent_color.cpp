#include "engine/base/opponent_color.h"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr int rows_per_chunk = 32;
constexpr float max_component = 1e15f;

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
    return c > 0.0f ? (c < max_component ? c : max_component) : 0.0f;
}

}  // namespace

ChannelWeights opponent_weights(OpponentChannel channel, bool neutral) {
    const glm::dmat3 m = opponent_from_rgb(neutral);
    const int row = static_cast<int>(channel);
    return {static_cast<float>(m[0][row]), static_cast<float>(m[1][row]), static_cast<float>(m[2][row])};
}

void opponent_row(const Rgb* rgb, int count, const ChannelWeights& weights, float* out) {
    const ChannelWeights w = weights;
    for (int x = 0; x < count; ++x) {
        out[x] = w.r * clamp_component(rgb[x].x) + w.g * clamp_component(rgb[x].y) + w.b * clamp_component(rgb[x].z);
    }
}

Image<float> compute_opponent(const Image<Rgb>& rgb, OpponentChannel channel, bool neutral) {
    const ChannelWeights weights = opponent_weights(channel, neutral);
    Image<float> out(rgb.width, rgb.height);
    parallel_rows(rgb.height, rows_per_chunk, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            opponent_row(rgb.row(y), rgb.width, weights, out.row(y));
        }
    });
    return out;
}

}  // namespace aleph
