#pragma once

#include <glm/vec3.hpp>

namespace aleph {

inline constexpr glm::vec3 up(0.0f, 1.0f, 0.0f);

}  // namespace aleph
