#pragma once
// Reader of Alembic archives (.abc, the Ogawa container), written from a description of the format; no Alembic library.

#include <filesystem>
#include <optional>

#include "engine/scene/scene.h"

namespace aleph {

/// When an archive's samples lie, for a scene that is nothing else.
struct AlembicTiming {
    std::optional<FrameRate> frame_rate;  ///< of its uniform samples, or as its metadata says; common rates exactly
    /// First and last sample of what changes, s; unset where nothing does.
    std::optional<double> first, last;
};

/// Reads an archive into the scene, below a node (no_index: at the top).
///
/// Every transform, surface, camera and group is a node of the object's name. Transforms interpolate channel by
/// channel, points linearly, visibility takes the nearest sample. Instances are expanded and share their meshes. Faces
/// are turned counter-clockwise (archives have them clockwise) unless the archive's own normals say that they are
/// already; v grows downwards. A surface whose topology changes is one mesh for each topology. Camera: the film's frame
/// without overscan; f-stop and shutter are left out. What is not read (points, curves, patches, lights) is said in
/// Scene::warnings.
/// @throws InputError with file, place and reason; the scene is unchanged then
AlembicTiming append_alembic(const std::filesystem::path& file, Scene& scene, int parent_node, int include_index);

}  // namespace aleph
