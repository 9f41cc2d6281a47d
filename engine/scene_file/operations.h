#pragma once
// The list of transform operations of a node in scene files: reading and writing.

#include <nlohmann/json.hpp>

#include "engine/json/json_ref.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Every operation is an object with one key. Keyed operations have the same times.
/// @throws InputError with the pointer of the faulty operation
OperationStack read_operations(const JsonRef& at, const FrameRate& rate);

/// @throws InputError if channels and operations do not match
nlohmann::ordered_json write_operations(const OperationStack& stack, const FrameRate& rate, const std::string& file,
                                        const std::string& place);

}  // namespace aleph
