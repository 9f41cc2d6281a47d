#pragma once

#include "engine/scene/scene.h"

namespace aleph {

inline Node child_of(int parent, const glm::dvec3& translation = glm::dvec3(0.0)) {
    return {.parent = parent, .transform = {.translation = translation}};
}

}  // namespace aleph
