// Image-based motion of pictures without texture, of tiny pictures, and with a known answer (RP-22 to RP-24).

#include "motion/image_motion.h"
#include "tests/support/image_patterns.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

double longest_motion(const Image<Rgb>& now, const Image<Rgb>& other) {
    const MotionField field = compute_image_motion(now, other);
    double most = 0.0;
    for (const glm::dvec2& d : field.displacement.pixels) {
        EXPECT_TRUE(std::isfinite(d.x) && std::isfinite(d.y));
        EXPECT_FALSE(std::signbit(d.x) && d.x == 0.0);
        most = std::max(most, std::hypot(d.x, d.y));
    }
    return most;
}

TEST(ImageMotionHard, RP22_AStillPairOfAnythingIsStill) {
    const int w = 120, h = 90;
    const auto still = [&](const char* name, const Image<Rgb>& image) {
        SCOPED_TRACE(name);
        EXPECT_EQ(longest_motion(image, image), 0.0);
    };
    still("uniform", make_pattern(w, h, [](int, int) { return 0.3; }));
    still("black", make_pattern(w, h, [](int, int) { return 0.0; }));
    still("ramp", make_pattern(w, h, [](int x, int) { return x / 120.0; }));
    still("ramp down", make_pattern(w, h, [](int, int y) { return 1.0 - y / 90.0; }));
    still("checker of 1", make_pattern(w, h, [](int x, int y) { return (x + y) % 2; }));
    still("checker of 8", make_pattern(w, h, [](int x, int y) { return (x / 8 + y / 8) % 2; }));
    still("stripes", make_pattern(w, h, [](int x, int) { return x / 4 % 2; }));
    still("one bright pixel", make_pattern(w, h, [](int x, int y) { return x == 60 && y == 40 ? 1e9 : 0.0; }));
    still("white noise", make_pattern(w, h, [](int x, int y) { return white_noise(x, y); }));
    still("texture", make_pattern(w, h, [](int x, int y) { return smooth_texture(x, y); }));
    still("all NaN", make_pattern(w, h, [](int, int) { return float_nan; }));
    still("all infinite", make_pattern(w, h, [](int, int) { return float_infinity; }));
    still("some of each", make_pattern(w, h, [](int x, int y) {
              return x % 7 == 0   ? float_nan
                     : y % 5 == 0 ? float_infinity
                     : x % 3 == 0 ? -1.0f
                                  : 0.01f * static_cast<float>(x);
          }));
}

TEST(ImageMotionHard, RP22_FlatPairsOfDifferentBrightnessAreStill) {
    const auto flat = [](double value) { return make_pattern(64, 64, [&](int, int) { return value; }); };
    EXPECT_EQ(longest_motion(flat(0.2), flat(0.9)), 0.0);
    EXPECT_EQ(longest_motion(flat(float_nan), flat(0.9)), 0.0);
}

TEST(ImageMotionHard, RP23_SmallFramesOfEverySize) {
    // Under the address sanitiser this shows that no search leaves the frame.
    for (const int w : {1, 2, 3, 5, 8, 15, 16, 17, 31, 32, 33, 200}) {
        for (const int h : {1, 2, 3, 7, 16, 31, 32, 35}) {
            SCOPED_TRACE(testing::Message() << w << "x" << h);
            const Image<Rgb> now = make_pattern(w, h, [](int x, int y) { return white_noise(x, y, 1); });
            const Image<Rgb> other = make_pattern(w, h, [](int x, int y) { return white_noise(x, y, 2); });
            const int side = std::min(w, h);
            EXPECT_EQ(make_census_pyramid(now).size(), side >= 32 ? 3u : side >= 16 ? 2u : 1u);
            const double reach = std::sqrt(2.0) * (side >= 32 ? 53 : side >= 16 ? 23 : 8);
            EXPECT_LE(longest_motion(now, other), reach);
            EXPECT_EQ(longest_motion(now, now), 0.0);
        }
    }
}

TEST(ImageMotionHard, RP23_AThinFrameStillFindsMotionAlongIt) {
    const auto row = [](int shift) {
        return make_pattern(400, 1, [=](int x, int) { return white_noise(x - shift, 0); });
    };
    const MotionField field = compute_image_motion(row(0), row(5));
    int right = 0;
    for (int x = 10; x < 390; ++x) right += field.displacement(x, 0) == glm::dvec2(5, 0);
    EXPECT_GT(right, 120);  // chance: 22; a line has two census bits that tell anything
}

/// Figures of |found - (dx, dy)| over pixels whose target and neighbourhood stay inside.
struct ErrorFigures {
    double median, mean, percent_beyond_1, percent_exact;
};

template <class Value>
ErrorFigures measure_shift(int width, int height, int dx, int dy, const Value& value) {
    const Image<Rgb> now = make_pattern(width, height, value);
    const Image<Rgb> other = make_pattern(width, height, [&](int x, int y) { return value(x - dx, y - dy); });
    const MotionField field = compute_image_motion(now, other);
    std::vector<double> errors;
    const int margin = 16 + std::max(std::abs(dx), std::abs(dy));
    for (int y = margin; y < height - margin; ++y) {
        for (int x = margin; x < width - margin; ++x) {
            const glm::dvec2 d = field.displacement(x, y);
            errors.push_back(std::hypot(d.x - dx, d.y - dy));
        }
    }
    std::sort(errors.begin(), errors.end());
    ErrorFigures figures{errors[errors.size() / 2], 0.0, 0.0, 0.0};
    for (const double e : errors) {
        figures.mean += e / static_cast<double>(errors.size());
        figures.percent_beyond_1 += (e > 1.0 ? 100.0 : 0.0) / static_cast<double>(errors.size());
        figures.percent_exact += (e == 0.0 ? 100.0 : 0.0) / static_cast<double>(errors.size());
    }
    return figures;
}

TEST(ImageMotionHard, RP24_SmoothTextureMovedByFiveAndThree) {
    for (const double cell : {8.0, 10.0, 12.0}) {
        const ErrorFigures e = measure_shift(256, 192, 5, 3, [&](int x, int y) { return smooth_texture(x, y, cell); });
        EXPECT_LE(e.median, 1.0) << "cells of " << cell << ": mean " << e.mean << ", beyond 1 px " << e.percent_beyond_1
                                 << " %";
        EXPECT_LT(e.percent_beyond_1, 50.0);
    }
}

TEST(ImageMotionHard, RP24_WholeCoarsePixelsAreExact) {
    // Moved by multiples of 4 pixels, which is 1 at the coarsest level: all levels are the same but for the shift.
    for (const auto& [dx, dy] : {std::pair(8, 4), std::pair(-12, 8), std::pair(0, -16), std::pair(32, 0)}) {
        const ErrorFigures e = measure_shift(256, 192, dx, dy, [](int x, int y) { return smooth_texture(x, y, 8.0); });
        EXPECT_GT(e.percent_exact, 95.0) << dx << ", " << dy;
    }
}

TEST(ImageMotionHard, RP24_KnownLimits) {
    // Little of white noise is left at the coarsest level, and that little moves by 1.25 and .75 of its pixels.
    const ErrorFigures noise = measure_shift(256, 192, 5, 3, [](int x, int y) { return white_noise(x, y); });
    EXPECT_GT(noise.mean, 5.0);
    EXPECT_LT(noise.mean, 20.0);
    // A shift by half a coarse pixel: fine texture looks different at the coarsest level.
    const ErrorFigures between = measure_shift(256, 192, -6, 2, [](int x, int y) { return smooth_texture(x, y, 8.0); });
    EXPECT_GT(between.median, 5.0);
    RecordProperty("white_noise_mean_px", std::to_string(noise.mean));
    RecordProperty("half_coarse_pixel_median_px", std::to_string(between.median));
}

}  // namespace
}  // namespace aleph
