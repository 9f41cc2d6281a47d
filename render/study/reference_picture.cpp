#include "render/study/reference_picture.h"

#include <fmt/format.h>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/sampling.h"
#include "engine/scene/scene_hash.h"
#include "render/compare/compare_luminance.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/settings/fingerprint.h"

namespace aleph {

namespace {

constexpr std::uint32_t reference_seed = 0x70696374u;  // keeps references apart from all that they judge

SceneWithSettings reference_of(const PreparedStudyScene& scene, const Study& study) {
    SceneWithSettings own = with_settings_of(scene, study, study.reference.settings);
    if (study.reference.kind == "settings") return own;
    const int bounces = own.settings.light.bounces;
    own.settings = traced_reference_settings(own.settings);
    if (study.settings.contains("bounces")) own.settings.light.bounces = bounces;
    own.settings.sampling.spp = study.reference.spp;
    return own;
}

/// By everything that the picture and its metadata depend on: the scene has the study's exposure and viewing
/// conditions.
std::filesystem::path name_file(const std::string& name, const SceneWithSettings& own, const std::string& kind,
                                std::int64_t frame) {
    const std::string what =
        fmt::format("{} {} {}", program_build(), hash_scene(own.scene), name_settings(setting_map(own.settings)));
    return fmt::format("{}-{}-{}x{}-{}-{}.exr", name, frame, own.settings.picture.width, own.settings.picture.height,
                       kind, hash_bytes(what).substr(0, 16));
}

/// The reference that is kept; without passes where there is none.
ChannelImage read_reference(const std::filesystem::path& path, const RenderSettings& settings) {
    if (!std::filesystem::exists(path)) return {};
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
    add_color(all, indirect_layer, output.shaded.indirect);
    return all;
}

}  // namespace

ReferencePicture find_or_make_reference(const PreparedStudyScene& scene, const Study& study, std::int64_t frame,
                                        const std::filesystem::path& folder, const ReferenceProgress& progress) {
    const StudyReference& wanted = study.reference;
    if (wanted.passes < 2) throw InputError("", "reference", "expected at least 2 passes: one has no variance");
    const SceneWithSettings own = reference_of(scene, study);
    ReferencePicture reference{{}, folder / name_file(scene.name, own, wanted.kind, frame)};
    reference.picture = read_reference(reference.file, own.settings);
    create_folder(folder);
    for (double done = reference_passes(reference.picture); done < wanted.passes; ++done) {
        const auto show = [&](double fraction, const char*) { progress(done + fraction); };
        const ChannelImage pass = render_pass(own.scene, own.settings, frame, done, show);
        add_pass(reference.picture, done == 0.0 ? pass : with_exposure_of(pass, reference.picture));
        write_exr(reference.file, reference.picture);
    }
    return reference;
}

bool is_reference_finished(const PreparedStudyScene& scene, const Study& study, std::int64_t frame,
                           const std::filesystem::path& folder) {
    const SceneWithSettings own = reference_of(scene, study);
    const std::filesystem::path file = folder / name_file(scene.name, own, study.reference.kind, frame);
    return reference_passes(read_reference(file, own.settings)) >= study.reference.passes;
}

std::optional<ThresholdNoise> find_noise(const SettingMap& settings, const std::string& variant) {
    for (const char* key : {noise_key, zero_mean_noise_key}) {
        const auto found = settings.find(key);
        if (found == settings.end()) continue;
        if (settings.size() > 1)
            throw InputError("", variant, "noise is added to the reference: no other setting stands beside it");
        const double* factor = std::get_if<double>(&found->second);
        if (factor == nullptr || !(*factor >= 0.0 && *factor <= 1000.0))
            throw InputError("", variant,
                             fmt::format("{}: expected a number from 0 to 1000, times the threshold", key));
        return ThresholdNoise{*factor, key == zero_mean_noise_key};
    }
    return std::nullopt;
}

ChannelImage add_threshold_noise(const ChannelImage& reference, const Image<float>& threshold,
                                 const ThresholdNoise& noise, std::uint32_t seed, std::int64_t frame) {
    ChannelImage noisy = reference;
    std::erase_if(noisy.channels, [](const Channel& channel) {
        return channel.name != "R" && channel.name != "G" && channel.name != "B";
    });
    const double scale = noise.factor / display_white_of(reference, reference);
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        const RandomKey key{seed, static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(i), 0x6e6f6973u};
        const double unit = static_cast<double>(RandomStream(key).next());
        const double added =
            scale * static_cast<double>(threshold.pixels[i]) * (noise.zero_mean ? 2.0 * unit - 1.0 : unit);
        for (Channel& channel : noisy.channels) channel.values.pixels[i] += static_cast<float>(added);
    }
    return noisy;
}

}  // namespace aleph
