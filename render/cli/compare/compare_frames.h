#pragma once
// `aleph compare` of two sequences of frames.

#include "render/cli/compare/compare_options.h"

namespace aleph {

/// Returns whether an argument names a sequence: a folder, or a name with a place for the frame number. An existing
/// file is a picture, whatever its name.
bool names_sequence(const std::string& argument);

/// Pairs the frames of both sequences by number, compares them and prints the result.
/// @return the exit code
/// @throws InputError naming frames without partner or maps; a frame that is unreadable or of another shape
int compare_frames(const CompareOptions& options);

}  // namespace aleph
