#pragma once
// A node's list of transform operations in scene files, to OperationStack and back.

#include <nlohmann/json.hpp>

#include "engine/json/json_ref.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Every operation is an object with one key; those that are keyed are so at the same times.
/// @throws InputError at the operation that breaks a rule
OperationStack read_operations(const JsonRef& at, const FrameRate& rate);

/// @throws InputError where channels and operations do not fit each other
nlohmann::ordered_json write_operations(const OperationStack& stack, const FrameRate& rate, const std::string& file,
                                        const std::string& place);

}  // namespace aleph
