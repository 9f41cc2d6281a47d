#pragma once
// Noise, colours and strokes for drawing textures. Colours are sRGB, 0..255, as doubles.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "engine/base/sampling.h"
#include "scenes/common/generator.h"
#include "scenes/common/keys.h"

namespace aleph {

/// A random number in [0, 1) that depends on the place, such as a point of a lattice, and the seed only.
inline double pick(std::uint32_t seed, std::int64_t x, std::int64_t y = 0) {
    return RandomStream(RandomKey{seed, 0, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)}).at(0);
}

/// Smooth value noise in [0, 1) that repeats every `cells`; x and y in cells.
inline double noise(const glm::dvec2& at, const glm::i64vec2& cells, std::uint32_t seed) {
    const glm::dvec2 low = glm::floor(at), t = glm::smoothstep(glm::dvec2(0.0), glm::dvec2(1.0), at - low);
    const auto value = [&](int dx, int dy) {
        const auto wrap = [](std::int64_t v, std::int64_t n) { return (v % n + n) % n; };
        return pick(seed, wrap(static_cast<std::int64_t>(low.x) + dx, cells.x),
                    wrap(static_cast<std::int64_t>(low.y) + dy, cells.y));
    };
    return glm::mix(glm::mix(value(0, 0), value(1, 0), t.x), glm::mix(value(0, 1), value(1, 1), t.x), t.y);
}

/// Sum of `octaves` of noise, each twice as fine and half as strong; [0, 1). uv in [0, 1) repeats.
inline double fractal_noise(const glm::dvec2& uv, glm::i64vec2 cells, int octaves, std::uint32_t seed) {
    double sum = 0.0, weight = 0.5, total = 0.0;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * noise(uv * glm::dvec2(cells), cells, seed + static_cast<std::uint32_t>(i));
        total += weight;
        weight *= 0.5;
        cells *= 2;
    }
    return sum / total;
}

inline double distance_to_segment(const glm::dvec2& at, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 along = b - a;
    const double place = glm::clamp(glm::dot(at - a, along) / std::max(glm::dot(along, along), 1e-12), 0.0, 1.0);
    return glm::distance(at, a + place * along);
}

/// Evaluates color(uv), uv in [0, 1), at `samples` x `samples` points of every pixel, and rounds their mean.
template <class Color>
DrawnTexture draw_texture(const char* name, int width, int height, int samples, const Color& color) {
    DrawnTexture texture{name, Image<glm::u8vec3>(width, height)};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < samples * samples; ++i) {
                const glm::dvec2 offset = (glm::dvec2(i % samples, i / samples) + 0.5) / static_cast<double>(samples);
                sum += color((glm::dvec2(x, y) + offset) / glm::dvec2(width, height));
            }
            const glm::dvec3 mean = glm::clamp(sum / static_cast<double>(samples * samples), 0.0, 255.0);
            texture.srgb(x, y) = glm::u8vec3(glm::floor(mean + 0.5));
        }
    }
    return texture;
}

inline glm::dvec3 hex(std::uint32_t code) {
    return {code >> 16 & 255u, code >> 8 & 255u, code & 255u};
}

/// Colours at equal steps of t in [0, 1], interpolated linearly.
inline glm::dvec3 gradient(std::span<const glm::dvec3> colors, double t) {
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), colors.size() - 2);
    return glm::mix(colors[i], colors[i + 1], place - static_cast<double>(i));
}

/// A picture to paint on; x to the right, y down, in pixels.
class Canvas {
  public:
    Canvas(int width, int height, const glm::dvec3& ground) : pixels_(width, height) {
        for (glm::dvec3& pixel : pixels_.pixels) pixel = ground;
    }
    int width() const { return pixels_.width; }
    int height() const { return pixels_.height; }
    glm::dvec3& at(int x, int y) { return pixels_(x, y); }

    /// A disc with an edge one pixel soft.
    void disc(const glm::dvec2& center, double radius, const glm::dvec3& color, double opacity = 1.0) {
        const auto low = [](double v) { return static_cast<int>(std::floor(v)); };
        for (int y = std::max(0, low(center.y - radius - 1.0));
             y <= std::min(height() - 1, low(center.y + radius + 1.0)); ++y) {
            for (int x = std::max(0, low(center.x - radius - 1.0));
                 x <= std::min(width() - 1, low(center.x + radius + 1.0)); ++x) {
                const double d = glm::distance(glm::dvec2(x + 0.5, y + 0.5), center);
                const double cover = std::clamp(radius + 0.5 - d, 0.0, 1.0) * opacity;
                if (cover > 0.0) pixels_(x, y) = glm::mix(pixels_(x, y), color, cover);
            }
        }
    }

    /// A line of discs; an even stroke if opaque.
    void line(const glm::dvec2& from, const glm::dvec2& to, double radius, const glm::dvec3& color,
              double opacity = 1.0) {
        const int steps =
            std::max(1, static_cast<int>(std::ceil(glm::distance(from, to) / std::max(0.4, 0.4 * radius))));
        for (int i = 0; i <= steps; ++i)
            disc(glm::mix(from, to, static_cast<double>(i) / steps), radius, color, opacity);
    }

    DrawnTexture finish(const std::string& name) const {
        DrawnTexture texture{name, Image<glm::u8vec3>(pixels_.width, pixels_.height)};
        for (std::size_t i = 0; i < pixels_.size(); ++i)
            texture.srgb.pixels[i] = glm::u8vec3(glm::floor(glm::clamp(pixels_.pixels[i], 0.0, 255.0) + 0.5));
        return texture;
    }

  private:
    Image<glm::dvec3> pixels_;
};

}  // namespace aleph
