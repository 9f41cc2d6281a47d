#include "render/images/image_sequence.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "motion/image_motion.h"
#include "perception/sanitize.h"
#include "render/frame/frame_vision.h"
#include "render/settings/measure.h"

namespace aleph {

namespace {

std::string display_name(const std::filesystem::path& path) {
    return printable(path.string(), 4096);
}

/// A picture prepared for the model of vision and for the search of motion.
struct LoadedFrame {
    Image<Rgb> estimate;
    SanitizeCounts sanitized;
    CensusPyramid census;               ///< empty if motion is known
    std::optional<MotionField> motion;  ///< of the file
    Image<float> depth;
};

[[noreturn]] void refuse_missing(const FrameFiles& files, std::int64_t frame) {
    throw InputError("", "--images",
                     files.empty() ? std::string("there are no frames")
                                   : fmt::format("frame {} is not there; the frames found lie from {} to {}", frame,
                                                 files.begin()->first, files.rbegin()->first));
}

bool is_cut(const std::vector<std::int64_t>& cuts, std::int64_t frame) {
    return std::ranges::find(cuts, frame) != cuts.end();
}

}  // namespace

OtherFrame find_other_frame(const FrameFiles& files, const std::vector<std::int64_t>& cuts, std::int64_t frame) {
    const auto own = files.find(frame);
    if (own == files.end()) refuse_missing(files, frame);
    const bool backward = std::next(own) == files.end();
    if (backward && own == files.begin()) return OtherFrame::none;
    const auto other = backward ? std::prev(own) : std::next(own);
    const auto& [first, second] = backward ? std::pair(other, own) : std::pair(own, other);
    if (is_cut(cuts, second->first)) return OtherFrame::none;
    if (second->first != first->first + 1) {
        const std::int64_t from = first->first + 1, to = second->first - 1;
        throw InputError(
            "", "--images",
            fmt::format("{} missing between {} and {}; add what is missing, choose a stretch without "
                        "gaps with --frames, or say --cuts {} if a new shot begins there",
                        from == to ? fmt::format("frame {} is", from) : fmt::format("frames {} to {} are", from, to),
                        display_name(first->second), display_name(second->second), second->first));
    }
    return backward ? OtherFrame::previous : OtherFrame::next;
}

struct ImageSequence::State {
    Scene shot;
    FrameFiles files;
    RenderSettings settings;
    std::function<PictureFrame(std::int64_t)> read;
    std::map<std::int64_t, LoadedFrame> loaded;  ///< at most the two frames used last
    int width = 0, height = 0;
    std::string first_read;
    bool motion_in_files = false;
    std::optional<NoiseVisibility> noise;  ///< made when first needed

    const LoadedFrame& load(std::int64_t frame) {
        const auto found = loaded.find(frame);
        if (found != loaded.end()) return found->second;
        const std::filesystem::path& path = files.at(frame);
        PictureFrame picture = read(frame);
        LoadedFrame made;
        made.estimate = std::move(picture.color);
        made.depth = std::move(picture.depth);
        if (first_read.empty()) {
            first_read = display_name(path);
            motion_in_files = picture.motion.has_value();
            width = made.estimate.width;
            height = made.estimate.height;
        } else if (made.estimate.width != width || made.estimate.height != height) {
            throw InputError(display_name(path), "",
                             fmt::format("this frame has {}x{} pixels, {} has {}x{}; all frames must have one size",
                                         made.estimate.width, made.estimate.height, first_read, width, height));
        }
        if (motion_in_files && !picture.motion) {
            throw InputError(
                display_name(path), "",
                fmt::format("this frame has no motion, {} has; --motion-layer none compares pictures instead",
                            first_read));
        }
        if (motion_in_files) made.motion = std::move(picture.motion);
        const auto exposure = static_cast<float>(shot.film.exposure.value_or(1.0));
        for (Rgb& pixel : made.estimate.pixels) pixel *= exposure;
        made.sanitized = sanitize_estimate(made.estimate);
        if (!motion_in_files) made.census = make_census_pyramid(made.estimate);
        return loaded.emplace(frame, std::move(made)).first->second;
    }

    MotionField find_motion(std::int64_t frame, const LoadedFrame& now) {
        if (now.motion && !is_cut(shot.film.cuts, frame + 1)) return *now.motion;
        if (now.motion) return compute_image_motion(make_census_pyramid(now.estimate), {}, OtherFrame::none);
        const OtherFrame which = find_other_frame(files, shot.film.cuts, frame);
        const std::int64_t other_number = other_frame_number(frame, which);
        std::erase_if(loaded, [&](const auto& entry) { return entry.first != frame && entry.first != other_number; });
        const LoadedFrame* const other = which == OtherFrame::none ? nullptr : &load(other_number);
        return compute_image_motion(now.census, other != nullptr ? other->census : CensusPyramid(), which);
    }
};

ImageSequence::ImageSequence(Scene shot, FrameFiles files, const RenderSettings& settings, PictureLayers layers) {
    validate(settings);
    state_ = std::make_unique<State>();
    state_->shot = std::move(shot);
    state_->files = std::move(files);
    state_->settings = settings;
    state_->read = [files = state_->files, layers = std::move(layers)](std::int64_t frame) {
        return read_picture_frame(files.at(frame), layers);
    };
}

ImageSequence::ImageSequence(Scene shot, std::map<std::int64_t, PictureFrame> pictures,
                             const RenderSettings& settings) {
    validate(settings);
    state_ = std::make_unique<State>();
    state_->shot = std::move(shot);
    for (const auto& [frame, picture] : pictures) state_->files[frame] = fmt::format("frame {}", frame);
    state_->settings = settings;
    state_->read = [pictures = std::move(pictures)](std::int64_t frame) { return pictures.at(frame); };
}

ImageSequence::~ImageSequence() = default;
ImageSequence::ImageSequence(ImageSequence&&) noexcept = default;

FrameOutput ImageSequence::compute_maps(std::int64_t frame) {
    State& s = *state_;
    StageClock clock, total;
    FrameOutput out;
    FrameStatistics& stats = out.statistics;
    stats.frame = frame;

    if (!s.files.contains(frame)) refuse_missing(s.files, frame);
    const LoadedFrame& now = s.load(frame);
    out.estimate = now.estimate;
    out.surface.depth = now.depth;
    note_estimate(out, now.sanitized, s.shot.film.viewing);
    clock.add_to(stats.seconds.estimate);
    out.motion = s.find_motion(frame, now);
    out.motion_from_picture = now.motion.has_value();
    if (!s.noise) s.noise.emplace(s.shot.film.viewing, s.shot.film.frame_rate, NoiseOverTime::fresh);
    compute_frame_vision(out, s.shot, s.settings, *s.noise, true, clock);
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return out;
}

}  // namespace aleph
