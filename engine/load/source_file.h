#pragma once
// Which file an element came from.

#include <filesystem>
#include <string>

#include "engine/scene/scene.h"

namespace aleph {

/// The path of the file that brought an element: of the include, or of the scene itself for no_index.
inline std::string source_file(const Scene& scene, int include) {
    if (include == no_index) return scene.file;
    return (std::filesystem::path(scene.file).parent_path() / scene.includes[include].path).string();
}

}  // namespace aleph
