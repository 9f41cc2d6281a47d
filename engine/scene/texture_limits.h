#pragma once

namespace aleph {

/// Texture coordinates of this size or more count as 0: beyond it, a float cannot hold fractions of a texel.
inline constexpr float max_texture_coordinate = 1e6f;

}  // namespace aleph
