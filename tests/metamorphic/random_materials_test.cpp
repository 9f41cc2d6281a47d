// Pictures with an asked error against path tracing, in scenes made at random: all kinds of surfaces and lights, open
// under a sky or between walls. Lobes are wide, so that paths find all light soon.

#include <iostream>

#include "render/frame/sequence.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int columns = 32, rows = 24, block = 8;

class Chance {
  public:
    explicit Chance(std::uint32_t seed) : bits_(seed) {}
    double between(double low, double high) { return low + (high - low) * bits_() / 4294967296.0; }
    int below(int count) { return static_cast<int>(bits_() % static_cast<std::uint32_t>(count)); }
    glm::dvec3 color() {
        const double red = between(0.1, 0.9), green = between(0.1, 0.9);
        return {red, green, between(0.1, 0.9)};
    }

  private:
    std::mt19937 bits_;
};

int add_material(Scene& scene, Chance& chance) {
    Material m{.base_color = chance.color(), .gloss = {.metallic = 0.0, .roughness = chance.between(0.4, 1.0)}};
    switch (chance.below(7)) {
        case 0:
            m.gloss.specular = 0.0;
            break;
        case 1:
            m.gloss.metallic = 1.0;
            break;
        case 2:
            m.layers.clearcoat = chance.between(0.3, 1.0);
            m.layers.clearcoat_roughness = chance.between(0.4, 0.9);
            break;
        case 3:
            m.layers.sheen_color = {glm::dvec3(0.5)};
            m.layers.sheen_roughness = chance.between(0.2, 1.0);
            break;
        case 4:  // tinted glass
            m.base_color = glm::dvec3(1.0);
            m.glass = {1.0, 1.0, 0.7, {glm::dvec3(0.8, 1.0, 0.6)}};
            break;
        case 5:  // a sheet
            m.gloss.roughness = 0.0;
            m.glass.transmission = 0.9;
            break;
        default:
            break;
    }
    scene.materials.push_back(m);
    return static_cast<int>(scene.materials.size()) - 1;
}

void add_walls(Scene& scene, Chance& chance) {
    const auto add_wall = [&](const glm::dvec3& place, const glm::dquat& turn) {
        const int wall = add_lambert(scene, chance.color(), glm::dvec3(0.0), true);
        scene.materials[wall].gloss = {.metallic = 0.0, .roughness = chance.between(0.4, 1.0)};
        add_mesh(scene, make_quad(8.0, 8.0, wall), place, turn);
    };
    add_wall({0.0, 4.0, -4.0}, no_turn);
    add_wall({-4.0, 4.0, 0.0}, turn_about_y(0.5 * std::numbers::pi));
    add_wall({0.0, 4.0, 0.0}, z_to_down);
}

/// Every second one has walls. One side is open.
Scene make_scene(int number) {
    Chance chance(static_cast<std::uint32_t>(number));
    Scene scene;
    scene.film.exposure = 1.0;
    const bool walls = number % 2 == 1;
    const int floor = add_lambert(scene, chance.color());
    scene.materials[floor].gloss = {.metallic = 0.0, .roughness = chance.between(0.3, 1.0)};
    add_mesh(scene, make_quad(walls ? 8.0 : 60.0, walls ? 8.0 : 60.0, floor), glm::dvec3(0.0), z_to_up);
    if (walls) add_walls(scene, chance);
    if (!walls || chance.below(2) == 0) scene.environment.radiance = Track<glm::dvec3>(chance.color());
    for (int i = 0, count = 2 + chance.below(4); i < count; ++i) {
        const double size = chance.between(0.3, 0.9);
        const int material = add_material(scene, chance);
        const Mesh mesh =
            chance.below(2) == 0 ? make_faceted_sphere(size, 24, material) : make_box(glm::dvec3(size), material);
        const double x = chance.between(-2.5, 2.5), y = size + chance.between(0.0, 0.6);
        add_mesh(scene, mesh, {x, y, chance.between(-3.0, 1.0)}, turn_about_y(chance.between(0.0, 3.0)));
    }
    for (int i = 0, count = 1 + chance.below(2); i < count; ++i) {
        const glm::dvec3 place(chance.between(-2.0, 2.0), 3.5, chance.between(-2.0, 2.0));
        if (chance.below(2) == 0) {
            add_lamp(scene, chance.between(0.3, 2.0), glm::dvec3(6.0, 5.0, 4.0), place);
        } else {
            add_light(scene, Light::Kind::point, glm::dvec3(10.0), place);
        }
    }
    add_camera(scene, {chance.between(-1.0, 1.0), 1.5, 5.0}, {0.0, 0.8, -1.0}, 1.0);
    return scene;
}

/// Means of blocks of pixels.
std::vector<double> render_blocks(const Scene& scene, const RenderSettings& settings) {
    const Image<Rgb> color = Sequence(scene, settings).render(0).shaded.color;
    std::vector<double> blocks(columns / block * (rows / block));
    for (const auto [x, y] : all_pixels(columns, rows))
        blocks[y / block * (columns / block) + x / block] += luminance(color(x, y)) / (block * block);
    return blocks;
}

TEST(RandomMaterials, AskedErrorAgreesWithPaths) {
    double worst = 0.0;
    Mean bias;
    for (int number = 0; number < 16; ++number) {
        const Scene scene = make_scene(number);
        RenderSettings asked{.picture = {.width = columns, .height = rows, .filter = PixelFilter::box}};
        follow_error(asked, 1.0);
        RenderSettings paths = traced_reference_settings(asked);
        paths.sampling.spp = 256;
        paths.seed = 1;
        const std::vector<double> found = render_blocks(scene, asked), truth = render_blocks(scene, paths);
        double sum = 0.0, expected = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const double off = std::abs(found[i] / truth[i] - 1.0);
            EXPECT_LT(off, 0.08) << "scene " << number << ", block " << i;
            worst = std::max(worst, off);
            sum += found[i];
            expected += truth[i];
        }
        EXPECT_NEAR(sum / expected, 1.0, 0.01) << "scene " << number;
        bias.add(sum / expected - 1.0);
    }
    EXPECT_LT(std::abs(bias.mean()), 0.002);
    std::cout << "worst block " << worst << ", bias " << bias.mean() << " +- " << bias.error() << std::endl;
}

}  // namespace
}  // namespace aleph
