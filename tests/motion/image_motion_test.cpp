// Image-based motion: against a slow, separate implementation of the search, and known answers.

#include <bitset>
#include <tuple>

#include "engine/base/opponent_color.h"
#include "engine/base/parallel.h"
#include "engine/base/pyramid.h"
#include "motion/image_motion.h"
#include "tests/support/image_patterns.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Offset {
    int x, y;
};

/// The documented algorithm without optimisations: every census bit and every cost is computed from scratch.
struct SlowSearch {
    std::vector<Image<float>> now, other;

    static float at(const Image<float>& image, int x, int y) {
        return image(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    }
    static std::bitset<8> census(const Image<float>& image, int x, int y) {
        std::bitset<8> bits;
        std::size_t next = 0;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (dx != 0 || dy != 0) bits[next++] = at(image, x + dx, y + dy) >= at(image, x, y);
            }
        }
        return bits;
    }
    /// The census at a place of a window that may reach over the border: of the nearest pixel inside.
    static std::bitset<8> clamped_census(const Image<float>& image, int x, int y) {
        return census(image, std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    }
    int cost(std::size_t level, int x, int y, const Offset& d) const {
        int sum = 0;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto a = clamped_census(now[level], x + dx, y + dy);
                // The target's window is clamped around the target.
                const auto b = clamped_census(other[level], x + d.x + dx, y + d.y + dy);
                sum += static_cast<int>((a ^ b).count());
            }
        }
        return sum;
    }
    /// The best of `candidates`, offsets from `start`.
    Offset best(std::size_t level, int x, int y, const Offset& start, const std::vector<Offset>& candidates) const {
        std::vector<std::tuple<int, int, int, int>> ranked;
        for (const Offset& c : candidates) {
            const Offset d{start.x + c.x, start.y + c.y};
            if (x + d.x < 0 || y + d.y < 0 || x + d.x >= now[level].width || y + d.y >= now[level].height) continue;
            ranked.emplace_back(cost(level, x, y, d), d.x * d.x + d.y * d.y, d.y, d.x);
        }
        const auto& first = *std::min_element(ranked.begin(), ranked.end());
        return {std::get<3>(first), std::get<2>(first)};
    }
    Offset search(std::size_t level, int x, int y) const {
        std::vector<Offset> candidates;
        if (level + 1 == now.size()) {
            for (int dy = -8; dy <= 8; ++dy) {
                for (int dx = -8; dx <= 8; ++dx) candidates.push_back({dx, dy});
            }
            return best(level, x, y, {0, 0}, candidates);
        }
        const Offset coarse = search(level + 1, x / 2, y / 2);
        Offset d{std::clamp(2 * coarse.x, -x, now[level].width - 1 - x),
                 std::clamp(2 * coarse.y, -y, now[level].height - 1 - y)};
        for (const int step : {4, 2, 1}) {
            candidates.clear();
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) candidates.push_back({step * dx, step * dy});
            }
            d = best(level, x, y, d, candidates);
        }
        return d;
    }
};

SlowSearch make_slow_search(const Image<Rgb>& now, const Image<Rgb>& other) {
    const int side = std::min(now.width, now.height), levels = side >= 32 ? 3 : side >= 16 ? 2 : 1;
    const auto pyramid = [&](const Image<Rgb>& image) {
        return make_gaussian_pyramid(compute_opponent(image, OpponentChannel::a, false), levels);
    };
    return {pyramid(now), pyramid(other)};
}

/// Two pictures that differ by motion, new objects, flat areas and noise.
Image<Rgb> make_scene_picture(int width, int height, double shift_x, double shift_y, std::uint32_t seed) {
    return make_pattern(width, height, [&](int x, int y) {
        if (x > width / 2 && y > height / 2) return 0.5;  // flat
        if (y < height / 4) return white_noise(x, y, seed);
        if (x < width / 3) return smooth_texture(x, y);
        return smooth_texture(x - shift_x, y - shift_y);
    });
}

TEST(ImageMotion, EqualsTheSlowReadingOfTheModel) {
    const struct {
        int width, height;
        double shift_x, shift_y;
    } cases[] = {{67, 45, 3.0, -2.0}, {48, 64, -9.5, 6.25}, {33, 32, 1.0, 0.0}, {31, 40, 4.0, 4.0},
                 {16, 17, -2.0, 1.0}, {9, 5, 1.0, 1.0},     {40, 33, 8.0, 0.0}, {33, 40, 0.0, -8.0}};
    for (const auto& c : cases) {
        SCOPED_TRACE(testing::Message() << c.width << "x" << c.height);
        const Image<Rgb> now = make_scene_picture(c.width, c.height, 0.0, 0.0, 1);
        const Image<Rgb> other = make_scene_picture(c.width, c.height, c.shift_x, c.shift_y, 2);
        const MotionField field = compute_image_motion(now, other);
        const SlowSearch slow = make_slow_search(now, other);
        int different = 0, moving = 0;
        for (int y = 0; y < c.height; ++y) {
            for (int x = 0; x < c.width; ++x) {
                const Offset truth = slow.search(0, x, y);
                const glm::dvec2& found = field.displacement(x, y);
                different += found != glm::dvec2(truth.x, truth.y);
                moving += truth.x != 0 || truth.y != 0;
                EXPECT_EQ(field.path_length(x, y), std::hypot(found.x, found.y));
                EXPECT_EQ(field.validity(x, y), MotionValidity::valid);
            }
        }
        EXPECT_EQ(different, 0);
        EXPECT_GT(moving, c.width * c.height / 10);
    }
}

TEST(ImageMotion, CensusBitsOfThesisFigure53) {
    // Neighbours of 5 that are not less than it, in raster order, as the figure's bits say: 00110110.
    Image<float> image(3, 3);
    image.pixels = {1, 2, 7, 8, 5, 3, 6, 9, 4};
    const CensusLevel census = make_census_level(image);
    EXPECT_EQ(std::bitset<8>(census.row(1)[1]).to_string(), "00110110");
    // The border repeats the edge's census.
    EXPECT_EQ(census.row(-1)[-1], census.row(0)[0]);
    EXPECT_EQ(census.row(-1)[3], census.row(0)[2]);
    EXPECT_EQ(census.row(3)[3], census.row(2)[2]);
    EXPECT_EQ(census.row(1)[-1], census.row(1)[0]);
    // An equal neighbour counts as 1, and beyond the border lies the pixel itself.
    const CensusLevel flat = make_census_level(Image<float>(2, 2, 0.5f));
    EXPECT_EQ(flat.row(0)[0], 0xff);
}

TEST(ImageMotion, ReachesFiftyThreePixels) {
    // 53 = 4 * 8 + 2 * 7 + 7. Between two unrelated pictures some pixel moves by the full reach.
    const auto longest = [](int width, int height) {
        const auto noise = [&](std::uint32_t seed) {
            return make_pattern(width, height, [=](int x, int y) { return white_noise(x, y, seed); });
        };
        double most = 0.0;  // in one axis
        for (const glm::dvec2& d : compute_image_motion(noise(1), noise(2)).displacement.pixels) {
            most = std::max({most, std::abs(d.x), std::abs(d.y)});
        }
        return most;
    };
    EXPECT_EQ(longest(1600, 900), 53.0);
    EXPECT_EQ(longest(400, 24), 23.0);
    EXPECT_EQ(longest(400, 15), 8.0);
}

TEST(ImageMotion, SameForAnyNumberOfThreads) {
    const Image<Rgb> now = make_scene_picture(130, 97, 0, 0, 1), other = make_scene_picture(130, 97, 5, 3, 2);
    const auto run = [&](int threads) {
        const ThreadLimit limit(threads);
        return compute_image_motion(now, other).displacement;
    };
    const Image<glm::dvec2> one = run(1);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(7));
}

TEST(ImageMotion, SizesMustAgree) {
    const Image<Rgb> a(8, 8), b(8, 9), none;
    EXPECT_THROW(compute_image_motion(a, b), InputError);
    EXPECT_THROW(compute_image_motion(a, none), InputError);
    EXPECT_THROW(compute_image_motion(none, a), InputError);
}

}  // namespace
}  // namespace aleph
