#pragma once
// Frames without a scene: pictures that someone else rendered or filmed, and the maps of perception for them.
// The order of a frame without geometry: picture -> image-based motion -> saliency, Aleph map -> alpha.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>

#include "motion/other_frame.h"
#include "render/sequence.h"

namespace aleph {

/// A frame from a file as linear RGB: EXR and HDR as they are (Rec.709 is taken for granted, alpha is ignored because
/// colour is already multiplied by it), PNG and JPEG decoded from sRGB and shown over black where they have alpha.
/// A picture of one channel Y is grey.
/// @throws InputError
Image<Rgb> load_linear_frame(const std::filesystem::path& path);

/// Where each frame lies, by its number.
using FrameFiles = std::map<std::int64_t, std::filesystem::path>;

/// The frame whose picture tells how `frame` moves: the next one; the one before at the last frame. None across a
/// cut, and for a single frame.
/// @param cuts  frames that begin a new shot. Frame numbers may have gaps there and nowhere else.
/// @throws InputError naming the missing files: `frame`'s own, or those up to the next frame that exists
OtherFrame find_other_frame(const FrameFiles& files, const std::vector<std::int64_t>& cuts, std::int64_t frame);

/// Maps of frames in files, one after the other; every picture is read once where they come in order.
class ImageSequence {
  public:
    /// @param shot  what is known of it: viewing conditions, exposure (1 where not set), cuts. It holds no objects.
    ImageSequence(const Scene& shot, FrameFiles files, const RenderSettings& settings);
    ~ImageSequence();
    ImageSequence(ImageSequence&&) noexcept;

    /// Fills estimate (the picture, exposed and sanitized), motion, velocity, perception, alpha, threshold, statistics.
    /// @throws InputError: a frame that is missing or unreadable, or of another size than the first one read
    FrameOutput compute_maps(std::int64_t frame);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace aleph
