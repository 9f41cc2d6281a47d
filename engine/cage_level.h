#pragma once
// The refinement that pixels ask of subdivision cages: one level per cage for the whole shot, so that a hit names the
// same point of the surface in every frame.

#include <memory>
#include <span>
#include <vector>

#include "engine/scene.h"

namespace aleph {

struct CageLevelSettings {
    double edge_pixels = 4.0;               ///< the longest edge of a triangle in view; at least half of it is used
    std::size_t max_triangles = 4'000'000;  ///< of all cages together; the cage of the most gives way first
    int samples = 33;                       ///< frames looked at, spread evenly over the range with both its ends
};

/// The level of every cage at which no triangle's edge in view is longer than asked for, over the scene's range of
/// frames. At most Cage::max_level. A cage that no sampled frame has in view keeps its own level. A function of scene,
/// camera and size of the picture, whichever frames are rendered. Edges count by their length at the nearest point of
/// their face: not foreshortened, not hidden.
/// @param camera  index into SceneFrame::cameras
/// @param width,height  pixels
std::vector<int> choose_cage_levels(const Scene& scene, int camera, int width, int height,
                                    const CageLevelSettings& settings = {});

/// The scene with its cages at these levels (at most Cage::max_level) and their meshes made anew; null where that is
/// what they are.
/// @throws InputError as tessellate_cage
std::unique_ptr<Scene> make_scene_at_levels(const Scene& scene, std::span<const int> levels);

}  // namespace aleph
