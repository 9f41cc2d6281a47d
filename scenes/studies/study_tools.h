#pragma once
// Rendering frames in several ways, and measuring them against a reference with the thresholds of a model of vision.

#include <functional>
#include <string>
#include <vector>

#include "render/compare_sequence.h"
#include "render/sequence.h"

namespace aleph {

/// Consecutive frames as pictures, with means over them.
struct RenderedFrames {
    std::int64_t first = 0;
    std::vector<ChannelImage> pictures;  ///< R, G, B and, path traced, variance.Y
    double seconds = 0.0, gather_rays = 0.0, records = 0.0;
};

/// Called after each frame.
using AfterFrame = std::function<void(std::int64_t frame)>;

RenderedFrames render_frames(const Scene& scene, const RenderSettings& settings, FrameRange range,
                             const AfterFrame& after = {});

/// The motion, objects and thresholds of the frames, for the guide saliency and the settings' model of vision.
std::vector<ChannelImage> compute_threshold_maps(const Scene& scene, RenderSettings settings, FrameRange range);

/// A row of a table: means over the frames and sums over their pixels.
struct StudyRow {
    double seconds = 0.0, gather_rays = 0.0, records = 0.0;  ///< per frame
    double relative_mse = 0.0;  ///< of luminance, less the reference's noise; mean of the frames
    ThresholdFigures error;
    std::optional<FlickerFigures> flicker;  ///< none of a single frame
};

/// @param maps  of every frame (compute_threshold_maps)
StudyRow measure_frames(const RenderedFrames& frames, const std::vector<ChannelImage>& reference,
                        const std::vector<ChannelImage>& maps);

/// The setting's name: none, spatial, full or saliency.
std::string guide_name(Guide guide);

/// The files `pattern` of the frames if all exist. Otherwise renders them with these settings, and writes them unless
/// the pattern is empty.
/// @param pattern  such as "reference.####.exr"; may be empty
/// @throws InputError if the pattern has no place for the number, or a file has another size
std::vector<ChannelImage> load_or_render_reference(const Scene& scene, const RenderSettings& settings, FrameRange range,
                                                   const std::string& pattern, bool quiet);

}  // namespace aleph
