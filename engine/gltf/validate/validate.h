#pragma once
// Checks raw glTF JSON before any library sees it. tinygltf 2.7 parses and does not validate: it indexes by unchecked
// numbers and follows any path.

#include <string>
#include <vector>

#include "engine/json/json_ref.h"

namespace aleph {

/// Checks everything that the reader uses: types, indices, ranges, the node graph, uses of accessors, features.
/// Byte ranges are checked against the stated byteLength of the buffers. Loading a buffer checks that against its
/// bytes.
/// @param has_binary_chunk  the file is a container with a BIN chunk: buffer 0 needs no URI
/// @param warnings          gets a line for each feature that is ignored
/// @throws InputError naming the place as a JSON pointer, and the rule or the feature that is not supported
void validate_gltf(const JsonRef& root, bool has_binary_chunk, std::vector<std::string>& warnings);

}  // namespace aleph
