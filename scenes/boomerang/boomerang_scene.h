#pragma once
// The scene `boomerang`, part by part. Metres; the floor is y = 0, the camera looks along -z at a painted wall.

#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "scenes/common/textures.h"

namespace aleph {

inline constexpr int boomerang_last_frame = 89;        ///< the first is 0; 30 a second
inline constexpr int boomerang_still_until = 45;       ///< frame at which the camera sets off
inline constexpr double boomerang_spin_degrees = 7.0;  ///< about its own axis, in a frame

/// @param textures  folder of the textures as the scene file is to name it, "textures/"
Scene make_boomerang_scene(const std::string& textures);

/// "mural", "tiles", "plaster", "paint": drawn by formulas, the same bytes every time.
std::vector<DrawnTexture> make_boomerang_textures();

/// The boomerang: two arms of a curved blade, flat below and arched above, closed; it lies in the plane y = 0 with its
/// centre of mass over the origin and its elbow towards -z. Texture: u along the blade, v across it, the upper half of
/// the picture on top.
Mesh make_boomerang_mesh(int material);

}  // namespace aleph
