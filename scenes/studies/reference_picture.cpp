#include "scenes/studies/reference_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "engine/base/errors.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/compare_luminance.h"
#include "render/frame_files.h"
#include "render/sequence.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

constexpr std::uint32_t reference_seed = 0x70696374u;  // keeps references apart from all that they judge
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr const char *variance_name = "variance.Y", *passes_key = "passes", *exposure_key = "exposureFactor",
                     *seconds_key = "processorSeconds";

double number_in(const ChannelImage& image, const char* key) {
    const auto found = image.metadata.find(key);
    const double* number = found == image.metadata.end() ? nullptr : std::get_if<double>(&found->second);
    return number ? *number : 0.0;
}

RenderSettings reference_settings(const RenderSettings& settings, const ReferencePictureOptions& options) {
    RenderSettings out;
    out.width = settings.width;
    out.height = settings.height;
    out.bounces = settings.bounces;
    out.path_depth = settings.path_depth;
    out.subdivision_level = settings.subdivision_level;
    out.estimate = settings.estimate;  // the automatic exposure is that of the estimate
    out.perception.guide = Guide::none;
    out.spp = options.pass_spp;
    if (options.kind == "path") {
        out.integrator = Integrator::path;
    } else {
        out.accuracy = 0.0;
        out.light_step = 0;
        out.gather = 16;
        out.light_samples = 2 * options.pass_spp;
    }
    if (has_setting("filter")) out = with_choice(out, "filter", "box");
    return out;
}

std::filesystem::path reference_path(const RenderSettings& settings, std::int64_t frame, const std::string& file,
                                     const ReferencePictureOptions& options) {
    const std::string what = fmt::format("{} {} {} {} {}", hash_file(file), settings.spp, settings.bounces,
                                         settings.path_depth, settings.subdivision_level);
    return std::filesystem::path(options.folder) / fmt::format("{}-{}-{}x{}-{}-{}.exr", scene_name(file), frame,
                                                               settings.width, settings.height, options.kind,
                                                               hash_text(what));
}

ChannelImage read_reference(const std::filesystem::path& path, const RenderSettings& settings) {
    ChannelImage image = read_image(path);
    for (const char* name : {"R", "G", "B", variance_name}) {
        const Image<float>* channel = image.find(name);
        if (!channel || channel->width != settings.width || channel->height != settings.height ||
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
    settings.seed = reference_seed + static_cast<std::uint32_t>(pass);
    const int light_samples_each = std::max(1, settings.light_samples / settings.spp);
    settings.spp += static_cast<int>(pass);
    settings.light_samples = light_samples_each * settings.spp;
    Sequence sequence(scene, settings);
    const double start = processor_seconds();
    FrameRequest request;
    request.progress = progress;
    ChannelImage all =
        make_frame_image(sequence.render(frame, request), false, sequence.scene(), settings, sequence.exposure());
    std::erase_if(all.channels, [](const Channel& channel) { return channel.name.size() > 1 || channel.name == "A"; });
    all.metadata[seconds_key] = processor_seconds() - start;
    return all;
}

}  // namespace

void add_reference_options(CLI::App& app, ReferencePictureOptions& options) {
    add_value(app, "--reference-passes", options.passes, "renderings that the reference is the mean of");
    add_value(app, "--reference-spp", options.pass_spp, "samples per pixel of each");
    app.add_option("--reference-kind", options.kind,
                   "how the reference is made: by traced paths, or by gathers without a cache")
        ->check(CLI::IsMember({"path", "gather"}))
        ->capture_default_str();
    app.add_option("--references", options.folder,
                   "folder for references, which are read if they exist; those with fewer passes get more")
        ->capture_default_str();
}

double reference_passes(const ChannelImage& reference) {
    return number_in(reference, passes_key);
}

double reference_seconds(const ChannelImage& reference) {
    return number_in(reference, seconds_key);
}

void add_pass(ChannelImage& mean, const ChannelImage& pass) {
    const double count = reference_passes(mean);
    if (count == 0.0) {
        mean = pass;
        const Image<float>& red = pass.channels.front().values;
        mean.channels.push_back({variance_name, Image<float>(red.width, red.height, infinite)});
        mean.metadata[passes_key] = 1.0;
        return;
    }
    const Image<Rgb> before = linear_colour(mean), added = linear_colour(pass);
    for (Channel& channel : mean.channels) {
        for (std::size_t i = 0; i < before.size(); ++i) {
            float& value = channel.values.pixels[i];
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
    mean.metadata[seconds_key] = number_in(mean, seconds_key) + number_in(pass, seconds_key);
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
                                              const std::string& file, const ReferencePictureOptions& options,
                                              bool quiet) {
    if (options.passes < 2) throw InputError("", "--reference-passes", "expected at least 2: one has no variance");
    const RenderSettings settings = reference_settings(given, options);
    const std::filesystem::path path = reference_path(settings, frame, file, options);
    ChannelImage reference;
    if (std::filesystem::exists(path)) reference = read_reference(path, settings);
    if (reference_passes(reference) >= options.passes) return reference;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    Progress progress(fmt::format("reference of {} {}", scene_name(file), frame), options.passes, progress_look(quiet));
    for (double done = reference_passes(reference); done < options.passes; ++done) {
        const auto show = [&](double fraction, const char*) { progress.update(done + fraction); };
        const ChannelImage pass = render_pass(scene, settings, frame, done, show);
        add_pass(reference, done == 0.0 ? pass : with_exposure(pass, number_in(reference, exposure_key)));
        write_exr(path, reference);
    }
    return reference;
}

}  // namespace aleph
