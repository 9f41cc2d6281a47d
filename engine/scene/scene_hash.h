#pragma once
// Fingerprints of bytes and of a scene's content, to recognise results that were computed from them.

#include <string>
#include <string_view>

#include "engine/scene/scene.h"

namespace aleph {

/// SHA-1 of everything that a picture of the scene may depend on, 40 hexadecimal digits. Names, the file's path,
/// includes, settings and warnings do not count.
std::string hash_scene(const Scene& scene);

/// SHA-1 of the bytes, 40 hexadecimal digits.
std::string hash_bytes(std::string_view bytes);

}  // namespace aleph
