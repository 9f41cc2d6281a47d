#pragma once
// The ambient accuracy of every pixel from the Aleph map (Yee 2000, section 6.1).

#include "engine/base/image.h"
#include "render/settings/settings.h"

namespace aleph {

/// Yee 2000, eq. 6.7, as a N / (1 + a (N - 1)) for the accuracy a and aleph N: a at N = 1, 1 at infinity; 0 if a is 0.
/// Values of aleph below 1, and NaN, count as 1.
double compress_accuracy(double accuracy, double aleph);

/// Yee 2000, eq. 6.8: accuracy + aleph / k, at most 1; 0 if the accuracy is 0.
double scale_add_accuracy(double accuracy, double aleph, double k);

/// Standard deviation of irradiance that is interpolated at accuracy 1, relative.
inline constexpr double error_per_accuracy = 0.1;

/// The way from the Aleph map to ambient accuracy of a program's own: GuideSettings::own_adapter.
class AccuracyAdapter {
  public:
    virtual ~AccuracyAdapter() = default;

    /// alpha per pixel, of the same size. Values count within 0 to 1, and NaN as `accuracy`.
    /// @param accuracy  CacheSettings::accuracy
    virtual Image<float> adapt(const Image<float>& aleph, double accuracy) const = 0;
};

/// alpha per pixel. With Guide::none it is settings.cache.accuracy everywhere, for all adapters.
/// @throws InputError if a program's own adapter returns another size
Image<float> compute_accuracy_map(const Image<float>& aleph, const RenderSettings& settings);

}  // namespace aleph
