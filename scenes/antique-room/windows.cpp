// The window with the garden, its curtains, and the window behind the camera that lights the room.

#include <fmt/format.h>

#include "scenes/antique-room/antique_room.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"

namespace aleph {

namespace {

/// A window: posts and bars in front of an emissive picture, and a sill below.
void add_casement(const Group& window, const std::string& name, const glm::dvec2& size, int outside, int paint) {
    window.add_shape(name + "_sky", quad(size.x, size.y), outside, {0.0, 0.0, 0.012});
    const Profile casing = {{-0.02, 0.0},  {-0.02, 0.09}, {-0.02, 0.09}, {0.0, 0.1},   {0.06, 0.1},
                            {0.08, 0.085}, {0.1, 0.09},   {0.12, 0.07},  {0.12, 0.07}, {0.12, 0.0}};
    add_cage_node(window, name + "_casing", make_rectangle_moulding(size, casing, true), paint);
    for (int i = -1; i <= 1; ++i)
        window.add_shape(fmt::format("{}_post_{}", name, i + 1), box({i == 0 ? 0.06 : 0.025, size.y, 0.035}), paint,
                         {0.25 * size.x * i, 0.0, 0.07});
    for (int i = -1; i <= 1; ++i)
        window.add_shape(fmt::format("{}_bar_{}", name, i + 1), box({size.x, 0.025, 0.03}), paint,
                         {0.0, 0.25 * size.y * i, 0.07});
    window.add_shape(name + "_sill", box({size.x + 0.36, 0.04, 0.2}), paint, {0.0, -0.5 * size.y - 0.1, 0.1});
}

}  // namespace

void add_antique_window(Scene& scene, const AntiqueMaterials& materials) {
    // The garden is dim enough not to be clipped. The light of the room comes from a window behind the camera's
    // shoulder that is as bright as the sky.
    const int view = add_emitter(scene, "garden", glm::dvec3(1.0), 0.5, "garden");
    const int sky = add_emitter(scene, "daylight", {0.92, 0.96, 1.0}, 13.0);
    const int white = add_lambert(scene, "window_paint", {222, 216, 202});
    const int curtain = add_lambert(scene, "curtain", {128, 34, 40});
    scene.materials.back().double_sided = true;
    const double height = 1.75, middle = 0.98 + 0.5 * height;
    const Group window = Group{scene}.add_group("window", {antique_low.x, middle, -0.35}, z_to_plus_x);
    add_casement(window, "window", {1.5, height}, view, white);
    const Group unseen = Group{scene}.add_group("window_b", {antique_high.x, middle, 1.5}, z_to_minus_x);
    add_casement(unseen, "window_b", {1.2, height}, sky, white);

    // Curtains: a wavy path with a vertical profile.
    for (const auto& [side, letter] : both_sides) {
        std::vector<glm::dvec2> path;
        for (int i = 0; i <= 28; ++i)
            path.emplace_back(side * 0.95 + (i - 14) * 0.0135, -0.17 + (i % 2 == 0 ? 0.035 : -0.035));
        const CageShape sheet = make_moulding(path, false, {{0.0, -1.86}, {0.004, -0.8}, {0.0, 1.01}});
        add_cage_node(window, "curtain_" + letter, sheet, curtain, glm::dvec3(0.0), z_to_up);
    }
    window.add_rod("curtain_rod", {-1.3, 1.01, 0.17}, {1.3, 1.01, 0.17}, 0.018, materials.brass, 24);
    for (const auto& [side, letter] : both_sides)
        window.add_shape("curtain_knob_" + letter, sphere(0.04), materials.brass, {side * 1.32, 1.01, 0.17});
}

}  // namespace aleph
