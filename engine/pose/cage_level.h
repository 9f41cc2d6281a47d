#pragma once
// Chooses the refinement level of subdivision cages by pixel size: one level per cage for the whole shot, so that a hit
// means the same point of the surface in every frame.

#include <memory>
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// A triangle is fine enough where one of the two holds.
struct CageLevelSettings {
    double edge_pixels = 4.0;  ///< none of its edges is longer
    double bend_pixels = 0.1;  ///< the limit surface is no farther from its edges: flat faces stay whole
    std::size_t max_triangles =
        4'000'000;     ///< of all cages together; of those above their own level the largest give way
    int samples = 33;  ///< frames examined, spread evenly over the range with both its ends
};

/// The level of every cage, from Cage::level to Cage::max_level, at which its triangles in view are fine enough over
/// the scene's range of frames. It depends on scene, camera and size of the picture, not on the frames that are
/// rendered. Lengths are measured at the triangle's nearest point, without foreshortening; hidden triangles count too.
/// @param scene  with tessellated cages: their triangles tell how edges and bends shrink with the level
/// @param camera  index into ScenePose::cameras
/// @param width,height  pixels
std::vector<int> choose_cage_levels(const Scene& scene, int camera, int width, int height,
                                    const CageLevelSettings& settings = {});

/// The scene with its cages at these levels (at most Cage::max_level) and their meshes made again; null where the cages
/// already have these levels.
/// @throws InputError as tessellate_cage
std::unique_ptr<Scene> make_scene_at_levels(const Scene& scene, std::span<const int> levels);

}  // namespace aleph
