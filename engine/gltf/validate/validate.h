#pragma once
// Checks raw glTF JSON before any library sees it: tinygltf 2.7 is a parser, not a validator (HARD_CASES.md, section
// 12).

#include <string>
#include <vector>

#include "engine/json/json_ref.h"

namespace aleph {

/// Goes through everything that the reader uses: types, indices, ranges, the node graph, uses of accessors, features.
/// Byte ranges hold against the buffers' stated byteLength; whoever loads a buffer checks that against real bytes.
/// @param has_binary_chunk  the file is a container with a BIN chunk: buffer 0 may do without a URI
/// @param warnings          takes what is ignored
/// @throws InputError naming the place as a JSON pointer, and the rule or the feature that is not supported
void validate_gltf(const JsonRef& root, bool has_binary_chunk, std::vector<std::string>& warnings);

}  // namespace aleph
