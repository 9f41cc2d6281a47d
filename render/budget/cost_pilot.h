#pragma once
// Measures some frames, so that their cost at other errors can be predicted (cost_model.h).

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "render/budget/cost_model.h"
#include "render/settings/setting_table.h"
#include "render/settings/settings.h"

namespace aleph {

/// At most three frames, in the middle of as many equal parts of the list.
std::vector<std::int64_t> choose_pilot_frames(const std::vector<int>& frames);

/// The size that a factor leaves of a picture.
PictureSize scale_size(PictureSize size, double scale);

/// Frames to measure, and how.
struct PilotRequest {
    const Scene& scene;
    std::string camera;  ///< as for Sequence
    std::vector<std::int64_t> frames;
    std::vector<RenderSettings> settings;  ///< of the same pictures at falling errors; the first is the largest
    /// Returns whether to go on to the next step, whose seconds are expected to be about these. Not asked before the
    /// first small picture, the parts of the first frame and their first two errors.
    std::function<bool(const PilotSeconds& measured, double next)> go_on;
};

/// A pilot, and how many of its frames are no copies of others.
struct Pilot {
    PilotSeconds seconds;
    int rendered = 0;
};

/// Measures light in two small pictures, of which one has four times the pixels of the other, and parts of the full
/// picture.
/// @throws InputError as Sequence
Pilot run_pilot(const PilotRequest& request);

/// Finds the numbers of a list of frames, relative to its pilot.
/// @param pilot_frames  choose_pilot_frames
CostRatios find_cost_ratios(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                            const std::vector<std::int64_t>& pilot_frames, int rendered);

}  // namespace aleph
