#pragma once
// Small renderings of some frames, measured by what their seconds depend on.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "render/cost_model.h"
#include "render/setting_check.h"
#include "render/settings.h"

namespace aleph {

struct Pilot {
    PilotRun run;
    int rendered = 0;  ///< frames that are no copies of others
};

/// At most three frames, in the middle of as many equal parts of the list.
std::vector<std::int64_t> choose_pilot_frames(const std::vector<int>& frames);

/// By which both sides of the picture are multiplied for a pilot: a quarter, and at least 32 pixels of width.
double find_pilot_scale(int width);

/// The size that the scale leaves of a picture.
PictureSize scale_size(PictureSize size, double scale);

/// Renders the frames in a smaller picture of the same angle, so that velocities in degrees stay the same.
/// @param settings  with the error that is asked for (RenderSettings::error)
/// @param camera    as for Sequence
/// @param scale     of both sides; 1 measures the frames themselves
/// @throws InputError as Sequence
Pilot render_pilot(Scene scene, RenderSettings settings, const std::string& camera,
                   const std::vector<std::int64_t>& frames, double scale);

/// How many key moments the frames read, jumps of the light not counted.
/// @param scene  of the Sequence, whose cuts include changes of the camera
std::size_t count_moments(const Scene& scene, const RenderSettings& settings, const std::vector<std::int64_t>& frames);

/// What a list of frames is, relative to its pilot.
/// @param pilot_frames  choose_pilot_frames
CostRatios find_cost_ratios(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                            const std::vector<std::int64_t>& pilot_frames, int rendered, double scale);

}  // namespace aleph
