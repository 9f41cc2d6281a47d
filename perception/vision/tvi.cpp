#include "perception/vision/tvi.h"

#include "perception/vision/fast_math.h"

namespace aleph {

namespace {

constexpr float min_luminance = 1e-6f, max_luminance = 1e12f;  // cd/m2

// Where one piece ends and the next begins, log10 of cd/m2.
constexpr float rods_end = -3.94f, scotopic_end = -1.44f, mesopic_end = -0.0184f, photopic_start = 1.9f;

// The pieces of t(l), log10 of cd/m2 to log10 of cd/m2.
constexpr float rods_level = -2.86f;
constexpr float scotopic_slope = 0.405f, scotopic_offset = 1.6f, scotopic_power = 2.18f;
constexpr float mesopic_shift = 0.395f;
constexpr float rising_slope = 0.249f, rising_offset = 0.65f, rising_power = 2.7f, rising_shift = 0.72f;
constexpr float photopic_shift = 1.255f;

/// base^power, base > 0.
float fast_power(float base, float power) {
    return fast_exp2(power * fast_log2(base));
}

/// Without branches.
float fast_tvi(float luminance) {
    constexpr float log2_10 = 3.3219280948873623f;
    constexpr float min_base = 1e-3f;  // the base of a piece that is not in use may be negative
    const float clamped =
        luminance > min_luminance ? (luminance < max_luminance ? luminance : max_luminance) : min_luminance;
    const float l = log10_2 * fast_log2(clamped);
    const float scotopic = scotopic_slope * l + scotopic_offset, rising = rising_slope * l + rising_offset;
    float t = rods_level;
    t = l < rods_end ? t : fast_power(scotopic > min_base ? scotopic : min_base, scotopic_power) + rods_level;
    t = l < scotopic_end ? t : l - mesopic_shift;
    t = l < mesopic_end ? t : fast_power(rising > min_base ? rising : min_base, rising_power) - rising_shift;
    t = l < photopic_start ? t : l - photopic_shift;
    return fast_exp2(log2_10 * t);
}

}  // namespace

void tvi_row(const float* luminance, std::size_t count, float* out) {
    for (std::size_t i = 0; i < count; ++i) out[i] = fast_tvi(luminance[i]);
}

}  // namespace aleph
