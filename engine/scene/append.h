#pragma once
// Appends elements to their lists, and the content of an included file to the scene that includes it.

#include <optional>
#include <type_traits>

#include "engine/scene/scene.h"

namespace aleph {

/// @return the element's index
template <class Element>
int append(std::vector<Element>& list, std::type_identity_t<Element> element) {
    list.push_back(std::move(element));
    return static_cast<int>(list.size()) - 1;
}

/// Frame rate and times that a file states, for a scene that consists of that file.
struct FileTiming {
    std::optional<FrameRate> frame_rate{};
    std::optional<double> first{}, last{};  ///< sample of what changes, s; unset where nothing does
};

/// Appends every list of elements, and the warnings, and shifts the indices. If memory runs out the scene stays as it
/// was.
/// @param parent_node  of the part's roots
/// @param include  index of the include that the part comes from
void append_part(Scene& scene, Scene&& part, int parent_node, int include);

/// Shows what an include brought, nodes `begin` to `end`, a second time: copies that share its meshes, lights and
/// cameras. Other parameters as in append_part.
void append_copy(Scene& scene, int begin, int end, int parent_node, int include);

/// True for nodes that append_copy can show: a mesh with a skin or morph targets stands under one node only.
bool can_be_copied(const Scene& scene, int begin, int end);

}  // namespace aleph
