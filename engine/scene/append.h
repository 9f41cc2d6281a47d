#pragma once
// Appends the content of an included file to the scene that includes it.

#include "engine/scene/scene.h"

namespace aleph {

/// Appends every list of elements, and the warnings, and shifts the indices accordingly. If memory runs out the scene
/// stays as it was.
/// @param parent_node  becomes the parent of the part's roots
/// @param include  index of the include that the part comes from
void append_part(Scene& scene, Scene&& part, int parent_node, int include);

}  // namespace aleph
