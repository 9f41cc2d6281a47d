#pragma once
// The last pass of the model (Yee 2000, eq. 5.5 to 5.11): from bands, image velocity and saliency to the Aleph map, row
// by row. No image in between is stored.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "perception/band_response.h"
#include "perception/castle_row.h"

namespace aleph {

/// f_i of a row of retinal velocities (5.9), in float: within 2e-5 of elevation() in sensitivity.h.
class ElevationRow {
  public:
    /// @param rho  band frequencies, cycles per degree
    ElevationRow(const std::array<double, band_count>& rho, int width, const KellyModel& model = daly_1998);

    /// @param velocity  deg/s, `width` values, each finite and at least the drift
    void load(const float* velocity);

    /// True if f_band is 1 in the whole row: every rho_peak is above the band's frequency.
    bool is_one(int band) const;

    /// out[x] = f_band
    void elevations(int band, float* out) const;

  private:
    KellyModel model_;
    std::array<float, band_count> slope_;  ///< rho / rho_peak = slope * (c2 v + 2)
    std::vector<float> spread_;            ///< c2 v + 2
    float max_spread_ = 0.0f;
    std::vector<float> peak_;  ///< CSF_max
};

/// v_R (5.5) of a row, deg/s, in float. Velocities that are NaN or negative count as 0, above 1e30 as 1e30.
/// @param velocity  v_I, deg/s, `count` values
/// @param saliency  S, [0,1], `count` values
void retinal_velocity_row(const float* velocity, const float* saliency, int count, float* out);

/// What the eye follows of a row of velocities, deg/s: tracked_velocity() in float. Arguments as above.
void tracked_velocity_row(const float* velocity, const float* saliency, int count, float* out);

/// The part of an AlephPass that castle needs.
struct CastlePass {
    CastleTable table;
    const Image<float>& luminance;  ///< that the eye is adapted to, cd/m2
};

/// What the Aleph map is made from. All images have the size of level 0 of `bands`.
struct AlephPass {
    const BandLevels& bands;
    const Image<float>* velocity;        ///< deg/s; null: nothing moves
    const Image<float>* saliency;        ///< S, [0,1]; null: S = tracking_efficiency
    std::array<double, band_count> rho;  ///< band frequencies, cycles per degree
    KellyModel model = daly_1998;        ///< not used with `castle`
    const CastlePass* castle = nullptr;  ///< null: the elevations of `model`
};

struct AlephImages {
    Image<float> aleph;             ///< contrast elevation, [1, 250.76]
    Image<float> retinal_velocity;  ///< v_R, deg/s; empty if not requested
    /// R_i (5.3) and f_i (5.9) of each band, finest first; empty if not requested. Their products sum to the Aleph map.
    std::vector<Image<float>> responses, elevations;
    std::uint64_t clamped = 0;  ///< values that were outside [1, 250.76] before the final clamp
};

/// The Aleph map (5.11), or with castle the sum of R_i castle_elevation(rho_i). The same bits for any number of
/// threads.
AlephImages compute_aleph(const AlephPass& pass, bool with_retinal_velocity, bool with_bands = false);

}  // namespace aleph
