// The perceptual metric of Yee and Newman 2004 against its formulas: uniform pictures, for which they are closed,
// colours, and masking.

#include "render/compare/yee_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace aleph {
namespace {

constexpr int columns = 32, rows = 24;
constexpr std::size_t all = columns * rows;
constexpr double white = 100.0;  // cd/m2

ViewingConditions make_viewing() {
    ViewingConditions viewing;
    viewing.display_white = white;
    return viewing;
}

std::size_t count(const Rgb& a, const Rgb& b) {
    return count_visible_differences(Image<Rgb>(columns, rows, a), Image<Rgb>(columns, rows, b), make_viewing());
}

/// Threshold against intensity of Ward's operator (Ward Larson et al. 1997), cd/m2.
double ward_threshold(double luminance) {
    const double l = std::log10(luminance);
    if (l < -3.94) return std::pow(10.0, -2.86);
    if (l < -1.44) return std::pow(10.0, std::pow(0.405 * l + 1.6, 2.18) - 2.86);
    if (l < -0.0184) return std::pow(10.0, l - 0.395);
    if (l < 1.9) return std::pow(10.0, std::pow(0.249 * l + 0.65, 2.7) - 0.72);
    return std::pow(10.0, l - 1.255);
}

TEST(YeeMetric, UniformGreyIsSeenBeyondTheThresholdOfItsLuminance) {
    for (const double luminance : {0.01, 0.3, 5.0, 50.0, 300.0}) {
        // Adapted to the mean of both.
        const auto step = [&](double thresholds) { return thresholds * ward_threshold(luminance); };
        for (const double thresholds : {0.97, 1.03}) {
            const double low = luminance - 0.5 * step(thresholds), high = luminance + 0.5 * step(thresholds);
            if (low < 0.0) continue;
            EXPECT_EQ(count(Rgb(static_cast<float>(low / white)), Rgb(static_cast<float>(high / white))),
                      thresholds > 1.0 ? all : 0u)
                << luminance << ' ' << thresholds;
        }
    }
    EXPECT_EQ(count(Rgb(0.0f), Rgb(1.0f)), all);
    EXPECT_EQ(count(Rgb(-3.0f), Rgb(0.0f)), 0u);
}

/// Squared distance in a* and b* (CIE 1976) of linear Rec.709.
double squared_colour_distance(const glm::dvec3& p, const glm::dvec3& q) {
    const auto lab = [](const glm::dvec3& c) {
        const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
        const double x = f((0.412453 * c.x + 0.357580 * c.y + 0.180423 * c.z) / 0.950456);
        const double y = f(0.212671 * c.x + 0.715160 * c.y + 0.072169 * c.z);
        const double z = f((0.019334 * c.x + 0.119193 * c.y + 0.950227 * c.z) / 1.088754);
        return glm::dvec2(500.0 * (x - y), 200.0 * (y - z));
    };
    const glm::dvec2 d = lab(p) - lab(q);
    return glm::dot(d, d);
}

/// Grey with as much more red as makes a distance, and less green, so that the luminance stays.
glm::dvec3 redden(double grey, double distance) {
    double low = 0.0, high = grey;
    const auto at = [&](double red) { return glm::dvec3(grey + red, grey - red * 0.2126 / 0.7152, grey); };
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (squared_colour_distance(glm::dvec3(grey), at(middle)) < distance * distance ? low : high) = middle;
    }
    return at(low);
}

TEST(YeeMetric, ColoursOfOneLuminanceAreSeenByDayAndNotByNight) {
    EXPECT_EQ(count(Rgb(0.3f), Rgb(redden(0.3, 0.95))), 0u);
    EXPECT_EQ(count(Rgb(0.3f), Rgb(redden(0.3, 1.05))), all);
    // At 5 cd/m2 colours count half.
    EXPECT_EQ(count(Rgb(0.05f), Rgb(redden(0.05, 1.9))), 0u);
    EXPECT_EQ(count(Rgb(0.05f), Rgb(redden(0.05, 2.1))), all);
}

TEST(YeeMetric, ATextureMasks) {
    std::mt19937 bits(3);
    Image<Rgb> plain(columns, rows, Rgb(0.5f)), textured = plain;
    for (Rgb& pixel : textured.pixels) pixel = Rgb(0.25f + 0.5f * static_cast<float>(bits() % 1000) / 1000.0f);
    const auto brightened = [](Image<Rgb> picture) {
        for (Rgb& pixel : picture.pixels) pixel += Rgb(0.045f);  // 4.5 cd/m2, about 1.4 thresholds
        return picture;
    };
    EXPECT_EQ(count_visible_differences(plain, brightened(plain), make_viewing()), all);
    EXPECT_LT(count_visible_differences(textured, brightened(textured), make_viewing()), all / 10);
    // At most ten thresholds.
    Image<Rgb> far = textured;
    for (Rgb& pixel : far.pixels) pixel += Rgb(0.6f);
    EXPECT_EQ(count_visible_differences(textured, far, make_viewing()), all);
}

TEST(YeeMetric, CountsOnePixel) {
    Image<Rgb> a(columns, rows, Rgb(0.5f)), b = a;
    b(20, 7) = Rgb(1.0f);
    EXPECT_EQ(count_visible_differences(a, b, make_viewing()), 1u);
    EXPECT_EQ(count_visible_differences(b, a, make_viewing()), 1u);
}

}  // namespace
}  // namespace aleph
