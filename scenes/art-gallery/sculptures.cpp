// Sculptures on plinths: rings, vases, a bowl, and a knot that turns.

#include <fmt/format.h>

#include <cmath>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

/// A square plinth with foot and cap. Returns its height, m.
double add_plinth(const Group& parent, const std::string& name, const glm::dvec3& place, double width, double height,
                  int material) {
    parent.add_shape(name + "_foot", box({width + 0.06, 0.08, width + 0.06}), material,
                     place + glm::dvec3(0.0, 0.04, 0.0));
    parent.add_shape(name + "_shaft", box({width, height - 0.12, width}), material,
                     place + glm::dvec3(0.0, 0.02 + 0.5 * height, 0.0));
    parent.add_shape(name + "_cap", box({width + 0.05, 0.04, width + 0.05}), material,
                     place + glm::dvec3(0.0, height - 0.02, 0.0));
    return height;
}

/// Three interlocked rings.
void add_rings(Scene& scene, const Group& sculptures, const GalleryMaterials& materials) {
    const int red = add_lambert(scene, "ring_red", {196, 52, 38}, 0.3);
    const int ivory = add_lambert(scene, "ring_ivory", {236, 226, 204}, 0.3);
    const int ink = add_lambert(scene, "ring_ink", {38, 50, 84}, 0.3);

    const glm::dvec3 rings(4.1, 0.0, -2.55);
    const double top = add_plinth(sculptures, "rings_plinth", rings, 0.5, 0.95, materials.plinth);
    const Group group = sculptures.add_group("rings", rings + glm::dvec3(0.0, top + 0.36, 0.0), turn(y_axis, 25.0));
    group.add_shape("ring_a", torus(0.28, 0.06, 64), red, {-0.13, 0.0, 0.0}, z_to_up);
    group.add_shape("ring_b", torus(0.28, 0.06, 64), ivory, {0.13, 0.0, 0.0}, turn(x_axis, 25.0));
    group.add_shape("ring_c", torus(0.19, 0.045, 64), ink, {0.0, 0.2, 0.0}, turn(z_axis, 70.0));
}

void add_vases(Scene& scene, const Group& sculptures, const GalleryMaterials& materials) {
    const int clay = add_textured(scene, "terracotta", "terracotta");
    const int celadon = add_lambert(scene, "celadon", {142, 180, 160}, 0.2);
    const int cobalt = add_lambert(scene, "cobalt", {30, 62, 150}, 0.15);
    const Profile amphora_outline = {{0.0, 0.0},    {0.09, 0.0},  {0.09, 0.0},  {0.095, 0.02}, {0.06, 0.045},
                                     {0.075, 0.08}, {0.17, 0.26}, {0.2, 0.4},   {0.17, 0.52},  {0.085, 0.6},
                                     {0.07, 0.66},  {0.075, 0.7}, {0.12, 0.73}, {0.12, 0.745}, {0.1, 0.745},
                                     {0.06, 0.7},   {0.055, 0.64}};
    const Shape amphora = lathe(amphora_outline, 72);
    const Profile bottle_outline = {{0.0, 0.0},    {0.08, 0.0},  {0.08, 0.0},   {0.13, 0.05},
                                    {0.165, 0.15}, {0.14, 0.26}, {0.06, 0.36},  {0.035, 0.46},
                                    {0.034, 0.56}, {0.05, 0.62}, {0.042, 0.62}, {0.026, 0.55}};
    const Shape bottle = lathe(bottle_outline, 64);
    const Profile bowl_outline = {{0.0, 0.0},   {0.09, 0.0},  {0.09, 0.0},  {0.085, 0.02},  {0.1, 0.035},
                                  {0.2, 0.1},   {0.26, 0.2},  {0.27, 0.24}, {0.262, 0.245}, {0.245, 0.2},
                                  {0.18, 0.11}, {0.06, 0.06}, {0.0, 0.055}};
    const Shape bowl = lathe(bowl_outline, 64);
    const glm::dvec3 places[] = {{-5.45, 0.0, 3.2}, {5.3, 0.0, 3.1}, {-1.1, 0.0, -3.2}};
    const Shape shapes[] = {amphora, amphora, bottle};
    const int glazes[] = {clay, cobalt, celadon};
    for (int i = 0; i < 3; ++i) {
        const std::string name = fmt::format("vase_{}", i);
        const double h =
            add_plinth(sculptures, name + "_plinth", places[i], 0.42, 0.85 + 0.1 * (i % 2), materials.plinth);
        sculptures.add_shape(name, shapes[i], glazes[i], places[i] + glm::dvec3(0.0, h, 0.0));
    }
    const double h = add_plinth(sculptures, "bowl_plinth", {0.75, 0.0, -3.1}, 0.46, 0.8, materials.plinth);
    sculptures.add_shape("bowl", bowl, cobalt, {0.75, h, -3.1});
    const double low = add_plinth(sculptures, "cabinet_vase_plinth", {-9.7, 0.0, 2.1}, 0.42, 0.9, materials.plinth);
    sculptures.add_shape("cabinet_vase", amphora, celadon, {-9.7, low, 2.1});
}

/// A knot of a flat band that turns slowly in the cabinet.
void add_knot(Scene& scene, const Group& sculptures, const GalleryMaterials& materials) {
    const glm::dvec3 place(-8.1, 0.0, 0.0);
    const double height = add_plinth(sculptures, "knot_plinth", place, 0.7, 0.72, materials.plinth);
    const int bronze = add_lambert(scene, "knot_bronze", {214, 148, 70}, 0.33);
    const CageShape knot = make_closed_tube(
        [](double t) {
            const double a = 2.0 * pi * t;
            return 0.21 * glm::dvec3(std::sin(a) + 2.0 * std::sin(2.0 * a), std::cos(a) - 2.0 * std::cos(2.0 * a),
                                     -1.5 * std::sin(3.0 * a));
        },
        60, 8, {0.13, 0.06}, 3);
    const int node = add_cage_node(sculptures, "knot", knot, bronze, place + glm::dvec3(0.0, height + 0.72, 0.0));
    scene.nodes[node].transform.axis_rotation =
        AxisRotation{.angle = even_track(0.0, gallery_seconds, 0.0, 2.0 * pi * 1.25)};
}

}  // namespace

void add_sculptures(Scene& scene, const GalleryMaterials& materials) {
    const Group sculptures = Group{scene}.add_group("sculptures");
    add_rings(scene, sculptures, materials);
    add_vases(scene, sculptures, materials);
    add_knot(scene, sculptures, materials);
}

}  // namespace aleph
