#pragma once
// Colours: linear RGB, Rec.709 primaries, white = 1 after exposure.

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

namespace aleph {

using Rgb = glm::vec3;

/// Relative luminance Y of linear Rec.709 RGB (IEC 61966-2-1).
inline float luminance(const Rgb& c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

inline float largest_channel(const Rgb& c) {
    return std::max({c.x, c.y, c.z});
}

/// Returns whether all three channels, or coordinates, are finite.
inline bool is_finite(const Rgb& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

/// sRGB transfer function, [0,1] to [0,1] (IEC 61966-2-1).
inline float linear_to_srgb(float v) {
    return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

inline float srgb_to_linear(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace aleph
