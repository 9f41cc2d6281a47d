#pragma once
// The model of vision applied to a frame: from its estimate and motion to the accuracy of each pixel.

#include "engine/scene/scene.h"
#include "perception/noise_threshold.h"
#include "render/frame/frame_output.h"
#include "render/settings/measure.h"
#include "render/settings/settings.h"

namespace aleph {

/// Notes a sanitized estimate in the frame's statistics: what sanitizing changed, and the median luminance.
void note_estimate(FrameOutput& out, const SanitizeCounts& sanitized, const ViewingConditions& viewing);

/// Fills perception, threshold and alpha from `estimate` and `velocity`, which are filled.
/// @param maps   also the maps that only files need: retinal velocity and conspicuity
void compute_frame_vision(FrameOutput& out, const Scene& shot, const RenderSettings& settings,
                          const NoiseVisibility& noise, bool maps, StageClock& clock);

}  // namespace aleph
