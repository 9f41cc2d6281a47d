#pragma once
// How much of each spatial frequency band a pixel's surroundings hold: thesis 5.2, MODEL 5.2.

#include <array>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"
#include "perception/sensitivity.h"

namespace aleph {

/// L(i) = |A(i) - A(i+1)| of full-size levels, kept as signed differences at level i's own size (expansion is linear).
struct BandLevels {
    std::vector<LevelSize> sizes;                      ///< of levels 0..7
    std::array<Image<float>, band_count> differences;  ///< A(i) - expanded A(i+1)
    Image<float> finest, coarsest;                     ///< A(0), A(7), grey included
};

/// Where the sum of the bands is at most this part of max(|A0|, |A7|) it is rounding: R_6 = 1, the others 0.
inline constexpr float band_noise = 1e-5f;

/// @param a     Gaussian levels 0..7 at least, of A - grey: without its grey, weak bands keep more digits
/// @param grey  what was subtracted
BandLevels make_band_levels(const std::vector<Image<float>>& a, float grey);

/// The bands of some rows at full size. One per thread.
class BandRows {
  public:
    explicit BandRows(const BandLevels& levels);

    /// Prepares rows [begin, end); row() is valid until the next call.
    void load(int begin, int end);

    /// L(band) of row y, signed: its absolute value is L.
    const float* row(int band, int y) const { return bands_[static_cast<std::size_t>(band)] + offset(y); }
    const float* coarsest_row(int y) const { return coarsest_ + offset(y); }

  private:
    std::ptrdiff_t offset(int y) const { return static_cast<std::ptrdiff_t>(y - begin_) * width_; }

    const BandLevels& levels_;
    std::ptrdiff_t width_;
    int begin_ = 0;
    std::vector<RowExpander> expanders_;  ///< one per band and one for A(7): their rows live side by side
    std::array<const float*, band_count> bands_{};
    const float* coarsest_ = nullptr;
};

/// (5.3) R_i at full size; they sum to 1 everywhere. The Aleph pass works row by row and does not store them.
std::array<Image<float>, band_count> compute_band_response(const Image<float>& achromatic);

/// The mean of a frame, in double, summed in rows.
float mean_grey(const Image<float>& image);

}  // namespace aleph
