#pragma once
// Names of nodes that are unique in a scene.

#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// `name`, or the kind and the number of an element without one: "node 3".
std::string name_or_number(const std::string& name, const char* kind, std::size_t index);

/// "/group/child" per node: the names from the root down. Nodes with equal paths get "#2", "#3", ... in node order.
std::vector<std::string> node_paths(const Scene& scene);

}  // namespace aleph
