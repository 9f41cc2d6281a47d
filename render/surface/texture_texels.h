#pragma once
// Texels of a scene's image as linear values. Internal to texture*.cpp.

#include <array>
#include <glm/vec4.hpp>

#include "engine/base/color.h"
#include "render/surface/texture.h"

namespace aleph {

/// Linear value of each 8-bit sRGB value.
inline const std::array<float, 256> srgb_decoded = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    return table;
}();

/// The value in [0,1] of an 8-bit channel without an encoding.
inline float decode_linear(std::uint8_t value) {
    return static_cast<float>(value) * (1.0f / 255.0f);
}

inline glm::vec4 decode_texel(const glm::u8vec4& b, TextureSpace space) {
    if (space == TextureSpace::srgb) {
        return {srgb_decoded[b.x], srgb_decoded[b.y], srgb_decoded[b.z], decode_linear(b.w)};
    }
    return {decode_linear(b.x), decode_linear(b.y), decode_linear(b.z), decode_linear(b.w)};
}

/// Colour times alpha, and alpha: sums of these leave out the colour of what is not there.
inline glm::vec4 weigh_by_alpha(const glm::vec4& texel) {
    const float alpha = texel.w > 0.0f ? texel.w : 0.0f;  // also for NaN
    return {texel.x * alpha, texel.y * alpha, texel.z * alpha, alpha};
}

inline glm::vec4 read_texel(const SceneImage& image, int x, int y, TextureSpace space) {
    return image.bytes.empty() ? image.floats(x, y) : decode_texel(image.bytes(x, y), space);
}

}  // namespace aleph
