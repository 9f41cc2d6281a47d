#pragma once
// FLIP (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images") through its own program, where
// that is installed.

#include <optional>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

/// Whether a program `flip` is on the PATH.
bool has_flip();

/// The mean FLIP error of two pictures as 8-bit sRGB, 0 to 1, at the program's own viewing distance; nothing if there
/// is no such program, or it prints no mean.
std::optional<double> run_flip(const Image<Rgb>& test, const Image<Rgb>& reference);

}  // namespace aleph
