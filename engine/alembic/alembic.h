#pragma once
// Reader of Alembic archives (.abc, the Ogawa container). It uses no Alembic library.

#include <filesystem>
#include <optional>

#include "engine/scene/scene.h"

namespace aleph {

/// Frame rate and range of an archive, for a scene that consists of that archive.
struct AlembicTiming {
    std::optional<FrameRate> frame_rate;  ///< of its uniform samples, or as its metadata says; common rates exactly
    /// First and last sample of what changes, s; unset where nothing does.
    std::optional<double> first, last;
};

/// Reads an archive into the scene, below a node (no_index: at the top).
///
/// Every transform, surface, camera and group is a node of the object's name. Transforms interpolate channel by
/// channel, points linearly, visibility takes the nearest sample. Instances are expanded and share their meshes. Faces
/// become counter-clockwise (archives have them clockwise), unless the archive's normals show that they are already; v
/// grows downwards. A surface whose topology changes becomes one mesh for each topology. Cameras show the film's frame
/// without overscan; f-stop and shutter are ignored. Points, curves, patches and lights are not read; a warning in
/// Scene::warnings names them.
/// @throws InputError with file, place and reason; the scene does not change then
AlembicTiming append_alembic(const std::filesystem::path& file, Scene& scene, int parent_node, int include_index);

}  // namespace aleph
