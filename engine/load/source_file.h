#pragma once
// Which file an element came from.

#include <filesystem>
#include <string>

#include "engine/scene/scene.h"

namespace aleph {

/// The path of the file that brought an element: of the include, or of the scene itself for no_index.
inline std::string source_file(const Scene& scene, int include) {
    if (include == no_index) return scene.source.file;
    return (std::filesystem::path(scene.source.file).parent_path() / scene.source.includes[include].path).string();
}

}  // namespace aleph
