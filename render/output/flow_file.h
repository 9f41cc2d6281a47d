#pragma once
// Motion in the file format of the Middlebury optical flow benchmark (Baker et al. 2011, "A Database and Evaluation
// Methodology for Optical Flow").

#include <filesystem>

#include "motion/motion_field.h"

namespace aleph {

/// Writes a .flo file: displacements in pixels, x right, y down, as 32-bit little-endian floats. Pixels whose motion is
/// not known (behind the camera, no counterpart) have 1e10, which readers take as unknown.
/// @throws OutputError naming the file
void write_flow(const std::filesystem::path& path, const MotionField& motion);

}  // namespace aleph
