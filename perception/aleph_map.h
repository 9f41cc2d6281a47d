#pragma once
// The last pass of the model (Yee 2000, eq. 5.5 to 5.11): from bands, image velocity and saliency to the Aleph map, row
// by row. No image in between is stored.

#include <array>

#include "engine/base/image.h"
#include "perception/band_response.h"
#include "perception/perception.h"
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

/// The Aleph map, which is the sum of R_i f_i (5.11), and of the other maps retinal velocity and bands where they are
/// requested. The same bits for any number of threads.
void compute_aleph(const AlephPass& pass, const PerceptionOutputs& outputs, PerceptionMaps& maps);

}  // namespace aleph
