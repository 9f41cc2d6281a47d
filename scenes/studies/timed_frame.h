#pragma once
// One frame, rendered alone: its picture, and what it took.

#include <string>
#include <utility>
#include <vector>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/settings/settings.h"
#include "render/study/picture_error.h"

namespace aleph {

/// What a frame took. Seconds are of a processor: those of all threads together, which other programs disturb less than
/// they disturb a clock. They are read for the whole; stages have a clock only, whose seconds are scaled to the whole.
struct FrameCost {
    std::vector<std::pair<std::string, double>> stages;  ///< of the frame, by name
    double frame_seconds = 0.0;                          ///< of all stages of the frame
    double moment_seconds = 0.0;                         ///< of the key moments that the frame needs
    double clock_seconds = 0.0;                          ///< of both
    double rays = 0.0;                                   ///< of both
    double mean_samples = 0.0, most_samples = 0.0;       ///< per pixel

    double seconds() const { return frame_seconds + moment_seconds; }
};

struct TimedFrame {
    ChannelImage picture;  ///< R, G, B, A
    PictureClaim claim;    ///< `errors` is empty if the program estimates none
    FrameCost cost;
    std::string statistics;  ///< JSON, as aleph render --stats writes it
};

/// @param repeats  renderings, at least 1: the cost is of the one with the median of seconds
TimedFrame render_timed(const Scene& scene, const RenderSettings& settings, std::int64_t frame, int repeats);

}  // namespace aleph
