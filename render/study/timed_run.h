#pragma once
// Frames rendered with one variant's settings, and what they took.

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/settings/settings.h"

namespace aleph {

/// Time and work of a frame, with the lighting keyframes that it was the first to need.
struct FrameRun {
    std::int64_t frame = 0;
    double processor_seconds = 0.0;  ///< of all threads
    double wall_seconds = 0.0;
    std::vector<std::pair<std::string, double>> stages;  ///< seconds of a clock; "keyframes" last
    std::vector<std::pair<std::string, double>> rays;    ///< by kind
    double samples = 0.0;                                ///< per pixel
    double records = 0.0;
    std::string plan;   ///< of effects, JSON (effect_table.h)
    bool timed = true;  ///< false: another program made it, and what it took is not known
};

/// Receives the picture of each frame of a run.
using SaveFrame = std::function<void(std::int64_t frame, const ChannelImage& picture)>;

/// Renders the frames in order with one Sequence, as `aleph render` does, so that later frames find the light of key
/// keyframes that earlier ones needed. The pictures hold R, G, B, A, indirect.R/G/B and every map that rendering makes
/// anyway. Writing files is not timed.
/// @param progress  called with the share that is done, 0 to 1; may be empty
/// @throws InputError as Sequence
std::vector<FrameRun> render_run(const Scene& scene, const RenderSettings& settings, const std::vector<int>& frames,
                                 const SaveFrame& save, const std::function<void(double)>& progress);

}  // namespace aleph
