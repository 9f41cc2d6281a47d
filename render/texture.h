#pragma once
// Texture look-up: bilinear, in the image's own grid. (Filtering by ray footprint comes with the texture system.)

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/scene.h"

namespace aleph {

enum class TextureSpace {
    linear,
    srgb,  ///< colour channels of 8-bit images are decoded; float images are linear already
};

/// The texture at uv (v downwards from the image's top row). White where the reference names no image.
/// A uv that is not finite reads as (0, 0).
glm::vec4 sample_texture(const Scene& scene, const TextureRef& texture, const glm::vec2& uv, TextureSpace space);

}  // namespace aleph
