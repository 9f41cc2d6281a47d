// Motion between two pictures: the check of the motion there by the motion back, and optical flow on known answers.

#include "motion/picture_motion.h"
#include "engine/base/errors.h"
#include "tests/support/image_patterns.h"
#include "tests/support/numbers.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int film_width = 160, film_height = 120;

/// A textured square before a textured wall, both moved.
struct MovedSquare {
    glm::dvec2 wall{0.0}, square{0.0};
    double brightness = 1.0;

    static bool shows_square(double x, double y) { return std::abs(x - 80.0) < 25.0 && std::abs(y - 60.0) < 25.0; }
    Image<Rgb> draw() const {
        return make_pattern(film_width, film_height, [&](int x, int y) {
            const glm::dvec2 on = glm::dvec2(x, y) - square, behind = glm::dvec2(x, y) - wall;
            return brightness * (shows_square(on.x, on.y) ? smooth_texture(on.x + 1000.0, on.y, 7.0)
                                                          : smooth_texture(behind.x, behind.y, 9.0));
        });
    }
};

PictureMotions find_motion(const Image<Rgb>& first, const Image<Rgb>& second, PictureSearch search) {
    const SearchedPicture from = prepare_picture(first, search), to = prepare_picture(second, search);
    PictureMotions motions = compute_picture_motions(from, to, search);
    const MotionField alone = compute_picture_motion(from, to, search);
    EXPECT_EQ(alone.displacement.pixels, motions.there.displacement.pixels);
    EXPECT_EQ(alone.validity.pixels, motions.there.validity.pixels);
    return motions;
}

std::vector<PictureSearch> checked_searches() {
    std::vector<PictureSearch> searches{PictureSearch::checked};
    if (has_flow()) searches.push_back(PictureSearch::flow);
    return searches;
}

struct Share {
    double valid = 0.0, right = 0.0;  ///< of the pixels; of the valid ones
};

/// @param truth  displacement of a pixel; nothing: it is not counted
template <class Truth>
Share find_share(const MotionField& field, const Truth& truth) {
    std::size_t count = 0, valid = 0, right = 0;
    for (int y = 0; y < field.validity.height; ++y) {
        for (int x = 0; x < field.validity.width; ++x) {
            const std::optional<glm::dvec2> way = truth(x, y);
            if (!way) continue;
            ++count;
            if (field.validity(x, y) != MotionValidity::valid) continue;
            ++valid;
            right += glm::length(field.displacement(x, y) - *way) <= 1.0;
        }
    }
    return {static_cast<double>(valid) / static_cast<double>(count),
            static_cast<double>(right) / static_cast<double>(std::max<std::size_t>(1, valid))};
}

TEST(PictureMotion, BothWaysAreFound) {
    const MovedSquare before, after{.wall = {0.0, 0.0}, .square = {6.0, -4.0}};
    for (const PictureSearch search : checked_searches()) {
        const PictureMotions motion = find_motion(before.draw(), after.draw(), search);
        const auto inside = [](double x, double y) { return std::abs(x - 80.0) < 15.0 && std::abs(y - 60.0) < 15.0; };
        const Share there = find_share(motion.there, [&](int x, int y) {
            return inside(x, y) ? std::optional(glm::dvec2(6.0, -4.0)) : std::nullopt;
        });
        const Share back = find_share(motion.back, [&](int x, int y) {
            return inside(x - 6, y + 4) ? std::optional(glm::dvec2(-6.0, 4.0)) : std::nullopt;
        });
        const bool is_flow = search == PictureSearch::flow;
        for (const Share& found : {there, back}) {
            EXPECT_GT(found.valid, is_flow ? 0.95 : 0.4);
            EXPECT_GT(found.right, is_flow ? 0.98 : 0.9);
        }
    }
}

TEST(PictureMotion, WhatIsCoveredIsNotValidAndDoesNotMove) {
    // The square's right side moves over 12 columns of the wall.
    const MovedSquare before, after{.wall = {0.0, 0.0}, .square = {12.0, 0.0}};
    const auto covered = [](int x, int y) {
        return x >= 107 && x <= 115 && std::abs(y - 60) < 20 ? std::optional(glm::dvec2(0.0)) : std::nullopt;
    };
    for (const PictureSearch search : checked_searches()) {
        const MotionField field = find_motion(before.draw(), after.draw(), search).there;
        EXPECT_LT(find_share(field, covered).valid, 0.3);
        for (std::size_t i = 0; i < field.validity.size(); ++i) {
            if (field.validity.pixels[i] != MotionValidity::no_counterpart) continue;
            EXPECT_EQ(field.displacement.pixels[i], glm::dvec2(0.0));
            EXPECT_EQ(field.path_length.pixels[i], 0.0);
        }
    }
    EXPECT_EQ(find_share(find_motion(before.draw(), after.draw(), PictureSearch::census).there, covered).valid, 1.0)
        << "as printed";
}

TEST(PictureMotion, TheCheckKeepsWhatTheSearchFound) {
    const Image<Rgb> first = MovedSquare{}.draw(),
                     second = MovedSquare{.wall = {1.0, 2.0}, .square = {6.0, 0.0}}.draw();
    const MotionField plain = find_motion(first, second, PictureSearch::census).there;
    const MotionField checked = find_motion(first, second, PictureSearch::checked).there;
    EXPECT_EQ(plain.displacement, compute_image_motion(first, second).displacement);
    for (std::size_t i = 0; i < plain.displacement.size(); ++i) {
        if (checked.validity.pixels[i] != MotionValidity::valid) continue;
        EXPECT_EQ(checked.displacement.pixels[i], plain.displacement.pixels[i]);
        EXPECT_EQ(checked.path_length.pixels[i], plain.path_length.pixels[i]);
    }
}

TEST(PictureMotion, UnrelatedPicturesHaveHardlyAnyValidMotion) {
    const auto noise = [](std::uint32_t seed) {
        return make_pattern(film_width, film_height, [=](int x, int y) { return white_noise(x, y, seed); });
    };
    for (const PictureSearch search : checked_searches()) {
        const Share share = find_share(find_motion(noise(1), noise(2), search).there,
                                       [](int, int) { return std::optional(glm::dvec2(0.0)); });
        EXPECT_LT(share.valid, 0.4);
    }
}

TEST(PictureMotion, FlowFindsFractionsOfAPixel) {
    if (!has_flow()) GTEST_SKIP() << "built without OpenCV";
    const MovedSquare before, after{.wall = {1.5, -0.25}, .square = {1.5, -0.25}};
    const MotionField field = find_motion(before.draw(), after.draw(), PictureSearch::flow).there;
    double sum = 0.0;
    int count = 0;
    for (int y = 10; y < film_height - 10; ++y) {
        for (int x = 10; x < film_width - 10; ++x, ++count)
            sum += glm::length(field.displacement(x, y) - glm::dvec2(1.5, -0.25));
    }
    EXPECT_LT(sum / count, 0.15);
}

TEST(PictureMotion, FlowFindsWhatIsBrighterThanWhite) {
    if (!has_flow()) GTEST_SKIP() << "built without OpenCV";
    const MovedSquare before{.brightness = 8.0}, after{.square = {6.0, -4.0}, .brightness = 8.0};
    const MotionField field = find_motion(before.draw(), after.draw(), PictureSearch::flow).there;
    EXPECT_NEAR(field.displacement(80, 60).x, 6.0, 0.5);
    EXPECT_NEAR(field.displacement(80, 60).y, -4.0, 0.5);
}

TEST(PictureMotion, FlowTakesPicturesOfEverySizeAndValue) {
    if (!has_flow()) GTEST_SKIP() << "built without OpenCV";
    for (const int w : {1, 2, 3, 7, 8, 9, 12, 16, 31, 32, 33, 400}) {
        for (const int h : {1, 2, 8, 17, 33}) {
            SCOPED_TRACE(testing::Message() << w << "x" << h);
            const auto noise = [&](std::uint32_t seed) {
                return make_pattern(w, h, [=](int x, int y) { return white_noise(x, y, seed); });
            };
            const MotionField field = find_motion(noise(1), noise(2), PictureSearch::flow).there;
            for (const glm::dvec2& d : field.displacement.pixels)
                EXPECT_LE(glm::length(d), std::hypot(w, h) * (1.0 + 1e-12));
            for (const glm::dvec2& d : find_motion(noise(1), noise(1), PictureSearch::flow).there.displacement.pixels)
                EXPECT_LT(glm::length(d), 0.1);
        }
    }
    const Image<Rgb> bad = make_pattern(40, 40, [](int x, int y) {
        return x % 7 == 0 ? float_nan : y % 5 == 0 ? float_infinity : x % 3 == 0 ? -1.0f : 1e30f;
    });
    for (const glm::dvec2& d : find_motion(bad, bad, PictureSearch::flow).there.displacement.pixels)
        EXPECT_LT(glm::length(d), 0.1);
}

TEST(PictureMotion, SizesMustAgree) {
    for (const PictureSearch search : checked_searches())
        EXPECT_THROW(find_motion(Image<Rgb>(8, 8), Image<Rgb>(8, 9), search), InputError);
    EXPECT_THROW(compute_flow({}, {}), InputError);
}

TEST(PictureMotion, TurnedRoundAStillPixelIsNotNegative) {
    MotionField field = make_motion_field(2, 1, MotionValidity::valid);
    field.displacement(1, 0) = {3.0, -4.0};
    turn_round(field);
    EXPECT_FALSE(std::signbit(field.displacement(0, 0).x));
    EXPECT_EQ(field.displacement(1, 0), glm::dvec2(-3.0, 4.0));
}

}  // namespace
}  // namespace aleph
