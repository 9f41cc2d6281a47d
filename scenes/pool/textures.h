#pragma once
// The scene's pictures, made by formulas: always the same bytes.

#include <glm/gtc/type_precision.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"

namespace aleph {

/// Eight-bit sRGB; every pattern but the paintings and the balls repeats without a seam.
struct PoolTexture {
    std::string name;  ///< without folder and ending
    Image<glm::u8vec3> srgb;
};

/// "felt", "rail", "floor", "wallpaper", "wainscot", "sunset", "blocks", "circles".
std::vector<PoolTexture> make_room_textures();

/// "ball_00" (the cue ball) to "ball_15": latitude and longitude, the number at u = .25 and .75.
std::vector<PoolTexture> make_ball_textures();

}  // namespace aleph
