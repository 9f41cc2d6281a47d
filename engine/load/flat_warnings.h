#pragma once
// Warnings about objects without volume, which rays leave out (RayScene::update).

#include "engine/load/scene_format.h"

namespace aleph {

/// Warns of nodes with meshes whose transform flattens them on the first, the middle and the last frame. Scales that
/// are 0 for a while are a common way to hide an object.
void add_flat_warnings(Scene& scene, const SceneFormats& formats);

}  // namespace aleph
