#pragma once
// A file's content on its way into the scene that includes it.

#include "engine/scene/scene.h"

namespace aleph {

/// Puts every list of elements, and the warnings, behind the scene's own, and makes the indices those that the elements
/// have there. The scene stays as it was where memory runs out.
/// @param parent_node  of the part's roots
/// @param include  which include brought it
void append_part(Scene& scene, Scene&& part, int parent_node, int include);

}  // namespace aleph
