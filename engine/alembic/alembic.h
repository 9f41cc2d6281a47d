#pragma once
// Reader of Alembic archives (.abc, the Ogawa container). It uses no Alembic library.

#include <filesystem>

#include "engine/scene/append.h"

namespace aleph {

/// Reads an archive into the scene, below a node (no_index: at the top).
///
/// Every transform, surface, camera and group is a node of the object's name. Transforms interpolate channel by
/// channel, points linearly, visibility takes the nearest sample. Instances are expanded and share their meshes. Faces
/// become counter-clockwise (archives have them clockwise), unless the archive's normals show that they are already; v
/// grows downwards. A surface whose topology changes becomes one mesh for each topology. Cameras show the film's frame
/// without overscan; f-stop and shutter are ignored. Points, curves, patches and lights are not read; a warning in
/// SceneSource::warnings names them.
/// @return the frame rate of its uniform samples, or as its metadata says (common rates exactly), and its samples'
/// times
/// @throws InputError with file, place and reason; the scene does not change then
FileTiming append_alembic(const std::filesystem::path& file, Scene& scene, int parent_node, int include_index);

}  // namespace aleph
