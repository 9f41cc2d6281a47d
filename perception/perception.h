#pragma once
// The vision model: from an estimate of a frame and its image velocity to the Aleph map. Source: Yee 2000, chapter 5;
// perception/README.md has every equation and where it is read differently.

#include <cstdint>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/frame_rate.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "perception/perception_settings.h"

namespace aleph {

struct PerceptionMaps {
    Image<float> aleph;             ///< (5.11) contrast elevation, no unit, 1 (strictest) to 250.6
    Image<float> adaptation;        ///< compute_adaptation_luminance, cd/m2; empty unless the model of vision uses it
    Image<float> retinal_velocity;  ///< (5.5) deg/s, at least .15; empty if not requested
    Image<float> saliency;          ///< S, [0,1]; empty unless the guide is `saliency`
    /// Sums of N(feature map) per channel; empty if not requested or if the guide is not `saliency`
    Image<float> conspicuity_intensity, conspicuity_color, conspicuity_orientation, conspicuity_motion;
    /// R_i (5.3) and f_i (5.9) of each band, finest first; empty if not requested or without a guide
    std::vector<Image<float>> responses, elevations;
    bool fallback = false;      ///< nothing stood out, or everything did: S = .82 everywhere (thesis 7.2)
    std::uint64_t clamped = 0;  ///< aleph values outside [1, 250.76] before the final clamp; 0 in valid scenes
};

/// Requests maps beyond `aleph` and `saliency`. Each costs time and memory.
struct PerceptionOutputs {
    bool retinal_velocity = false;
    bool conspicuity = false;
    bool bands = false;
};

/// Depends on its arguments only; the same bits for any number of threads. With guide `none` aleph is 1 everywhere.
/// @param estimate  sanitized (sanitize_estimate): linear RGB, Rec.709, white = 1 after exposure
/// @param velocity  deg/s, same size as `estimate`; negative and NaN count as 0
/// @throws InputError if the sizes differ, are empty, viewing or frame rate is not positive and finite, or there is no
/// model of vision
PerceptionMaps compute_perception(const Image<Rgb>& estimate, const Image<float>& velocity,
                                  const ViewingConditions& viewing, const FrameRate& frame_rate,
                                  const PerceptionSettings& settings, const PerceptionOutputs& outputs = {});

}  // namespace aleph
