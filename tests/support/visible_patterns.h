#pragma once
// Patterns that fill the frames of two sequences, and what a viewer sees of their difference.

#include "perception/vision/castle.h"
#include "render/compare/visible_difference.h"
#include "tests/support/test.h"

namespace aleph::visible_difference_test {

constexpr int width = 192, height = 128;
constexpr double grey = 0.5;  // 50 cd/m2 of a display with 100 cd/m2
inline const double pixels_per_degree = ViewingConditions{}.pixels_per_degree;

using Pattern = std::function<double(double x, double y)>;

/// Grey times 1 + pattern.
inline Image<Rgb> picture_of(const Pattern& pattern) {
    Image<Rgb> picture(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) picture(x, y) = Rgb(static_cast<float>(grey * (1.0 + pattern(x, y))));
    }
    return picture;
}

inline Pattern grating(double cycles_per_degree, double contrast) {
    const double radians = 2.0 * std::numbers::pi * cycles_per_degree / pixels_per_degree;
    return [=](double x, double) { return contrast * std::cos(radians * x); };
}

inline const Pattern flat = [](double, double) { return 0.0; };

inline MotionMaps uniform_motion(float u, float v = 0.0f, float valid = 1.0f) {
    return {Image<float>(width, height, u), Image<float>(width, height, v), Image<float>(width, height, valid),
            Image<float>(width, height, 5.0f)};
}

struct Shown {
    double seen, flicker, lasting;
};

/// Mean over the middle of a map.
inline double middle(const Image<float>& map) {
    double sum = 0.0;
    int count = 0;
    for (int y = height / 4; y < 3 * height / 4; ++y) {
        for (int x = width / 4; x < 3 * width / 4; ++x, ++count) sum += map(x, y);
    }
    return sum / count;
}

using Frames = std::function<Image<Rgb>(int frame)>;

/// Means in the middle frame of a window that both sequences fill.
inline Shown show(const Frames& pictures, const Frames& references, float u = 0.0f,
                  const ViewingSettings& settings = {}, float valid = 1.0f) {
    VisibleDifference difference(settings);
    const int reach = filter_reach(settings.frame_rate);
    std::vector<VisibleMaps> maps;
    for (int frame = 0; frame <= 2 * reach; ++frame) {
        for (VisibleMaps& done :
             difference.add(frame, {pictures(frame), references(frame)}, uniform_motion(u, 0.0f, valid)))
            maps.push_back(std::move(done));
    }
    for (VisibleMaps& done : difference.finish()) maps.push_back(std::move(done));
    EXPECT_EQ(maps.size(), static_cast<std::size_t>(2 * reach + 1));
    const VisibleMaps& at = maps[static_cast<std::size_t>(reach)];
    EXPECT_EQ(at.frame, reach);
    return {middle(at.seen), middle(at.flicker), middle(at.lasting)};
}

inline Frames still(const Pattern& pattern) {
    return [=](int) { return picture_of(pattern); };
}

/// Moves right by so many pixels a frame.
inline Frames drifting(const Pattern& pattern, double pixels) {
    return [=](int frame) { return picture_of([=](double x, double y) { return pattern(x - pixels * frame, y); }); };
}

inline double area(double frequency) {
    return std::numbers::pi * 2.25 / (frequency * frequency);
}

inline double threshold(double frequency, double omega = 0.0) {
    return 1.0 / castle_sensitivity(frequency, omega, 50.0, area(frequency));
}

}  // namespace aleph::visible_difference_test
