// The irradiance cache against path tracing in rooms made at random: six accuracies, one to three bounces.

#include <iostream>

#include "tests/support/render_scenes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

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

// About one and a half times what these rooms have, so that a cache that is twice as wrong fails. With accuracy 0
// irradiance is gathered at every pixel, with no error but noise.
constexpr std::array accuracies{Accuracy{0.8, 0.12},  Accuracy{0.4, 0.06},   Accuracy{0.2, 0.04},
                                Accuracy{0.1, 0.025}, Accuracy{0.05, 0.015}, Accuracy{0.0, 0.02}};

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
                settings.light.light_samples = 1;
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

INSTANTIATE_TEST_SUITE_P(Bounces, RandomRooms, testing::Values(Case{1, 20}, Case{2, 10}, Case{3, 10}));

}  // namespace
}  // namespace aleph
