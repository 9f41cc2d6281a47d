// Points for the samples of pixels: even in every pixel and over blocks of pixels, and independent otherwise.
// Evenly spread points.

#include "render/pixels/pixel_sequence.h"

#include <array>
#include <bit>
#include <cmath>
#include <set>

#include "tests/support/test.h"

namespace aleph {
namespace {

using Points = std::vector<glm::vec2>;

void add_points(Points& points, const PixelSequence& sequence, int first, int count,
                SampleUse use = SampleUse::light_point) {
    for (int i = first; i < first + count; ++i) points.push_back(sequence.at_2d(use, i));
}

/// Returns whether each elementary interval of as many rectangles as points, of all shapes, holds one point.
bool is_net(const Points& points) {
    const auto count = static_cast<int>(points.size());
    for (int columns = 1; columns <= count; columns *= 2) {
        const int rows = count / columns;
        std::set<int> met;
        for (const glm::vec2& p : points) {
            met.insert(static_cast<int>(p.x * static_cast<float>(columns)) * rows +
                       static_cast<int>(p.y * static_cast<float>(rows)));
        }
        if (std::ssize(met) != count) return false;
    }
    return true;
}

TEST(PixelSequence, MC04_EveryPowerOfTwoOfSamplesHasOneInEachElementaryInterval) {
    for (int pixel = 0; pixel < 40; ++pixel) {
        const PixelSequence sequence(static_cast<std::uint32_t>(pixel), 3, 5 * pixel, 1000 - pixel);
        for (const SampleUse use : {SampleUse::pixel, SampleUse::light_point}) {
            for (int k = 0; k <= 9; ++k) {
                for (const int block : {0, 1, 5}) {
                    Points points;
                    add_points(points, sequence, block << k, 1 << k, use);
                    ASSERT_TRUE(is_net(points)) << pixel << " " << k << " " << block;
                }
            }
        }
    }
}

TEST(PixelSequence, MC04_AnyNumberOfSamplesIsEven) {
    // Equal intervals of each coordinate: those of the next power of two hold at most one point, and those of the power
    // before at least one.
    for (const int count : {1, 2, 3, 7, 17, 512, 8191, 8192}) {
        const int finer = static_cast<int>(std::bit_ceil(static_cast<unsigned>(count)));
        const int coarser = static_cast<int>(std::bit_floor(static_cast<unsigned>(count)));
        for (const bool second : {false, true}) {
            std::set<int> fine, coarse;
            for (int i = 0; i < count; ++i) {
                const glm::vec2 p = PixelSequence(5, 1, 12, 9).at_2d(SampleUse::light_point, i);
                fine.insert(static_cast<int>((second ? p.y : p.x) * static_cast<float>(finer)));
                coarse.insert(static_cast<int>((second ? p.y : p.x) * static_cast<float>(coarser)));
            }
            EXPECT_EQ(std::ssize(fine), count);
            EXPECT_EQ(std::ssize(coarse), coarser) << count;
        }
    }
}

TEST(PixelSequence, MC04_BlocksOfPixelsTogetherHaveOnePointInEachElementaryInterval) {
    // Blocks begin at a place that depends on the seed: one of all places must do.
    for (const int side : {2, 4, 8}) {
        for (const int samples : {1, 2, 4, 16}) {
            int places = 0;
            for (int place = 0; place < side * side; ++place) {
                bool even = true;
                for (int block = 0; even && block < 3; ++block) {
                    Points points;
                    for (int p = 0; p < side * side; ++p) {
                        const int x = place % side + p % side + side * block, y = place / side + p / side;
                        add_points(points, PixelSequence(7, 0, x, y), 0, samples);
                    }
                    even = is_net(points);
                }
                places += even ? 1 : 0;
            }
            EXPECT_EQ(places, 1) << side << " " << samples;
        }
    }
}

using Function = std::function<float(glm::vec2)>;

/// Root mean square over 64 x 64 pixels of a picture that repeats, blurred by a Gaussian of 2 pixels.
double blurred_rms(const std::vector<double>& picture) {
    constexpr int size = 64, reach = 7;
    const auto blur = [](const std::vector<double>& from) {  // rows, and turns the picture over
        std::vector<double> to(from.size());
        for (const auto [x, y] : all_pixels(size, size)) {
            for (int i = -reach; i <= reach; ++i) {
                to[x * size + y] +=
                    from[y * size + (x + i + size) % size] * std::exp(-i * i / 8.0) / std::sqrt(8.0 * M_PI);
            }
        }
        return to;
    };
    double sum = 0.0;
    for (const double v : blur(blur(picture))) sum += v * v;
    return std::sqrt(sum / static_cast<double>(picture.size()));
}

/// Returns the blurred errors of all pixels' means, over those of the same points shifted in each pixel at random.
double blurred_against_white(const Function& f, double expected, int samples) {
    double ours = 0.0, white = 0.0;
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        std::vector<double> errors, white_errors;
        for (const auto [x, y] : all_pixels(64, 64)) {
            const PixelSequence sequence(seed, 0, x, y), origin(seed, 0, 0, 0);
            RandomStream random({seed, 0, static_cast<std::uint32_t>(64 * y + x), 0});
            const glm::vec2 shift = random.next_2d();
            double sum = 0.0, white_sum = 0.0;
            for (int i = 0; i < samples; ++i) {
                sum += f(sequence.at_2d(SampleUse::light_point, i));
                const glm::vec2 p = origin.at_2d(SampleUse::light_point, i) + shift;
                white_sum += f({p.x - std::floor(p.x), p.y - std::floor(p.y)});
            }
            errors.push_back(sum / samples - expected);
            white_errors.push_back(white_sum / samples - expected);
        }
        ours += std::pow(blurred_rms(errors), 2.0);
        white += std::pow(blurred_rms(white_errors), 2.0);
    }
    return std::sqrt(ours / white);
}

TEST(PixelSequence, ErrorsOfNeighbouringPixelsCancel) {
    for (const int samples : {4, 16}) {
        SCOPED_TRACE(samples);
        EXPECT_LT(blurred_against_white([](glm::vec2 p) { return p.x < 0.3f ? 1.0f : 0.0f; }, 0.3, samples), 0.5);
        EXPECT_LT(
            blurred_against_white([](glm::vec2 p) { return p.x < 0.6f && p.y < 0.5f ? 1.0f : 0.0f; }, 0.3, samples),
            0.5);
        EXPECT_LT(blurred_against_white([](glm::vec2 p) { return p.x * p.y; }, 0.25, samples), 0.3);
        // An oblique edge is the hardest.
        EXPECT_LT(blurred_against_white([](glm::vec2 p) { return p.x + p.y < 0.9f ? 1.0f : 0.0f; }, 0.405, samples),
                  0.6);
    }
}

TEST(PixelSequence, PointsAreUniformOverSeeds) {
    // 8 x 8 boxes; chi squared of 63 degrees of freedom is below 114 with a probability of 0.9999.
    constexpr int seeds = 6400;
    for (const int index : {0, 1, 2, 37}) {
        for (const int pixel : {0, 1, 777}) {
            std::vector<int> boxes(64);
            for (std::uint32_t seed = 0; seed < seeds; ++seed) {
                const glm::vec2 p = PixelSequence(seed, 9, pixel, pixel / 3).at_2d(SampleUse::lens, index);
                ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
                ++boxes[static_cast<int>(p.x * 8.0f) * 8 + static_cast<int>(p.y * 8.0f)];
            }
            double squares = 0.0;
            for (const int n : boxes) squares += std::pow(n - seeds / 64.0, 2.0) / (seeds / 64.0);
            EXPECT_LT(squares, 114.0) << index << " " << pixel;
        }
    }
}

double correlation(const std::function<float(int x, int y, int i)>& a,
                   const std::function<float(int x, int y, int i)>& b) {
    double sum = 0.0;
    int count = 0;
    for (const auto [x, y] : all_pixels(32, 32)) {
        for (int i = 0; i < 4; ++i, ++count) sum += (a(x, y, i) - 0.5) * (b(x, y, i) - 0.5);
    }
    return 12.0 * sum / count;
}

TEST(PixelSequence, SeedsMomentsUsesAndCoordinatesAreIndependent) {
    const auto numbers = [](std::uint32_t seed, std::uint32_t moment, SampleUse use, bool second) {
        return [=](int x, int y, int i) {
            const glm::vec2 p = PixelSequence(seed, moment, x, y).at_2d(use, i);
            return second ? p.y : p.x;
        };
    };
    double seeds = 0.0, moments = 0.0, uses = 0.0, coordinates = 0.0;
    constexpr int pairs = 100;
    for (std::uint32_t k = 0; k < pairs; ++k) {
        const auto base = numbers(k, 0, SampleUse::time, false);
        seeds += std::pow(correlation(base, numbers(k + 1, 0, SampleUse::time, false)), 2.0);
        moments += std::pow(correlation(base, numbers(k, k + 1, SampleUse::time, false)), 2.0);
        uses += std::pow(correlation(base, numbers(k, 0, SampleUse::other, false)), 2.0);
        coordinates += std::pow(correlation(base, numbers(k, 0, SampleUse::time, true)), 2.0);
    }
    // The correlation of 4096 independent pairs of numbers is 1/64 in the root mean square; points that are stratified
    // are paired less freely.
    for (const double squares : {seeds, moments, uses, coordinates}) {
        EXPECT_LT(std::sqrt(squares / pairs), 2.0 / 64.0);
    }
}

TEST(PixelSequence, PointsOfOneUseDoNotDependOnThoseBefore) {
    const PixelSequence sequence(7, 2, 31, 5);
    SequenceOfUse points = sequence.of(SampleUse::lens);
    for (const int i : {0, 1, PixelSequence::length + 3, 2, 5 * PixelSequence::length - 1, PixelSequence::length, 0}) {
        const glm::vec2 alone = sequence.at_2d(SampleUse::lens, i);
        EXPECT_EQ(points.at(i), alone) << i;
        EXPECT_EQ(sequence.at_1d(SampleUse::lens, i), alone.x);
    }
    EXPECT_NE(points.at(3), points.at(3 + PixelSequence::length));
}

TEST(PixelSequence, MC27_TimesOfEachClassAndOfAllAreEven) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        for (int k = 0; k <= 9; ++k) {
            for (const int block : {0, 1, 5}) {
                const int samples = 1 << k;
                std::array<std::set<int>, 4> cells;
                std::set<int> finer;
                for (int c = 0; c < 4; ++c) {
                    for (int i = block * samples; i < (block + 1) * samples; ++i) {
                        const float time = time_of_sample(seed, 3, i, c);
                        ASSERT_TRUE(time >= 0.0f && time < 1.0f);
                        cells[c].insert(static_cast<int>(time * static_cast<float>(samples)));
                        finer.insert(static_cast<int>(time * static_cast<float>(4 * samples)));
                    }
                    EXPECT_EQ(std::ssize(cells[c]), samples) << seed << " " << c;
                }
                EXPECT_EQ(std::ssize(finer), 4 * samples) << seed;
            }
        }
    }
}

TEST(PixelSequence, MC27_TimesAreEvenTogetherWithPlacesInAPixel) {
    // A strip .7 pixels wide crosses the pixel three pixels in a shutter: the mean over time and place in closed form.
    // Random times have a variance of mean (1 - mean) / n.
    constexpr double mean = 0.7 / 3.0;
    for (const bool upwards : {false, true}) {
        const auto find_variance = [&](int samples) {
            constexpr std::uint32_t seeds = 400;
            double sum = 0.0;
            for (std::uint32_t seed = 0; seed < seeds; ++seed) {
                const int x = static_cast<int>(seed % 5), y = static_cast<int>(seed % 3);
                const PixelSequence sequence(seed, 9, x, y);
                int inside = 0;
                for (int i = 0; i < samples; ++i) {
                    const glm::vec2 at = sequence.at_2d(SampleUse::pixel, i);
                    const float way =
                        (upwards ? at.y : at.x) - 3.0f * time_of_sample(seed, 9, i, (y & 1) * 2 + (x & 1)) + 1.3f;
                    if (way > 0.0f && way < 0.7f) ++inside;
                }
                sum += std::pow(static_cast<double>(inside) / samples - mean, 2.0) / seeds;
            }
            return sum;
        };
        const double few = find_variance(64), many = find_variance(256);
        EXPECT_LT(few, 0.35 * mean * (1.0 - mean) / 64);
        EXPECT_LT(many, 0.15 * mean * (1.0 - mean) / 256);
        EXPECT_LT(many, few / 6.0) << "steeper than 1 / n";
    }
}

TEST(Lattice, PointsAreEven) {
    for (const int n : {1, 2, 5, 16, 64}) {
        // Each of the n strata of x holds one point; y, a golden-ratio sequence, leaves no large gap.
        std::vector<int> strata(static_cast<std::size_t>(n), 0);
        std::vector<float> ys;
        for (int i = 0; i < n; ++i) {
            const glm::vec2 p = lattice_point(i, n, {0.0f, 0.3f});
            ASSERT_GE(std::min(p.x, p.y), 0.0f);
            ASSERT_LT(std::max(p.x, p.y), 1.0f);
            ++strata[static_cast<int>(p.x * static_cast<float>(n))];
            ys.push_back(p.y);
        }
        for (const int count : strata) EXPECT_EQ(count, 1);
        std::sort(ys.begin(), ys.end());
        for (std::size_t i = 1; i < ys.size(); ++i) EXPECT_LT(ys[i] - ys[i - 1], 3.0f / static_cast<float>(n));
    }
    EXPECT_LT(lattice_point(0, 1, {0.49999997f, 0.99999997f}).x, 1.0f);
}

}  // namespace
}  // namespace aleph
