#pragma once
// The ambient accuracy of every pixel from the Aleph map (Yee 2000, section 6.1).

#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "render/settings/settings.h"

namespace aleph {

/// Yee 2000, eq. 6.7, as a N / (1 + a (N - 1)) for the accuracy a and aleph N: a at N = 1, 1 at infinity; 0 if a is 0.
/// Values of aleph below 1, and NaN, count as 1.
double compress_accuracy(double accuracy, double aleph);

/// Yee 2000, eq. 6.8: accuracy + aleph / k, at most 1; 0 if the accuracy is 0.
double scale_add_accuracy(double accuracy, double aleph, double k);

/// Standard deviation of irradiance that is interpolated at accuracy 1, relative.
inline constexpr double error_per_accuracy = 0.1;

/// 10 * accuracy * tolerance, from 0.02 to 1; 0 if the accuracy is 0. Irradiance interpolated at accuracy alpha errs by
/// about a tenth of alpha (standard deviation), so that errors stay at that share of the threshold: a seventh at the
/// default accuracy. The rest is left to the other parts of a picture's light.
/// @param tolerance  compute_tolerance; not above 0, or NaN, counts as none
double threshold_accuracy(double accuracy, double tolerance);

/// The relative error of indirect light that a viewer tolerates: threshold over luminance. Infinite where there is no
/// indirect light.
/// @param threshold  cd/m2 (compute_threshold)
/// @param indirect   relative luminance of the indirect light, exposure applied, of the same size
Image<float> compute_tolerance(const Image<float>& threshold, const Image<float>& indirect,
                               const ViewingConditions& viewing);

/// alpha per pixel. With Guide::none it is settings.cache.accuracy everywhere, for all adapters.
/// @param tolerance  compute_tolerance, of the same size; only read by Adapter::threshold
Image<float> compute_accuracy_map(const Image<float>& aleph, const Image<float>& tolerance,
                                  const RenderSettings& settings);

}  // namespace aleph
