#pragma once
// Pictures of visible differences.

#include <filesystem>

#include "render/compare/visible_difference.h"

namespace aleph {

/// Writes seen, flicker and lasting in just visible differences: as the channels seen.Y, flicker.Y and lasting.Y if the
/// path ends in .exr, else as three panels with a colour scale from .1 to 10.
/// @throws OutputError naming the file
void write_seen(const std::filesystem::path& path, const VisibleMaps& maps);

}  // namespace aleph
