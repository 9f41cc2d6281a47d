// Scenes made at random against path tracing: the irradiance cache in rooms, at six accuracies and with one and three
// bounces; and pictures with an asked error of all kinds of surfaces and lights, under a sky or between walls.

#include <iostream>

#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 16, height = 12;

/// A closed room with boxes, one or two lamps without area, and a camera in a corner. All surfaces are Lambert.
Scene make_room(std::uint32_t seed) {
    std::mt19937 bits(seed);
    const auto between = [&](double low, double high) { return low + (high - low) * bits() / 4294967296.0; };
    const auto color = [&] { return glm::dvec3(between(0.1, 0.8), between(0.1, 0.8), between(0.1, 0.8)); };
    Scene scene;
    const glm::dvec3 size(between(3.0, 6.0), between(2.5, 4.0), between(3.0, 6.0));
    const glm::dvec3 half = 0.5 * size;
    add_mesh(scene, make_box(size, add_lambert(scene, color(), glm::dvec3(0.0), true)));
    for (std::uint32_t i = 0, count = 1 + bits() % 5; i < count; ++i) {
        const glm::dvec3 box(between(0.3, 1.0), between(0.3, 1.5), between(0.3, 1.0));
        const double x = between(-0.4, 0.4) * size.x, z = between(-0.4, 0.3) * size.z;
        add_mesh(scene, make_box(box, add_lambert(scene, color())), {x, 0.5 * box.y - half.y, z},
                 turn_about_y(between(0.0, 3.0)));
    }
    for (std::uint32_t i = 0, count = 1 + bits() % 2; i < count; ++i) {
        const glm::dvec3 place(between(-0.35, 0.35) * size.x, 0.3 * size.y, between(-0.35, 0.35) * size.z);
        add_light(scene, Light::Kind::point, between(5.0, 30.0) * color(), place);
    }
    add_camera(scene, {0.9 * half.x, 0.5 * half.y, 0.9 * half.z}, {-0.3 * half.x, -0.4 * half.y, -0.5 * half.z});
    return scene;
}

/// Mean of path-traced pictures of the pixels' centres, as the cache's pictures are.
Image<Rgb> trace(const Stage& stage, int bounces, std::uint32_t seed) {
    constexpr std::uint32_t pictures = 64;
    Image<Rgb> mean(width, height, Rgb(0.0f));
    for (std::uint32_t i = 0; i < pictures; ++i) {
        const Image<Rgb> picture = shade(stage, path_settings(bounces, 1, seed * pictures + i)).color;
        for (std::size_t p = 0; p < mean.size(); ++p)
            mean.pixels[p] += picture.pixels[p] / static_cast<float>(pictures);
    }
    return mean;
}

/// Mean over the pixels of the product of two differences, relative to the squared mean. With independent references
/// b and c it expects the squared error of a, without the noise of b and c.
double relative_square(const Image<Rgb>& a, const Image<Rgb>& b, const Image<Rgb>& c) {
    double product = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double value = luminance(a.pixels[i]), x = luminance(b.pixels[i]), y = luminance(c.pixels[i]);
        product += (value - x) * (value - y);
        sum += 0.5 * (x + y);
    }
    return product * static_cast<double>(a.size()) / (sum * sum);
}

struct Accuracy {
    double value;
    double bound;  ///< of the error, relative to the mean of the picture
};

// About one and a half times what these rooms have. With accuracy 0 irradiance is gathered at every pixel, with no
// error but noise.
constexpr std::array accuracies{Accuracy{0.8, 0.12}, Accuracy{0.4, 0.05},   Accuracy{0.2, 0.03},
                                Accuracy{0.1, 0.02}, Accuracy{0.05, 0.015}, Accuracy{0.0, 0.015}};

/// Time grows with the bounces.
struct Case {
    int bounces;
    std::uint32_t rooms;
};

class RandomRooms : public testing::TestWithParam<Case> {};

TEST_P(RandomRooms, ErrorSinksWithTheAccuracy) {
    const auto [bounces, rooms] = GetParam();
    EXPECT_TRUE(holds([bounces = bounces, rooms = rooms](Trial& trial) {
        std::array<Mean, accuracies.size()> squares, change, bias;
        for (std::uint32_t room = 0; room < trial.times(rooms); ++room) {
            const Stage stage(make_room(1000 * (trial.seed + 1) + room), width, height);
            const Image<Rgb> one = trace(stage, bounces, 2 * room);
            const Image<Rgb> two = trace(stage, bounces, 2 * room + 1);
            double coarser = 0.0;
            for (std::size_t i = 0; i < accuracies.size(); ++i) {
                RenderSettings settings = plain_settings(accuracies[i].value, 0);
                settings.light.bounces = bounces;
                settings.light.light_samples = 256;  // which lamp is chosen is no error of the cache
                if (!(accuracies[i].value > 0.0)) settings.cache.gather = 512;
                settings.seed = 100'000 + room;
                const Image<Rgb> cached = shade(stage, settings).color;
                const double square = relative_square(cached, one, two);
                squares[i].add(square);
                if (i > 0) change[i].add(square - coarser);
                coarser = square;
                double sum = 0.0, reference = 0.0;
                for (std::size_t p = 0; p < cached.size(); ++p) {
                    sum += luminance(cached.pixels[p]);
                    reference += 0.5 * (luminance(one.pixels[p]) + luminance(two.pixels[p]));
                }
                bias[i].add(sum / reference - 1.0);
            }
        }
        for (std::size_t i = 0; i < accuracies.size(); ++i) {
            std::cout << bounces << " bounces, accuracy " << accuracies[i].value << ": error "
                      << std::sqrt(std::max(0.0, squares[i].mean())) << ", mean " << bias[i].mean() << " +- "
                      << bias[i].error() << std::endl;
            trial.at_most(squares[i], accuracies[i].bound * accuracies[i].bound);
            if (i > 0 && accuracies[i].value > 0.0) trial.at_most(change[i], 0.0);
            trial.near(bias[i], 0.0, 0.05 * accuracies[i].value);
        }
        trial.at_most(squares.back().mean() - 0.25 * squares.front().mean(), squares.back().error(), 0.0);
    }));
}

INSTANTIATE_TEST_SUITE_P(Bounces, RandomRooms, testing::Values(Case{1, 20}, Case{3, 10}));

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
