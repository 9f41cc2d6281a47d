#include "render/study/reference_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/base/errors.h"
#include "engine/scene/scene_hash.h"
#include "render/compare/compare_luminance.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/settings/program_build.h"

namespace aleph {

namespace {

constexpr std::uint32_t reference_seed = 0x70696374u;  // keeps references apart from all that they judge
/// Diffuse bounces of a reference: what is left out is at most albedo^16 of the light.
constexpr int full_light_bounces = 16;
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr const char *variance_name = "variance.Y", *passes_key = "passes", *exposure_key = "exposureFactor";

double number_in(const ChannelImage& image, const char* key) {
    const auto found = image.metadata.find(key);
    const double* number = found == image.metadata.end() ? nullptr : std::get_if<double>(&found->second);
    return number ? *number : 0.0;
}

RenderSettings reference_settings(const RenderSettings& settings, const ReferencePictureOptions& options) {
    if (options.kind == "settings") return settings;
    RenderSettings out;
    out.picture.width = settings.picture.width;
    out.picture.height = settings.picture.height;
    out.light.bounces = std::max(settings.light.bounces, options.full_light ? full_light_bounces : 0);
    out.light.path_depth = settings.light.path_depth;
    out.picture.subdivision_level = settings.picture.subdivision_level;
    out.guide.estimate = settings.guide.estimate;  // the automatic exposure is that of the estimate
    out.perception.guide = Guide::none;
    out.picture.filter = settings.picture.filter;
    out.sampling.spp = options.pass_spp;
    if (options.kind == "path") {
        out.light.integrator = Integrator::path;
    } else {
        out.cache.accuracy = 0.0;
        out.cache.light_step = 0;
        out.cache.gather = 16;
        out.light.light_samples = 2 * options.pass_spp;
    }
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
    for (const char* name : {"R", "G", "B", variance_name, "noise.R", "noise.G", "noise.B"}) {
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
    const int light_samples_each = std::max(1, settings.light.light_samples / settings.sampling.spp);
    settings.sampling.spp += static_cast<int>(pass);
    settings.light.light_samples = light_samples_each * settings.sampling.spp;
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

double reference_passes(const ChannelImage& reference) {
    return number_in(reference, passes_key);
}

void add_pass(ChannelImage& mean, const ChannelImage& pass) {
    const double count = reference_passes(mean);
    if (count == 0.0) {
        mean = pass;
        const Image<float>& red = pass.channels.front().values;
        mean.channels.push_back({variance_name, Image<float>(red.width, red.height, infinite)});
        for (const char* name : {"R", "G", "B"}) mean.channels.push_back({std::string("noise.") + name, *pass.find(name)});
        mean.metadata[passes_key] = 1.0;
        return;
    }
    const float sign = std::fmod(count, 2.0) == 0.0 ? 1.0f : -1.0f;
    const Image<Rgb> before = linear_colour(mean), added = linear_colour(pass);
    for (Channel& channel : mean.channels) {
        for (std::size_t i = 0; i < before.size(); ++i) {
            float& value = channel.values.pixels[i];
            if (channel.name.starts_with("noise.")) {  // the passes with alternating signs
                const float signed_pass = sign * pass.find(channel.name.substr(6))->pixels[i];
                value += static_cast<float>((signed_pass - value) / (count + 1.0));
                continue;
            }
            if (channel.name != variance_name) {
                value += static_cast<float>((pass.find(channel.name)->pixels[i] - value) / (count + 1.0));
                continue;
            }
            const double squares = count > 1.0 ? value * count * (count - 1.0) : 0.0;  // Welford 1962
            const double difference = double{luminance(added.pixels[i])} - luminance(before.pixels[i]);
            value = static_cast<float>((squares / count + difference * difference / (count + 1.0)) / (count + 1.0));
        }
    }
    mean.metadata[passes_key] = count + 1.0;
}

ChannelImage with_exposure(ChannelImage picture, double exposure) {
    const double had = number_in(picture, exposure_key);
    if (!(had > 0.0) || had == exposure) return picture;
    for (Channel& channel : picture.channels) {
        const double scale = channel.name == "variance.Y" ? exposure / had * exposure / had : exposure / had;
        for (float& value : channel.values.pixels) value = static_cast<float>(value * scale);
    }
    picture.metadata[exposure_key] = exposure;
    return picture;
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
        add_pass(reference, done == 0.0 ? pass : with_exposure(pass, number_in(reference, exposure_key)));
        write_exr(path, reference);
    }
    return reference;
}

}  // namespace aleph
