#pragma once
// The textures of the scene, drawn from formulas. Deterministic.

#include <vector>

#include "scenes/common/generator.h"

namespace aleph {

// All patterns except the paintings, the sky and the balls repeat without a seam.

/// "felt", "rail", "floor", "wallpaper", "wainscot", "sunset", "blocks", "circles", "sky".
std::vector<DrawnTexture> make_room_textures();

/// "ball_00" (the cue ball) to "ball_15" by longitude and latitude; the number is at u = .25 and .75.
std::vector<DrawnTexture> make_ball_textures();

/// All of these.
std::vector<DrawnTexture> make_pool_textures();

}  // namespace aleph
