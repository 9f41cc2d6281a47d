#include "scenes/studies/study_tools.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/errors.h"
#include "render/cli/frame_pattern.h"
#include "render/cli/progress.h"
#include "render/frame_files.h"

namespace aleph {

namespace {

template <class Names>
ChannelImage keep(const ChannelImage& image, const Names& names) {
    ChannelImage kept{{}, image.metadata};
    for (const Channel& channel : image.channels) {
        if (std::ranges::find(names, channel.name) != names.end()) kept.channels.push_back(channel);
    }
    return kept;
}

constexpr std::array picture_channels = {"R", "G", "B", "variance.Y"};
constexpr std::array threshold_channels = {"forward.u",  "forward.v",   "motion.valid",
                                           "objectId.X", "threshold.Y", "threshold.flicker"};

}  // namespace

RenderedFrames render_frames(const Scene& scene, const RenderSettings& settings, FrameRange range,
                             const AfterFrame& after) {
    Sequence sequence(scene, settings);
    RenderedFrames frames;
    frames.first = range.first;
    const auto count = static_cast<double>(range.last - range.first + 1);
    for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
        const FrameOutput output = sequence.render(frame);
        frames.pictures.push_back(
            keep(make_frame_image(output, false, sequence.scene(), settings, sequence.exposure()), picture_channels));
        frames.seconds += output.statistics.seconds.total / count;
        frames.gather_rays += static_cast<double>(output.statistics.counts.rays.gather) / count;
        frames.records += static_cast<double>(output.statistics.counts.records) / count;
        if (after) after(frame);
    }
    return frames;
}

std::vector<ChannelImage> compute_threshold_maps(const Scene& scene, RenderSettings settings, FrameRange range) {
    settings.perception.guide = Guide::saliency;
    Sequence sequence(scene, settings);
    FrameRequest request;
    request.frame = false;
    request.maps = true;
    std::vector<ChannelImage> maps;
    for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
        maps.push_back(keep(
            make_frame_image(sequence.render(frame, request), true, sequence.scene(), settings, sequence.exposure()),
            threshold_channels));
    }
    return maps;
}

StudyRow measure_frames(const RenderedFrames& frames, const std::vector<ChannelImage>& reference,
                        const std::vector<ChannelImage>& maps) {
    StudyRow row{frames.seconds, frames.gather_rays, frames.records, 0.0, {}, std::nullopt};
    SequenceComparison sequence({});
    for (std::size_t i = 0; i < frames.pictures.size(); ++i) {
        const FrameComparison comparison =
            sequence.add(frames.first + static_cast<std::int64_t>(i), frames.pictures[i], reference.at(i), &maps.at(i));
        const LuminanceDifference& luminance = comparison.result.luminance.value();
        row.relative_mse +=
            (luminance.relative_mse - luminance.noise_mse) / static_cast<double>(frames.pictures.size());
    }
    const SequenceSummary summary = sequence.summary();
    row.error = summary.threshold.value();
    row.flicker = summary.flicker;
    return row;
}

std::string guide_name(Guide guide) {
    RenderSettings settings;
    settings.perception.guide = guide;
    return std::get<std::string>(setting_map(settings).at("guide"));
}

std::vector<ChannelImage> load_or_render_reference(const Scene& scene, const RenderSettings& settings, FrameRange range,
                                                   const std::string& pattern, bool quiet) {
    std::vector<std::filesystem::path> files;
    if (!pattern.empty()) {
        const auto field = find_number_field(pattern, "--reference");
        if (!field) throw InputError("", "--reference", "needs a name such as reference.####.exr");
        for (std::int64_t frame = range.first; frame <= range.last; ++frame)
            files.emplace_back(insert_number(pattern, *field, static_cast<int>(frame)));
    }
    const auto exists = [](const std::filesystem::path& file) { return std::filesystem::exists(file); };
    std::vector<ChannelImage> reference;
    if (!files.empty() && std::ranges::all_of(files, exists)) {
        for (const std::filesystem::path& file : files) {
            reference.push_back(read_image(file));
            const Image<float>* red = reference.back().find("R");
            if (!red || red->width != settings.width || red->height != settings.height) {
                throw InputError(file.string(), "",
                                 fmt::format("is no picture of {}x{} pixels", settings.width, settings.height));
            }
        }
        return reference;
    }
    Progress progress("reference", static_cast<double>(range.last - range.first + 1), progress_look(quiet));
    double done = 0.0;
    reference = render_frames(scene, settings, range, [&](std::int64_t frame) {
                    progress.update(++done, fmt::format("frame {}", frame));
                }).pictures;
    for (std::size_t i = 0; i < files.size(); ++i) write_exr(files[i], reference[i]);
    return reference;
}

}  // namespace aleph
