#include "engine/base/opponent_color.h"

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr std::size_t pixels_per_chunk = 1u << 14;
constexpr float largest_component = 1e15f;

/// glm takes columns; the tables are printed by rows.
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
    return c > 0.0f ? (c < largest_component ? c : largest_component) : 0.0f;
}

/// One channel: the weights of R, G and B.
struct ChannelWeights {
    float r, g, b;
};

ChannelWeights channel_weights(const glm::dmat3& m, int channel) {
    return {static_cast<float>(m[0][channel]), static_cast<float>(m[1][channel]), static_cast<float>(m[2][channel])};
}

float dot(const ChannelWeights& w, float r, float g, float b) {
    return w.r * r + w.g * g + w.b * b;
}

}  // namespace

glm::dvec3 to_opponent(const glm::dvec3& rgb) {
    return opponent_from_rgb(false) * rgb;
}

glm::dvec3 from_opponent(const glm::dvec3& opponent) {
    return glm::inverse(opponent_from_rgb(false)) * opponent;
}

Rgb clamp_for_opponent(const Rgb& rgb) {
    return {clamp_component(rgb.x), clamp_component(rgb.y), clamp_component(rgb.z)};
}

namespace {

/// One channel of the clamped pixels: three inputs, one output, as compilers vectorise it best.
Image<float> compute_channel(const Image<Rgb>& rgb, const ChannelWeights& weights) {
    Image<float> out(rgb.width, rgb.height);
    parallel_for(rgb.size(), pixels_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Rgb& c = rgb.pixels[i];
            out.pixels[i] = dot(weights, clamp_component(c.x), clamp_component(c.y), clamp_component(c.z));
        }
    });
    return out;
}

}  // namespace

OpponentImages compute_opponent(const Image<Rgb>& rgb, bool neutral) {
    const glm::dmat3 m = opponent_from_rgb(neutral);
    return {compute_channel(rgb, channel_weights(m, 0)), compute_channel(rgb, channel_weights(m, 1)),
            compute_channel(rgb, channel_weights(m, 2))};
}

Image<float> compute_achromatic(const Image<Rgb>& rgb) {
    return compute_channel(rgb, channel_weights(opponent_from_rgb(false), 0));
}

}  // namespace aleph
