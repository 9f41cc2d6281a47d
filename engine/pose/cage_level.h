#pragma once
// Chooses the refinement level of subdivision cages by pixel size: one level per cage for the whole shot, so that a hit
// means the same point of the surface in every frame.

#include <memory>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// The level of every cage, from Cage::level to Cage::max_level, at which its triangles in view are fine enough over
/// the scene's range of frames: their edges are no longer than 4 pixels, or the limit surface lies within a tenth of a
/// pixel of them, so that flat faces stay whole. Measured at 33 frames evenly over the range, and for each instance at
/// the frame at which it comes closest (closest_pass.h). It does not depend on the frames that are rendered. Lengths
/// are measured at the triangle's nearest point, without foreshortening; hidden triangles count too.
/// @param scene  with tessellated cages
/// @param camera  index into ScenePose::cameras
/// @param max_triangles  of all cages together; of those above their own level the largest give way
std::vector<int> choose_cage_levels(const Scene& scene, int camera, int width, int height,
                                    std::size_t max_triangles = 4'000'000);

/// The scene with its cages at these levels (at most Cage::max_level) and their meshes made again; null where the cages
/// already have these levels.
/// @throws InputError as tessellate_cage
std::unique_ptr<Scene> make_scene_at_levels(const Scene& scene, std::span<const int> levels);

}  // namespace aleph
