#include "render/compare/yee_metric.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "perception/threshold.h"
#include "perception/tvi.h"

namespace aleph {

namespace {

constexpr std::size_t bands = 6;
constexpr std::size_t levels = bands + 2;  ///< the contrast of band i needs level i + 2

/// Contrast sensitivity at `f` cycles per degree and `luminance` cd/m2 (Barten 1989, SPIE 1077).
double barten_sensitivity(double f, double luminance) {
    const double a = 440.0 * std::pow(1.0 + 0.7 / luminance, -0.2);
    const double b = 0.3 * std::pow(1.0 + 100.0 / luminance, 0.15);
    return a * f * std::exp(-b * f) * std::sqrt(1.0 + 0.06 * std::exp(b * f));
}

/// Threshold elevation by masking; `contrast` in units of its own threshold (Daly 1993, "The Visible Differences
/// Predictor": k1 .0153, k2 392.498, s .7, b 4).
double daly_masking(double contrast) {
    return std::pow(1.0 + std::pow(0.0153 * std::pow(392.498 * contrast, 0.7), 4.0), 0.25);
}

/// CIE a*, b* of linear Rec.709 (IEC 61966-2-1; white D65).
std::array<double, 2> lab_colour(const Rgb& c) {
    const glm::dvec3 xyz{0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z, 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
                         0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z};
    const glm::dvec3 white{0.9505, 1.0, 1.089};
    const auto response = [](double t) {
        constexpr double epsilon = 216.0 / 24389.0, kappa = 24389.0 / 27.0;
        return t > epsilon ? std::cbrt(t) : (kappa * t + 16.0) / 116.0;
    };
    const double fx = response(xyz.x / white.x), fy = response(xyz.y / white.y), fz = response(xyz.z / white.z);
    return {500.0 * (fx - fy), 200.0 * (fy - fz)};
}

/// Burt and Adelson's five taps (a = .4), in x and y; the border repeats.
Image<float> blur(const Image<float>& image) {
    constexpr std::array<float, 5> taps{0.05f, 0.25f, 0.4f, 0.25f, 0.05f};
    const auto pass = [&](const Image<float>& from, int step_x, int step_y) {
        Image<float> to(from.width, from.height);
        parallel_rows(from.height, 16, [&](int begin, int end) {
            for (int y = begin; y < end; ++y) {
                for (int x = 0; x < from.width; ++x) {
                    float sum = 0.0f;
                    for (int k = -2; k <= 2; ++k) {
                        sum += taps[k + 2] * from(std::clamp(x + k * step_x, 0, from.width - 1),
                                                  std::clamp(y + k * step_y, 0, from.height - 1));
                    }
                    to(x, y) = sum;
                }
            }
        });
        return to;
    };
    return pass(pass(image, 1, 0), 0, 1);
}

struct Side {
    Image<Rgb> colour;                           ///< not negative
    std::array<Image<float>, levels> luminance;  ///< cd/m2, each level blurred once more
    Image<float> adaptation;                     ///< cd/m2
};

Side prepare(const Image<Rgb>& picture, const ViewingConditions& viewing) {
    Side side{picture, {}, {}};
    side.luminance[0] = Image<float>(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        side.colour.pixels[i] = glm::max(picture.pixels[i], Rgb(0.0f));
        side.luminance[0].pixels[i] = static_cast<float>(viewing.display_white) * luminance(side.colour.pixels[i]);
    }
    for (std::size_t level = 1; level < levels; ++level) side.luminance[level] = blur(side.luminance[level - 1]);
    side.adaptation = compute_adaptation_luminance(side.colour, viewing);
    return side;
}

/// Factor on the threshold at pixel i, by frequency and masking: 1 to 10.
double elevation(const Side& a, const Side& b, std::size_t i, double adaptation,
                 const std::array<double, bands>& frequencies) {
    const double peak = barten_sensitivity(3.248, 100.0);  // its maximum over frequency at 100 cd/m2
    double sum = 0.0, weighted = 0.0;
    for (std::size_t band = 0; band < bands; ++band) {
        const auto step = [&](const Side& s) {
            return std::abs(double{s.luminance[band].pixels[i]} - double{s.luminance[band + 1].pixels[i]});
        };
        const double base =
            std::max({double{a.luminance[band + 2].pixels[i]}, double{b.luminance[band + 2].pixels[i]}, 1e-5});
        const double contrast = std::max(step(a), step(b)) / base;
        const double by_frequency = peak / barten_sensitivity(frequencies[band], 100.0);
        const double by_masking = daly_masking(contrast * barten_sensitivity(frequencies[band], adaptation));
        sum += contrast;
        weighted += contrast * by_frequency * by_masking;
    }
    return std::clamp(weighted / std::max(sum, 1e-5), 1.0, 10.0);
}

bool differs(const Side& a, const Side& b, std::size_t i, const std::array<double, bands>& frequencies) {
    const double adaptation = std::max(1e-5, 0.5 * (double{a.adaptation.pixels[i]} + double{b.adaptation.pixels[i]}));
    const double factor = elevation(a, b, i, adaptation, frequencies);
    const double step = std::abs(double{a.luminance[0].pixels[i]} - double{b.luminance[0].pixels[i]});
    if (step > factor * tvi(adaptation)) return true;
    // In the dark cones, and with them colour vision, fade out.
    const double photopic = std::min(1.0, adaptation / 10.0);
    const auto lab_a = lab_colour(a.colour.pixels[i]), lab_b = lab_colour(b.colour.pixels[i]);
    const double da = lab_a[0] - lab_b[0], db = lab_a[1] - lab_b[1];
    return (da * da + db * db) * photopic * photopic > factor;
}

}  // namespace

std::size_t count_visible_differences(const Image<Rgb>& a, const Image<Rgb>& b, const ViewingConditions& viewing) {
    ALEPH_CHECK(same_size(a, b), fmt::format("{}x{} and {}x{}", a.width, a.height, b.width, b.height));
    std::array<double, bands> frequencies{};
    for (std::size_t band = 0; band < bands; ++band) {
        frequencies[band] = 0.5 * viewing.pixels_per_degree / static_cast<double>(std::size_t{1} << band);
    }
    const Side side_a = prepare(a, viewing), side_b = prepare(b, viewing);
    std::atomic<std::size_t> count{0};
    parallel_for(a.size(), 4096, [&](std::size_t begin, std::size_t end) {
        std::size_t here = 0;
        for (std::size_t i = begin; i < end; ++i) here += differs(side_a, side_b, i, frequencies);
        count += here;
    });
    return count;
}

}  // namespace aleph
