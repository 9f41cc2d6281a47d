#include "render/images/image_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "motion/velocity.h"
#include "perception/sanitize.h"
#include "render/frame/frame_vision.h"
#include "render/settings/measure.h"
#include "render/settings/motion_source.h"

namespace aleph {

namespace {

std::string display_name(const std::filesystem::path& path) {
    return printable(path.string(), 4096);
}

/// A picture prepared for the model of vision and for the search of motion.
struct LoadedFrame {
    Image<Rgb> estimate;
    SanitizeCounts sanitized;
    SearchedPicture searched;                     ///< empty if motion is known
    std::optional<MotionField> motion, backward;  ///< of the file
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
    if (!files.contains(frame)) refuse_missing(files, frame);
    const auto is_one_shot = [&](std::int64_t first) { return files.contains(first + 1) && !is_cut(cuts, first + 1); };
    if (is_one_shot(frame)) return OtherFrame::next;
    const auto later = files.upper_bound(frame);
    if (later != files.end() && is_cut(cuts, later->first)) return OtherFrame::none;
    return files.contains(frame - 1) && is_one_shot(frame - 1) ? OtherFrame::previous : OtherFrame::none;
}

void refuse_gaps(const FrameFiles& files, const std::vector<std::int64_t>& cuts, const std::vector<int>& frames) {
    const std::set<std::int64_t> asked(frames.begin(), frames.end());
    for (const int frame : frames) {
        const auto own = files.find(frame);
        if (own == files.end()) refuse_missing(files, frame);
        const auto next = std::next(own);
        if (next == files.end() || next->first == own->first + 1 || is_cut(cuts, next->first)) continue;
        if (!asked.contains(next->first)) continue;
        const std::int64_t from = own->first + 1, to = next->first - 1;
        throw InputError(
            "", "--images",
            fmt::format("{} missing between {} and {}; add what is missing, choose a stretch without gaps with "
                        "--frames, or say --cuts {} if a new shot begins there",
                        from == to ? fmt::format("frame {} is", from) : fmt::format("frames {} to {} are", from, to),
                        display_name(own->second), display_name(next->second), next->first));
    }
}

struct ImageSequence::State {
    /// The part that both kinds of sequences share.
    State(Scene given, const RenderSettings& chosen)
        : shot(std::move(given)), settings(chosen), search(*picture_search(source_for_pictures(chosen.guide.motion))) {
        validate(chosen);
    }

    Scene shot;
    FrameFiles files;
    RenderSettings settings;
    PictureSearch search;
    std::function<PictureFrame(std::int64_t)> read;
    std::map<std::int64_t, LoadedFrame> loaded;    ///< the frame used last and its neighbours
    std::map<std::int64_t, PictureMotions> pairs;  ///< by the first of two frames: those with the frame used last
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
        if (motion_in_files) {
            made.motion = std::move(picture.motion);
            made.backward = std::move(picture.backward);
        }
        const auto exposure = static_cast<float>(shot.film.exposure.value_or(1.0));
        for (Rgb& pixel : made.estimate.pixels) pixel *= exposure;
        made.sanitized = sanitize_estimate(made.estimate);
        if (!motion_in_files) made.searched = prepare_picture(made.estimate, search);
        return loaded.emplace(frame, std::move(made)).first->second;
    }

    /// The motion between a frame and the next one, both ways.
    const PictureMotions& compare(std::int64_t first) {
        const auto found = pairs.find(first);
        if (found != pairs.end()) return found->second;
        const LoadedFrame &from = load(first), &to = load(first + 1);
        return pairs.emplace(first, compute_picture_motions(from.searched, to.searched, search)).first->second;
    }

    MotionField find_motion(std::int64_t frame, const LoadedFrame& now) {
        const OtherFrame which = now.motion ? is_cut(shot.film.cuts, frame + 1) ? OtherFrame::none : OtherFrame::next
                                            : find_other_frame(files, shot.film.cuts, frame);
        if (which == OtherFrame::none) return make_motion_field(width, height, MotionValidity::no_counterpart);
        if (now.motion) return *now.motion;
        if (which == OtherFrame::next) return compare(frame).there;
        MotionField motion = compare(frame - 1).back;
        turn_round(motion);
        return motion;
    }

    /// @param motion  to the other frame
    MotionField find_backward(std::int64_t frame, const LoadedFrame& now, const MotionField& motion) {
        if (is_cut(shot.film.cuts, frame)) return make_motion_field(width, height, MotionValidity::no_counterpart);
        if (now.motion) return now.backward.value_or(MotionField());
        if (files.contains(frame - 1)) return compare(frame - 1).back;
        MotionField backward = motion;
        turn_round(backward);
        return backward;
    }
};

ImageSequence::ImageSequence(Scene shot, FrameFiles files, const RenderSettings& settings, PictureLayers layers) {
    state_ = std::make_unique<State>(std::move(shot), settings);
    state_->files = std::move(files);
    state_->read = [files = state_->files, layers = std::move(layers)](std::int64_t frame) {
        return read_picture_frame(files.at(frame), layers);
    };
}

ImageSequence::ImageSequence(Scene shot, std::map<std::int64_t, PictureFrame> pictures,
                             const RenderSettings& settings) {
    state_ = std::make_unique<State>(std::move(shot), settings);
    for (const auto& [frame, picture] : pictures) state_->files[frame] = fmt::format("frame {}", frame);
    state_->read = [pictures = std::move(pictures)](std::int64_t frame) { return pictures.at(frame); };
}

ImageSequence::~ImageSequence() = default;

FrameOutput ImageSequence::compute_maps(std::int64_t frame) {
    State& s = *state_;
    StageClock clock, total;
    FrameOutput out;
    FrameStatistics& stats = out.statistics;
    stats.frame = frame;

    if (!s.files.contains(frame)) refuse_missing(s.files, frame);
    std::erase_if(s.loaded, [&](const auto& kept) { return std::abs(kept.first - frame) > 1; });
    std::erase_if(s.pairs, [&](const auto& kept) { return kept.first != frame && kept.first != frame - 1; });
    const LoadedFrame& now = s.load(frame);
    out.estimate = now.estimate;
    out.surface.depth = now.depth;
    note_estimate(out, now.sanitized, s.shot.film.viewing);
    clock.add_to(stats.seconds.estimate);
    out.motion = s.find_motion(frame, now);
    out.backward = s.find_backward(frame, now, out.motion);
    out.motion_from_picture = now.motion.has_value();
    if (!s.noise) s.noise.emplace(s.shot.film.viewing, s.shot.film.frame_rate, NoiseOverTime::fresh);
    out.velocity = compute_image_velocity(out.motion, s.shot.film.viewing, s.shot.film.frame_rate);
    clock.add_to(stats.seconds.motion);
    compute_frame_vision(out, s.shot, s.settings, *s.noise, true, clock);
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return out;
}

}  // namespace aleph
