#include "render/study/reference_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "engine/base/errors.h"
#include "engine/scene/scene_hash.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/settings/fingerprint.h"

namespace aleph {

namespace {

constexpr std::uint32_t reference_seed = 0x70696374u;  // keeps references apart from all that they judge

RenderSettings reference_settings(const RenderSettings& settings, const ReferencePictureOptions& options) {
    if (options.kind == "settings") return settings;
    RenderSettings out = traced_reference_settings(settings);
    if (!options.full_light) out.light.bounces = settings.light.bounces;
    out.sampling.spp = options.pass_spp;
    return out;
}

/// Describes everything that the picture depends on, but for its scene.
std::string describe_settings(const RenderSettings& settings, const ReferencePictureOptions& options) {
    std::string text =
        fmt::format("{} {} {} {} {}", settings.sampling.spp, settings.light.bounces, settings.light.path_depth,
                    settings.picture.subdivision_level, static_cast<int>(settings.picture.filter));
    if (options.kind != "settings") return text;
    for (const auto& [key, value] : setting_map(settings)) text += fmt::format(" {}={}", key, setting_text(value));
    return text;
}

ChannelImage read_reference(const std::filesystem::path& path, const RenderSettings& settings) {
    ChannelImage image = read_image(path);
    for (const char* name : {"R", "G", "B", "variance.Y", "noise.R", "noise.G", "noise.B"}) {
        const Image<float>* channel = image.find(name);
        if (!channel || channel->width != settings.picture.width || channel->height != settings.picture.height ||
            !(reference_passes(image) >= 1.0)) {
            throw InputError(path.string(), "", "is no reference picture of this size");
        }
    }
    return image;
}

/// Where samples lie in a pixel may depend on their number alone. So each pass has a number of its own: passes with
/// equal samples would all make the same error at an edge, which their differences do not tell.
/// @param pass  number of this rendering, which chooses its random numbers
ChannelImage render_pass(const Scene& scene, RenderSettings settings, std::int64_t frame, double pass,
                         const FrameProgress& progress) {
    // New noise in every frame, also of a camera that never moves: what lasts is then a mean over frames.
    settings.seed = reference_seed + static_cast<std::uint32_t>(pass) + static_cast<std::uint32_t>(frame) * 0x9e3779b9u;
    settings.sampling.spp += static_cast<int>(pass);
    Sequence sequence(scene, settings);
    FrameRequest request;
    request.progress = progress;
    const FrameOutput output = sequence.render(frame, request);
    ChannelImage all = make_frame_image(output, false, sequence.scene(), settings, sequence.exposure());
    std::erase_if(all.channels, [](const Channel& channel) { return channel.name.size() > 1 || channel.name == "A"; });
    add_indirect(all, output.shaded);
    return all;
}

}  // namespace

void add_indirect(ChannelImage& image, const ShadedFrame& shaded) {
    if (shaded.indirect.empty()) return;
    for (int c = 0; c < 3; ++c) {
        Image<float> values(shaded.indirect.width, shaded.indirect.height);
        for (std::size_t i = 0; i < values.size(); ++i) values.pixels[i] = shaded.indirect.pixels[i][c];
        image.channels.push_back({indirect_channels[static_cast<std::size_t>(c)], std::move(values)});
    }
}

std::filesystem::path reference_picture_path(const RenderSettings& given, std::int64_t frame,
                                             const ReferencePictureOptions& options) {
    const RenderSettings settings = reference_settings(given, options);
    const std::string what =
        hash_bytes(program_build() + " " + options.identity + " " + describe_settings(settings, options)).substr(0, 16);
    return std::filesystem::path(options.folder) / fmt::format("{}-{}-{}x{}-{}-{}.exr", options.name, frame,
                                                               settings.picture.width, settings.picture.height,
                                                               options.kind, what);
}

ChannelImage load_or_render_reference_picture(const Scene& scene, const RenderSettings& given, std::int64_t frame,
                                              const ReferencePictureOptions& options,
                                              const ReferenceProgress& progress) {
    if (options.passes < 2) throw InputError("", "reference", "expected at least 2 passes: one has no variance");
    const RenderSettings settings = reference_settings(given, options);
    const std::filesystem::path path = reference_picture_path(given, frame, options);
    ChannelImage reference;
    if (std::filesystem::exists(path)) reference = read_reference(path, settings);
    if (reference_passes(reference) >= options.passes) return reference;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    for (double done = reference_passes(reference); done < options.passes; ++done) {
        const auto show = [&](double fraction, const char*) {
            if (progress) progress(done + fraction);
        };
        const ChannelImage pass = render_pass(scene, settings, frame, done, show);
        add_pass(reference, done == 0.0 ? pass : with_exposure_of(pass, reference));
        write_exr(path, reference);
    }
    return reference;
}

}  // namespace aleph
