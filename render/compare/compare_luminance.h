#pragma once
// Luminance of two pictures: what a viewer compares.

#include <cmath>
#include <optional>
#include <string>

#include "engine/image/image_file.h"

namespace aleph {

/// A number that a picture says of itself, above 0; nothing if it has none.
std::optional<double> find_number(const ChannelImage& image, const std::string& key);

/// The channels R, G and B whose names begin with a prefix, or nothing if one is missing.
Image<Rgb> join_channels(const ChannelImage& image, const std::string& prefix);

/// @throws InputError if the pictures differ in size, or one has no channels
void check_sizes(const ChannelImage& a, const ChannelImage& b);

/// Returns whether its values are sRGB, as those of 8-bit files are.
bool is_encoded(const ChannelImage& image);
/// Makes all channels but alpha of an encoded picture linear.
ChannelImage decode_colour(ChannelImage image);
/// Linear R, G, B of a picture, or nothing if it has none. 8-bit pictures count as sRGB.
Image<Rgb> linear_colour(const ChannelImage& image);

/// cd/m2 of Y = 1: `whiteLuminance` of b, else of a, else 100.
double display_white_of(const ChannelImage& a, const ChannelImage& b);

/// Luminance of a picture minus that of the reference, both as a display shows them: R, G and B up to white.
struct LuminanceError {
    Image<double> error;           ///< Y_a - Y_b, cd/m2; NaN where either is not finite
    Image<double> variance;        ///< of Y_b as it is shown, (cd/m2)^2; empty if b has no `variance.Y`
    double display_white = 100.0;  ///< cd/m2 of Y = 1
};

/// @param b  the reference. Its `variance.Y` is the variance of each pixel's mean luminance, in units of Y squared.
/// @throws InputError if a picture has no R, G, B, or the sizes differ
LuminanceError compute_luminance_error(const ChannelImage& a, const ChannelImage& b);

/// Means over a picture, in the picture's own unit. Pixels that are not finite are left out.
struct LuminanceDifference {
    double bias = 0.0;          ///< mean of Y_a - Y_b over the mean of Y_b; no unit
    double bias_error = 0.0;    ///< its standard error by the noise of both pictures; 0 without `variance.Y`
    double relative_mse = 0.0;  ///< mean of (Y_a - Y_b)^2 / (Y_b^2 + e^2), e = 1 % of the mean of |Y_b|
    double noise_mse = 0.0;     ///< the part of it that the noise of b makes on average
    bool has_variance = false;  ///< of either picture
    /// Pixels with |Y_a - Y_b| > tolerance + relative |Y_b| + standard_errors * standard error of the difference.
    std::size_t far = 0;

    /// relative_mse without the noise of b; with it where that is not known.
    double without_noise() const { return std::isfinite(noise_mse) ? relative_mse - noise_mse : relative_mse; }
};

/// Differences that `LuminanceDifference::far` allows.
struct LuminanceTolerance {
    double absolute = 0.0;  ///< in units of Y
    double relative = 0.0;  ///< times |Y_b|
    double standard_errors = 3.0;
};

/// @throws InputError as compute_luminance_error
LuminanceDifference compare_luminance(const ChannelImage& a, const ChannelImage& b,
                                      const LuminanceTolerance& tolerance);

}  // namespace aleph
