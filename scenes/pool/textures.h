#pragma once
// The scene's pictures, made by formulas: always the same bytes.

#include <vector>

#include "scenes/common/textures.h"

namespace aleph {

// Every pattern but the paintings, the sky and the balls repeats without a seam.

/// "felt", "rail", "floor", "wallpaper", "wainscot", "sunset", "blocks", "circles", "sky".
std::vector<DrawnTexture> make_room_textures();

/// "ball_00" (the cue ball) to "ball_15": latitude and longitude, the number at u = .25 and .75.
std::vector<DrawnTexture> make_ball_textures();

/// All of these.
std::vector<DrawnTexture> make_pool_textures();

}  // namespace aleph
