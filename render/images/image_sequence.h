#pragma once
// Maps of existing pictures, without a scene: picture -> motion, from the file or from a comparison with the next
// picture -> saliency, Aleph map -> accuracy.

#include <memory>

#include "engine/scene/scene.h"
#include "motion/motion_field.h"
#include "render/frame/frame_output.h"
#include "render/images/picture_frame.h"
#include "render/settings/frame_pattern.h"
#include "render/settings/settings.h"

namespace aleph {

/// The frame that `frame` is compared with for its motion: the next one, or the previous one at the last frame and
/// before a gap; none across a cut, and for a frame without neighbours.
/// @param cuts  frames that begin a new shot
/// @throws InputError: there is no such frame
OtherFrame find_other_frame(const FrameFiles& files, const std::vector<std::int64_t>& cuts, std::int64_t frame);

/// Refuses gaps between the frames that are asked for, unless a new shot begins behind them.
/// @throws InputError naming the missing files
void refuse_gaps(const FrameFiles& files, const std::vector<std::int64_t>& cuts, const std::vector<int>& frames);

/// Maps of frames in files. In ascending order of frames every picture is read once.
class ImageSequence {
  public:
    /// @param shot  a scene without objects: frame rate, viewing conditions, exposure (1 if not set) and cuts are used
    /// @param layers  of the pictures. If the first frame that is read has motion, all frames take theirs from their
    /// files
    /// @throws InputError: settings out of range
    ImageSequence(Scene shot, FrameFiles files, const RenderSettings& settings, PictureLayers layers = {});
    /// Maps of pictures in memory.
    /// @param pictures  by frame number, colours with exposure
    /// @throws InputError: as above, if there are none, or if their sizes differ
    ImageSequence(Scene shot, std::map<std::int64_t, PictureFrame> pictures, const RenderSettings& settings);
    ~ImageSequence();

    /// Fills estimate (the picture, exposed and sanitized), motion, depth if the file has it, velocity, perception,
    /// alpha, threshold, statistics.
    /// @throws InputError: a frame that is missing or unreadable, of another size than the first one read, or without
    /// motion where the first one has it
    FrameOutput compute_maps(std::int64_t frame);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace aleph
