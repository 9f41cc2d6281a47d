#pragma once
// Scenes that are read from short texts.

#include <string>

#include "engine/scene_file/scene_text.h"

namespace aleph {

/// @param body  what follows the version: nothing, or a comma and more
inline Scene read(const std::string& body) {
    return read_scene_text("{\"aleph\": 1" + body + "}", "test.json").scene;
}

/// @param node  what stands in the only node
inline Scene read_node(const std::string& node) {
    return read(", \"nodes\": [{" + node + "}]");
}

}  // namespace aleph
