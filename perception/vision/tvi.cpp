#include "perception/vision/tvi.h"

#include <cmath>

#include "perception/vision/fast_math.h"

namespace aleph {

namespace {

constexpr double min_luminance = 1e-6, max_luminance = 1e12;  // cd/m2

// Where one piece ends and the next begins, log10 of cd/m2.
constexpr double rods_end = -3.94, scotopic_end = -1.44, mesopic_end = -0.0184, photopic_start = 1.9;

// The pieces of t(l), log10 of cd/m2 to log10 of cd/m2.
constexpr double rods_level = -2.86;
constexpr double scotopic_slope = 0.405, scotopic_offset = 1.6, scotopic_power = 2.18;
constexpr double mesopic_shift = 0.395;
constexpr double rising_slope = 0.249, rising_offset = 0.65, rising_power = 2.7, rising_shift = 0.72;
constexpr double photopic_shift = 1.255;

/// base^power, base > 0.
float fast_power(float base, float power) {
    return fast_exp2(power * fast_log2(base));
}

/// Without branches.
float fast_tvi(float luminance) {
    constexpr float log10_2 = 0.30102999566398120f, log2_10 = 3.3219280948873623f;
    constexpr auto lowest = static_cast<float>(min_luminance), highest = static_cast<float>(max_luminance);
    constexpr float min_base = 1e-3f;  // the base of a piece that is not in use may be negative
    const float clamped = luminance > lowest ? (luminance < highest ? luminance : highest) : lowest;
    const float l = log10_2 * fast_log2(clamped);
    const float scotopic = static_cast<float>(scotopic_slope) * l + static_cast<float>(scotopic_offset);
    const float rising = static_cast<float>(rising_slope) * l + static_cast<float>(rising_offset);
    float t = static_cast<float>(rods_level);
    t = l < static_cast<float>(rods_end)
            ? t
            : fast_power(scotopic > min_base ? scotopic : min_base, static_cast<float>(scotopic_power)) +
                  static_cast<float>(rods_level);
    t = l < static_cast<float>(scotopic_end) ? t : l - static_cast<float>(mesopic_shift);
    t = l < static_cast<float>(mesopic_end)
            ? t
            : fast_power(rising > min_base ? rising : min_base, static_cast<float>(rising_power)) -
                  static_cast<float>(rising_shift);
    t = l < static_cast<float>(photopic_start) ? t : l - static_cast<float>(photopic_shift);
    return fast_exp2(log2_10 * t);
}

}  // namespace

double tvi(double luminance) {
    const double l = std::log10(std::fmin(std::fmax(luminance, min_luminance), max_luminance));
    double t;
    if (l < rods_end) {
        t = rods_level;
    } else if (l < scotopic_end) {
        t = std::pow(scotopic_slope * l + scotopic_offset, scotopic_power) + rods_level;
    } else if (l < mesopic_end) {
        t = l - mesopic_shift;
    } else if (l < photopic_start) {
        t = std::pow(rising_slope * l + rising_offset, rising_power) - rising_shift;
    } else {
        t = l - photopic_shift;
    }
    return std::pow(10.0, t);
}

void tvi_row(const float* luminance, std::size_t count, float* out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = fast_tvi(luminance[i]);
}

}  // namespace aleph
