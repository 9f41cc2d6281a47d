#include <fmt/format.h>

#include "scenes/common/build.h"
#include "scenes/pool/pool_scene.h"

namespace aleph {

void add_table(Scene& scene, const PoolSettings& settings) {
    const int cloth = add_textured(scene, "cloth", "felt");
    const int cushion = add_textured(scene, "cushion", "felt");
    scene.materials.back().base_color = glm::dvec3(0.8);
    const int wood = add_textured(scene, "rail", "rail");
    const int dark = add_lambert(scene, "table_body", {74, 36, 20});
    const int pearl = add_lambert(scene, "pearl", {232, 228, 214});

    const double length = settings.length, width = settings.width;
    const double nose = 0.05, rail = 0.13, height = 0.042;  // m: cushion and rail widths, top above the cloth
    const Group table = Group{scene}.add_group("table", {0.0, cloth_height, 0.0});
    table.add_shape("bed", box({length + 2.0 * nose, 0.04, width + 2.0 * nose}, {9.0, 5.0}), cloth, {0.0, -0.02, 0.0});
    for (const auto& [side, letter] : both_sides) {
        // Cushions start a little below the cloth, so that no two faces share a plane.
        table.add_shape("cushion_long_" + letter, box({length + 2.0 * nose, height, nose}, {9.0, 0.4}), cushion,
                        {0.0, 0.5 * height - 0.004, side * 0.5 * (width + nose)});
        table.add_shape("cushion_short_" + letter, box({nose, height, width}, {0.4, 4.0}), cushion,
                        {side * 0.5 * (length + nose), 0.5 * height - 0.004, 0.0});
        // The grain runs along u: short rails are long ones turned.
        const double out = nose + 0.5 * rail, top = 0.04;
        table.add_shape("rail_long_" + letter, box({length + 2.0 * (nose + rail), 0.08, rail}, {3.0, 1.0}), wood,
                        {0.0, top - 0.04, side * (0.5 * width + out)});
        table.add_shape("rail_short_" + letter, box({width + 2.0 * nose, 0.08, rail}, {1.6, 1.0}), wood,
                        {side * (0.5 * length + out), top - 0.04, 0.0}, z_to_plus_x);
        table.add_shape("apron_long_" + letter, box({length + 0.2, 0.16, 0.03}, {3.0, 0.8}), wood,
                        {0.0, top - 0.15, side * (0.5 * width + out)});
        table.add_shape("apron_short_" + letter, box({width + 0.26, 0.16, 0.03}, {1.6, 0.8}), wood,
                        {side * (0.5 * length + out), top - 0.15, 0.0}, z_to_plus_x);
        for (int i = 1; i <= 3; ++i) {
            table.add_shape(fmt::format("sight_short_{}_{}", letter, i), cylinder(0.007, 0.002, 16), pearl,
                            {side * (0.5 * length + out), top + 0.0005, (i - 2) * 0.25 * width});
        }
        for (int i = 1; i <= 7; ++i) {
            if (i == 4) continue;  // where a pocket would be
            table.add_shape(fmt::format("sight_long_{}_{}", letter, i), cylinder(0.007, 0.002, 16), pearl,
                            {(i - 4) * 0.125 * length, top + 0.0005, side * (0.5 * width + out)});
        }
        for (const auto& [end, end_letter] : both_sides) {
            const double leg = 0.16, under = cloth_height - 0.1;
            table.add_shape(fmt::format("leg_{}_{}", letter, end_letter), box({leg, under, leg}), dark,
                            {side * (0.5 * length - 0.1), -cloth_height + 0.5 * under, end * (0.5 * width - 0.1)});
        }
    }
    table.add_shape("body", box({length, 0.14, width}), dark, {0.0, -0.11, 0.0});
}

}  // namespace aleph
