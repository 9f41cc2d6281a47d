#pragma once
// How much of each spatial frequency band a pixel's surroundings hold: thesis 5.2.

#include <array>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"
#include "perception/sensitivity.h"

namespace aleph {

/// What L(i) = |A(i) - A(i+1)| of full-size levels is made from. Expansion is linear, so signed differences of levels
/// are kept at level i's own size; those of band 0, at full size, are not kept at all.
struct BandLevels {
    std::vector<LevelSize> sizes;                      ///< of levels 0..7
    float grey = 0.0f;                                 ///< subtracted from A: weak bands keep more digits without it
    RowSource finest;                                  ///< A(0) - grey
    Image<float> second, coarsest;                     ///< A(1), A(7), minus grey
    std::array<Image<float>, band_count> differences;  ///< A(i) - expanded A(i+1), i >= 1
};

/// Where the sum of the bands is at most this part of max(|A0|, |A7|) it is rounding: R_6 = 1, the others 0.
inline constexpr float band_noise = 1e-5f;

/// @param finest  A - grey; must outlive the result, like what it reads from
/// @param a       its Gaussian levels, 1..7 at least; level 0 is not looked at
BandLevels make_band_levels(LevelSize size, RowSource finest, const std::vector<Image<float>>& a, float grey);

/// The bands of one row at a time, at full size. One per thread.
class BandRows {
  public:
    explicit BandRows(const BandLevels& levels);

    /// Prepares rows [begin, end).
    void load(int begin, int end);

    /// Row y of every band; what the functions below return holds until the next call.
    void expand_row(int y);

    /// L(band), signed: its absolute value is L.
    const float* band(int i) const { return rows_[i].data(); }
    /// What the sum of the bands must exceed: band_noise * max(|A0|, |A7|).
    const float* noise() const { return noise_.data(); }

  private:
    const BandLevels& levels_;
    std::vector<RowExpander> expanders_;  ///< by level: differences of bands 1..6; 0: A(1); 7: A(7)
    std::array<std::vector<float>, band_count> rows_;
    std::vector<float> finest_, noise_;
};

/// What perception asks of a whole channel first.
struct ChannelSummary {
    float mean = 0.0f;
    float largest = 0.0f;
};

/// The mean in double, summed row by row: the same for any number of threads.
ChannelSummary summarize(LevelSize size, const RowSource& source);

}  // namespace aleph
