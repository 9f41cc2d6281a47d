#pragma once
// The parts of the scene `boomerang`. Metres; the floor is y = 0, the camera looks along -z at a painted wall.

#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "scenes/common/generator.h"

namespace aleph {

inline constexpr int boomerang_last_frame = 89;        ///< the first is 0; 30 frames per second
inline constexpr int boomerang_still_until = 45;       ///< frame at which the camera starts to move
inline constexpr double boomerang_spin_degrees = 7.0;  ///< about its own axis, per frame

/// @param textures  folder of the textures, relative to the scene file: "textures/"
Scene make_boomerang_scene(const std::string& textures);

/// "mural", "tiles", "plaster", "paint": drawn from formulas, deterministic.
std::vector<DrawnTexture> make_boomerang_textures();

/// The boomerang: a closed blade with two arms, flat below and arched above, in the plane y = 0. Its centre of mass is
/// above the origin, its elbow towards -z. Texture: u along the blade, v across it; the upper half of the picture is
/// the upper side.
Mesh make_boomerang_mesh(int material);

}  // namespace aleph
