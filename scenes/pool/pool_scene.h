#pragma once
// The parts of the scene `pool`. Metres; the floor is y = 0, the middle of the table is above the origin, x along it.

#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "scenes/common/generator.h"
#include "scenes/pool/simulation.h"

namespace aleph {

inline constexpr double cloth_height = 0.78;         ///< m
inline constexpr int last_frame = 89;                ///< the first is 0; 30 frames per second
inline constexpr double samples_per_second = 120.0;  ///< keys of the balls
inline constexpr double strike_time = 1.0 / 6.0;     ///< s; the cue hits the cue ball on frame 5

/// Inner faces of the room's walls.
inline constexpr glm::dvec3 room_low{-3.6, 0.0, -2.8};
inline constexpr glm::dvec3 room_high{3.0, 2.9, 2.8};

inline constexpr int cue_ball = 0;  ///< index; balls 1 to 15 have their number as index

/// Speed that the cue gives to the cue ball, m/s.
inline constexpr double break_speed = 6.8;

/// Ball i is at index i. The apex of the rack is on the foot spot (x > 0). The gaps between the balls are some
/// hundredths of a millimetre and differ. The numbers face roughly up and towards the foot end. Deterministic.
std::vector<PoolBall> make_rack(const PoolSettings& settings);

/// @param camera_moves  true: pool, false: pool-still
/// @param textures  folder of the textures, relative to the scene file: "textures/" or "../pool/textures/"
Scene make_pool_scene(bool camera_moves, const std::string& textures);

/// The parts, each below its own node.
void add_room(Scene& scene);
void add_lights(Scene& scene);
void add_table(Scene& scene, const PoolSettings& settings);
void add_balls(Scene& scene, const PoolSettings& settings, const PoolRun& run);
void add_cue(Scene& scene, const PoolSettings& settings, const PoolBall& struck);
void add_camera(Scene& scene, bool moves);

// The textures, drawn from formulas, deterministic. All patterns except the paintings, the sky and the balls repeat
// without a seam.

/// "felt", "rail", "floor", "wallpaper", "wainscot", "sunset", "blocks", "circles", "sky".
std::vector<DrawnTexture> make_room_textures();

/// "ball_00" (the cue ball) to "ball_15" by longitude and latitude; the number is at u = .25 and .75.
std::vector<DrawnTexture> make_ball_textures();

/// All of these.
std::vector<DrawnTexture> make_pool_textures();

}  // namespace aleph
