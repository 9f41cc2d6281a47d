#pragma once
// Bands of spatial frequency around each pixel: Yee 2000, section 5.2.

#include <array>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"
#include "perception/vision/band_frequencies.h"

namespace aleph {

/// The bands L(i) = |A(i) - A(i+1)| of full-size levels (5.2) in compact form. Expansion is linear, so the signed
/// differences are stored at level i's own size; those of band 0, at full size, are not stored.
struct BandLevels {
    std::vector<LevelSize> sizes;                      ///< of levels 0..7
    float grey = 0.0f;                                 ///< subtracted from A, so that weak bands keep more digits
    Image<float> finest, second, coarsest;             ///< A(0), A(1), A(7), minus grey
    std::array<Image<float>, band_count> differences;  ///< A(i) - expanded A(i+1), i >= 1
};

/// Where the sum of the bands is at most band_noise * max(|A0|, |A7|), it is rounding: R_6 = 1, the others are 0.
inline constexpr float band_noise = 1e-5f;

/// @param a  Gaussian levels of A - grey, at least 0..7; level 0 is moved into the result
BandLevels make_band_levels(std::vector<Image<float>>& a, float grey);

/// The bands of one row at a time, at full size. Each thread needs its own.
class BandRows {
  public:
    explicit BandRows(const BandLevels& levels);

    /// Prepares rows [begin, end).
    void load(int begin, int end);

    /// Expands row y of every band. The pointers that band() and noise() return are valid until the next call.
    void expand_row(int y);

    /// The signed difference whose absolute value is L(i).
    const float* band(int i) const { return rows_[i].data(); }
    /// band_noise * max(|A0|, |A7|): the sum of the bands must exceed it.
    const float* noise() const { return noise_.data(); }

  private:
    const BandLevels& levels_;
    std::vector<RowExpander> expanders_;  ///< by level: differences of bands 1..6; 0: A(1); 7: A(7)
    std::array<std::vector<float>, band_count> rows_;
    std::vector<float> noise_;
};

struct ChannelSummary {
    float mean = 0.0f;
    float maximum = 0.0f;
};

/// Mean and maximum of a channel. The mean is summed in double row by row: the same for any number of threads.
ChannelSummary summarize(const Image<float>& channel);

}  // namespace aleph
