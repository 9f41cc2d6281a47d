#pragma once
// The last pass of the model (Yee 2000, eq. 5.5 to 5.11): from bands, image velocity and saliency to the Aleph map, row
// by row. No image in between is stored.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "perception/band_response.h"
#include "perception/vision/vision_model.h"

namespace aleph {

/// The input of the Aleph map. All images have the size of level 0 of `bands`.
struct AlephPass {
    const BandLevels& bands;
    const Image<float>* velocity;        ///< deg/s; null: nothing moves
    const Image<float>* saliency;        ///< S, [0,1]; null: S = tracking_efficiency
    std::array<double, band_count> rho;  ///< band frequencies, cycles per degree
    const VisionModel& vision;
    Presentation shown;
    const Image<float>* luminance = nullptr;  ///< that the eye is adapted to, cd/m2; null unless the model uses it
};

struct AlephImages {
    Image<float> aleph;             ///< contrast elevation, [1, 250.76]
    Image<float> retinal_velocity;  ///< v_R, deg/s; empty if not requested
    /// R_i (5.3) and f_i (5.9) of each band, finest first; empty if not requested. Their products sum to the Aleph map.
    std::vector<Image<float>> responses, elevations;
    std::uint64_t clamped = 0;  ///< values that were outside [1, 250.76] before the final clamp
};

/// The Aleph map: the sum of R_i f_i (5.11). The same bits for any number of threads.
AlephImages compute_aleph(const AlephPass& pass, bool with_retinal_velocity, bool with_bands = false);

}  // namespace aleph
