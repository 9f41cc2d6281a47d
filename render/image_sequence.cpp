#include "render/image_sequence.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/image/image_file.h"
#include "motion/image_motion.h"
#include "perception/sanitize.h"
#include "render/frame_vision.h"
#include "render/measure.h"

namespace aleph {

namespace {

std::string display_name(const std::filesystem::path& path) {
    return printable(path.string(), 4096);
}

/// A picture prepared for the model of vision and for the search of motion.
struct LoadedFrame {
    Image<Rgb> estimate;
    SanitizeCounts sanitized;
    CensusPyramid census;
};

}  // namespace

Image<Rgb> load_linear_frame(const std::filesystem::path& path) {
    const ChannelImage file = read_image(path);
    const Image<float>* channels[3] = {file.find("R"), file.find("G"), file.find("B")};
    const Image<float>* const grey = file.find("Y");
    for (const Image<float>*& channel : channels) {
        if (channel == nullptr) channel = grey;
        if (channel == nullptr) throw InputError(display_name(path), "", "a frame needs channels R, G and B, or Y");
    }
    Image<Rgb> frame(channels[0]->width, channels[0]->height);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        for (int c = 0; c < 3; ++c) frame.pixels[i][c] = channels[c]->pixels[i];
    }
    if (!file.metadata.contains("encoding")) return frame;
    const Image<float>* const alpha = file.find("A");
    for (std::size_t i = 0; i < frame.size(); ++i) {
        Rgb& pixel = frame.pixels[i];
        for (int c = 0; c < 3; ++c) pixel[c] = srgb_to_linear(pixel[c]);
        if (alpha != nullptr) pixel *= alpha->pixels[i];
    }
    return frame;
}

OtherFrame find_other_frame(const FrameFiles& files, const std::vector<std::int64_t>& cuts, std::int64_t frame) {
    const auto own = files.find(frame);
    if (own == files.end()) {
        throw InputError("", "--images",
                         files.empty() ? std::string("there are no frames")
                                       : fmt::format("frame {} is not there; the frames found lie from {} to {}", frame,
                                                     files.begin()->first, files.rbegin()->first));
    }
    const auto is_cut = [&](std::int64_t number) { return std::find(cuts.begin(), cuts.end(), number) != cuts.end(); };
    const bool backward = std::next(own) == files.end();
    if (backward && own == files.begin()) return OtherFrame::none;
    const auto other = backward ? std::prev(own) : std::next(own);
    const auto& [first, second] = backward ? std::pair(other, own) : std::pair(own, other);
    if (is_cut(second->first)) return OtherFrame::none;
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
    std::map<std::int64_t, LoadedFrame> loaded;  ///< at most the two frames used last
    int width = 0, height = 0;
    std::string first_read;

    const LoadedFrame& load(std::int64_t frame) {
        const auto found = loaded.find(frame);
        if (found != loaded.end()) return found->second;
        const std::filesystem::path& path = files.at(frame);
        LoadedFrame made;
        made.estimate = load_linear_frame(path);
        if (first_read.empty()) {
            first_read = display_name(path);
            width = made.estimate.width;
            height = made.estimate.height;
        } else if (made.estimate.width != width || made.estimate.height != height) {
            throw InputError(display_name(path), "",
                             fmt::format("this frame has {}x{} pixels, {} has {}x{}; all frames must have one size",
                                         made.estimate.width, made.estimate.height, first_read, width, height));
        }
        const auto exposure = static_cast<float>(shot.exposure.value_or(1.0));
        for (Rgb& pixel : made.estimate.pixels) pixel *= exposure;
        made.sanitized = sanitize_estimate(made.estimate);
        made.census = make_census_pyramid(made.estimate);
        return loaded.emplace(frame, std::move(made)).first->second;
    }
};

ImageSequence::ImageSequence(Scene shot, FrameFiles files, const RenderSettings& settings) {
    validate(settings);
    state_ = std::make_unique<State>();
    state_->shot = std::move(shot);
    state_->files = std::move(files);
    state_->settings = settings;
}

ImageSequence::~ImageSequence() = default;
ImageSequence::ImageSequence(ImageSequence&&) noexcept = default;

FrameOutput ImageSequence::compute_maps(std::int64_t frame) {
    State& s = *state_;
    StageClock clock, total;
    FrameOutput out;
    FrameStatistics& stats = out.statistics;
    stats.frame = frame;

    const OtherFrame which = find_other_frame(s.files, s.shot.cuts, frame);
    const std::int64_t other_number = other_frame_number(frame, which);
    std::erase_if(s.loaded, [&](const auto& entry) { return entry.first != frame && entry.first != other_number; });
    const LoadedFrame& now = s.load(frame);
    const LoadedFrame* const other = which == OtherFrame::none ? nullptr : &s.load(other_number);
    out.estimate = now.estimate;
    note_estimate(out, now.sanitized, s.shot.viewing);
    clock.add_to(stats.seconds.estimate);

    out.motion = compute_image_motion(now.census, other != nullptr ? other->census : CensusPyramid(), which);
    compute_frame_vision(out, s.shot, s.settings, true, clock);
    stats.peak_memory_mib = peak_memory_mib();
    total.add_to(stats.seconds.total);
    return out;
}

}  // namespace aleph
