#pragma once
// Drawing with overlapping strokes, and colours by hexadecimal code. sRGB, 0..255, as doubles.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "scenes/common/texture_tools.h"

namespace aleph {

inline glm::dvec3 hex(std::uint32_t code) {
    return {code >> 16 & 255u, code >> 8 & 255u, code & 255u};
}

/// Colours at equal steps of t in [0, 1], interpolated linearly.
inline glm::dvec3 gradient(std::span<const glm::dvec3> colors, double t) {
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(place), colors.size() - 2);
    return glm::mix(colors[i], colors[i + 1], place - static_cast<double>(i));
}

/// The i-th number of a random stream, in [0, 1).
inline double pick(std::uint32_t seed, std::int64_t i, std::int64_t j = 0) {
    return lattice_value(i, j, seed);
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
