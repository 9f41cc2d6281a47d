#pragma once
// The scene `pool`, part by part. Metres; the floor is y = 0, the table's middle stands over the origin, x along it.

#include <string>

#include "engine/scene/scene.h"
#include "scenes/pool/simulation.h"

namespace aleph {

inline constexpr double cloth_height = 0.78;         ///< m
inline constexpr int last_frame = 89;                ///< the first is 0; 30 a second
inline constexpr double samples_per_second = 120.0;  ///< of the balls' keys
inline constexpr double strike_time = 1.0 / 6.0;     ///< s; the cue meets the cue ball on frame 5

/// Inner faces of the room's walls.
inline constexpr glm::dvec3 room_low{-3.6, 0.0, -2.8};
inline constexpr glm::dvec3 room_high{3.0, 2.9, 2.8};

/// @param camera_moves  pool; without it, pool-still
/// @param textures  folder of the textures as the scene file is to name it, "textures/" or "../pool/textures/"
Scene make_pool_scene(bool camera_moves, const std::string& textures);

/// The parts, each below a node of its own.
void add_room(Scene& scene);
void add_lights(Scene& scene);
void add_table(Scene& scene, const PoolSettings& settings);
void add_balls(Scene& scene, const PoolSettings& settings, const PoolRun& run);
void add_cue(Scene& scene, const PoolSettings& settings, const PoolBall& struck);
void add_camera(Scene& scene, bool moves);

}  // namespace aleph
