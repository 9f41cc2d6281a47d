#pragma once
// Differences between two pictures, for golden images, studies and `aleph compare`.

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/image_file.h"
#include "render/compare/compare_luminance.h"
#include "render/compare/compare_threshold.h"

namespace aleph {

/// No limit of a CompareSettings.
constexpr double unlimited = std::numeric_limits<double>::infinity();

struct CompareSettings {
    double tolerance = 0.0;               ///< largest allowed |a - b|, in the channel's unit
    double relative = 0.0;                ///< allowed in addition, times |b|
    double share = 0.0;                   ///< percent of pixels that may differ by more, 0 to 100
    std::vector<std::string> channels{};  ///< channels ("Z") or layers ("forward"); empty: all

    // Limits that `share` does not soften.
    double max_error = unlimited;         ///< of |a - b| in any channel
    double max_rms = unlimited;           ///< of the RMS difference of any channel
    double max_relative_mse = unlimited;  ///< of luminance, less what the noise of b adds (LuminanceDifference)
    double max_bias = unlimited;          ///< of |mean Y_a - mean Y_b|, percent of the mean of Y_b

    /// If set: not the channels but the luminance must keep to the tolerances, with this many standard errors
    /// (`variance.Y` of either picture) allowed in addition.
    std::optional<double> standard_errors{};
};

/// Errors over a set of values. Pairs with a NaN or an infinity are left out; NonFinite counts them.
struct Difference {
    double max_abs = 0.0;
    double rms = 0.0;           ///< root of the mean squared difference
    double relative_mse = 0.0;  ///< mean of (a-b)^2 / (b^2 + e^2), e = 1 % of the mean of |b|
};

struct ChannelDifference {
    std::string name;
    Difference difference;
    int x = 0, y = 0;        ///< the first pixel of the largest difference
    std::size_t beyond = 0;  ///< pixels beyond the tolerance
};

/// Against an Aleph map, in units of its threshold.Y.
struct ThresholdDifference : ThresholdFigures {
    double display_white = 100.0;  ///< cd/m2 of Y = 1 (display_white_of)
};

/// Number of values of a picture that are not finite.
struct NonFinite {
    std::size_t nan = 0, inf = 0;
    bool any() const { return nan + inf > 0; }
};

struct CompareResult {
    int width = 0, height = 0;
    std::vector<ChannelDifference> channels;       ///< in the order of b
    Difference all;                                ///< over all compared channels
    std::optional<Difference> colour;              ///< over R, G and B, where they are compared
    NonFinite a, b;                                ///< over the compared channels
    std::size_t beyond = 0;                        ///< pixels beyond the tolerance in any channel
    std::size_t counted = 0;                       ///< pixels that `share` limits where no Aleph map is given
    std::optional<LuminanceDifference> luminance;  ///< where both pictures have R, G and B
    std::optional<ThresholdDifference> threshold;  ///< if a map was given
    std::vector<std::string> exceeded;             ///< limits that are exceeded: "share", "max_error", ...

    bool same() const { return !a.any() && !b.any() && exceeded.empty(); }
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    double percent(std::size_t count) const { return percent_of(static_cast<double>(count), pixels()); }
};

/// Compares `a` with the reference `b`. The same: no NaN or infinity in either (not even in both), at most `share`
/// percent of the pixels beyond the tolerance or, where an Aleph map is given, beyond its threshold, and no other limit
/// exceeded. `variance.Y` and `error.*` say how certain a picture is and are compared only if they are named.
/// `samples.Y`, `records.Y`, `invalid.Y`, `cache.count` and `cache.radius` say how a picture was made: they are left
/// out if only one picture has them.
/// 8-bit pictures count as sRGB for luminance, and beside a picture that is linear.
/// @param aleph_map  holds `threshold.Y` in cd/m2, or null
/// @throws InputError if sizes or channels differ, a named channel is missing, or a limit needs R, G and B or
/// `variance.Y` that are not there
CompareResult compare_images(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings = {},
                             const ChannelImage* aleph_map = nullptr);

/// The difference as a picture: |R|, |G|, |B| where both have them, else the largest of any channel as grey; the
/// largest difference is white; magenta where a value is not finite.
/// @throws InputError as compare_images
Image<Rgb> difference_picture(const ChannelImage& a, const ChannelImage& b, const CompareSettings& settings = {});

}  // namespace aleph
