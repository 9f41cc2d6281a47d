#pragma once
// How far things turn between two moments, read from their tracks: the end poses alone cannot tell a full turn from
// rest (HARD_CASES RP-07).

#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Turns against the camera within a span of time, radians, summed along the keys and the hierarchy: not less than the
/// angle between the end poses. What camera and object inherit alike does not count.
struct Turns {
    std::vector<double> nodes;  ///< per node of the scene
    double background = 0.0;    ///< of the camera against the world
};

/// @param camera_node  no_index: a camera that stands still
/// @param begin, end   s, in either order
Turns compute_turns(const Scene& scene, int camera_node, double begin, double end);

/// Moments evenly between `begin` and `end`, in that direction, so many that from one to the next nothing that has a
/// mesh, nor the background, turns by more than `largest_turn` (radians). Empty where nothing does anyway. At most 511:
/// a spin beyond 512 times `largest_turn` gets longer steps.
/// @param extra_turn  radians from `begin` to `end`, at a constant rate, on top of what the tracks say
std::vector<double> subdivide_turns(const Scene& scene, int camera_node, double begin, double end, double largest_turn,
                                    double extra_turn = 0.0);

}  // namespace aleph
