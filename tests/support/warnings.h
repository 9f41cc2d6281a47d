#pragma once
// Warnings of a scene.

#include <algorithm>
#include <cstddef>
#include <string>

#include "engine/scene/scene.h"

namespace aleph {

inline std::ptrdiff_t count_warnings(const Scene& scene, const std::string& words) {
    return std::ranges::count_if(scene.source.warnings,
                                 [&](const std::string& text) { return text.find(words) != std::string::npos; });
}

inline bool has_warning(const Scene& scene, const std::string& words) {
    return count_warnings(scene, words) > 0;
}

}  // namespace aleph
