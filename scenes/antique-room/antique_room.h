#pragma once
// The parts of the scene `antique-room`. Metres; the floor is y = 0; the window is in the wall at low x, the fireplace
// in the wall at low z.

#include <vector>

#include "engine/scene/scene.h"
#include "scenes/common/generator.h"

namespace aleph {

inline constexpr int antique_last_frame = 119;  ///< the first is 0; 30 frames per second
inline constexpr glm::dvec3 antique_low{-2.7, 0.0, -2.4}, antique_high{2.7, 2.95, 2.5};

/// Drawn from formulas, deterministic: "boards", "walnut", "damask", "rug", "dial", "globe", "spine", "stone",
/// "velvet", the view "garden", and the paintings "ship", "valley", "iris".
std::vector<DrawnTexture> make_antique_textures();

/// @param textures  folder of the textures, relative to the scene file
Scene make_antique_room(const std::string& textures);

/// Materials shared by several parts.
struct AntiqueMaterials {
    int paper, panel, walnut, mahogany, boards, ceiling, stone, brass, gilt, cloth, leather, ivory, black, green,
        porcelain;
};

void add_antique_shell(Scene& scene, const AntiqueMaterials& materials);
void add_antique_window(Scene& scene, const AntiqueMaterials& materials);
void add_fireplace(Scene& scene, const AntiqueMaterials& materials);
void add_antique_pictures(Scene& scene, const AntiqueMaterials& materials);
void add_table_and_chairs(Scene& scene, const AntiqueMaterials& materials);
void add_armchair(Scene& scene, const AntiqueMaterials& materials);
void add_side_table(Scene& scene, const AntiqueMaterials& materials);
void add_bookcase(Scene& scene, const AntiqueMaterials& materials);
void add_tall_clock(Scene& scene, const AntiqueMaterials& materials);
void add_globe(Scene& scene, const AntiqueMaterials& materials);
void add_antique_camera(Scene& scene);

}  // namespace aleph
