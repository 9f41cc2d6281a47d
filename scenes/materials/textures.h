#pragma once
// The pictures of scenes/materials.
//   bricks.png, bricks_normal.png   four courses of bricks: colour, and normals in tangent space
//   sky.exr                         an equirectangular sky with a sun, radiance in units of a white wall's

#include <filesystem>

namespace aleph {

/// Writes them into a folder; creates the folder if needed.
void write_materials_textures(const std::filesystem::path& folder);

}  // namespace aleph
