#pragma once
// The whole stage: an estimate of a frame and its image velocity in, the Aleph map and everything it came from out.
// Source: Yee 2000, chapter 5; readings in README.md ("Where we read the thesis differently").

#include <cstdint>

#include "engine/base/color.h"
#include "engine/base/frame_rate.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "perception/perception_settings.h"

namespace aleph {

struct PerceptionMaps {
    Image<float> aleph;             ///< (5.11) contrast elevation, no unit, 1 (strictest) to 250.6
    Image<float> retinal_velocity;  ///< (5.5) deg/s, at least .15; filled on request
    Image<float> saliency;          ///< [0,1]; filled with guide `saliency`
    /// N-weighted sums per channel before their own N(.); filled with guide `saliency`, on request
    Image<float> conspicuity_intensity, conspicuity_color, conspicuity_orientation, conspicuity_motion;
    bool fallback = false;      ///< nothing stood out, or everything did: S = .82 everywhere (thesis 7.2)
    std::uint64_t clamped = 0;  ///< aleph values that left [1, 250.76] before the final clamp; 0 in valid scenes
};

/// Which of the maps beyond `aleph` are wanted: each costs memory traffic.
struct PerceptionOutputs {
    bool retinal_velocity = false;
    bool conspicuity = false;
};

/// Pure and deterministic, the same bits for any number of threads. Guide `none` asks nothing of the model: aleph is 1.
/// @param estimate  sanitized (sanitize_estimate): linear RGB, Rec.709, white = 1 after exposure
/// @param velocity  deg/s, same size as `estimate`; negative and NaN count as 0
/// @throws InputError if the sizes differ, are empty, or viewing or frame rate is not positive and finite
PerceptionMaps compute_perception(const Image<Rgb>& estimate, const Image<float>& velocity,
                                  const ViewingConditions& viewing, const FrameRate& frame_rate,
                                  const PerceptionSettings& settings, const PerceptionOutputs& outputs = {});

}  // namespace aleph
