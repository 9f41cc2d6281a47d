// `aleph maps`: the maps of a scene's frames, or of frames without a scene.

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/parallel.h"
#include "engine/image/image_file.h"
#include "engine/scene/scene_hash.h"
#include "render/cli/commands.h"
#include "render/cli/film.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/options.h"
#include "render/cli/support/output_path.h"
#include "render/cli/support/render_signals.h"
#include "render/cli/write_frames.h"
#include "render/compare/visible_difference.h"
#include "render/images/image_sequence.h"
#include "render/images/picture_frame.h"
#include "render/output/channel_table.h"
#include "render/settings/fingerprint.h"
#include "render/settings/frame_list.h"
#include "render/settings/frame_pattern.h"
#include "render/settings/motion_source.h"
#include "render/settings/setting_table.h"

namespace aleph {

namespace {

struct MapsOptions {
    SceneOptions common;
    std::vector<std::string> images;
    std::string cuts;
    std::optional<double> exposure;
    PictureLayers layers;
};

const FrameRequest maps_request{.frame = false, .maps = true, .progress = {}};

void refuse_what_needs_a_scene(const MapsOptions& options) {
    if (!options.common.scene.empty() || options.images.size() > 1) {
        throw InputError("", "--images",
                         "give a scene or one pattern, not more; quotes keep the shell from replacing it by file "
                         "names: --images 'frame.####.exr'");
    }
    if (!options.common.camera.empty()) throw InputError("", "--camera", "this needs a scene");
    if (!options.common.crop.empty()) throw InputError("", "--crop", "this needs a scene");
    check_as_options([&] { refuse_settings_of_scenes(options.common.settings); });
}

/// "frame.####.exr" to "frame-maps".
std::string name_of_maps(const std::filesystem::path& pattern) {
    std::string name = pattern.stem().string();
    name.erase(std::min(name.find_first_of("#%"), name.size()));
    name.erase(name.find_last_not_of("._-") + 1);
    return (name.empty() ? "frame" : name) + maps_suffix;
}

struct PreparedImages {
    PreparedScene prepared;  ///< a scene without objects: what is known of the shot
    FrameFiles files;
    bool with_motion = false;  ///< in the files
};

/// Finds and checks everything that can be known before a map is computed.
PreparedImages prepare_images(const MapsOptions& options) {
    check_threads(options.common.threads);
    refuse_what_needs_a_scene(options);
    const std::string& pattern = options.images.front();
    PreparedImages images;
    images.files = find_frame_files(pattern);
    PreparedScene& prepared = images.prepared;
    for (const auto& [frame, path] : images.files) prepared.read.push_back(path);
    Scene& shot = prepared.scene;
    shot.source.file = pattern;
    shot.film.exposure = 1.0;
    const ChannelImage first = read_image(images.files.begin()->second);
    // Our own frames and those of most programs carry their rate.
    const ViewingSettings shown = read_viewing(first);
    shot.film.viewing = shown.viewing;
    shot.film.frame_rate = shown.frame_rate;
    images.with_motion = read_picture_frame(images.files.begin()->second, options.layers).motion.has_value();
    if (!options.common.fps.empty()) shot.film.frame_rate = parse_fps(options.common.fps);
    SettingMap given = options.common.settings;
    set_scene_numbers(shot, given, "--set");
    if (options.exposure) shot.film.exposure = *options.exposure;
    apply_given(prepared.settings, given);
    MotionSource& source = prepared.settings.guide.motion;
    source = source_for_pictures(source);
    if (!first.channels.empty()) {
        prepared.settings.picture.width = first.channels.front().values.width;
        prepared.settings.picture.height = first.channels.front().values.height;
    }
    shot.film.cuts =
        read_cuts(options.cuts, {images.files.begin()->first, images.files.rbegin()->first}, options.common.quiet);
    if (options.common.frames.empty()) {
        for (const auto& [frame, path] : images.files) prepared.frames.push_back(static_cast<int>(frame));
    } else {
        prepared.frames = parse_frame_list(options.common.frames);
    }
    prepared.name = name_of_maps(pattern);
    return images;
}

/// All that the maps of every frame depend on.
std::string identity_of(const PreparedScene& prepared, const MapsOptions& options) {
    const auto& [color, motion, depth] = options.layers;
    return hash_bytes(fmt::format("{}\n{}\n{}\n{}\n{}",
                                  format_fingerprint(make_fingerprint(prepared.scene, prepared.settings, {})), color,
                                  motion, depth, describe_content(options.common, maps_request)));
}

void write_image_maps(const MapsOptions& options) {
    const PreparedImages images = prepare_images(options);
    const PreparedScene& prepared = images.prepared;
    if (!images.with_motion) refuse_gaps(images.files, prepared.scene.film.cuts, prepared.frames);
    prepare_frames_output(prepared, options.common, maps_request);
    const ThreadLimit limit(find_threads(options.common.threads));
    ImageSequence sequence(prepared.scene, images.files, prepared.settings, options.layers);
    std::uint64_t replaced = 0;  // pixels of the pictures that were no numbers
    int first_replaced = 0;      // the frame of the first of them
    const auto make = [&](int frame, const FrameRequest&) {
        FrameOutput maps = sequence.compute_maps(frame);
        if (replaced == 0) first_replaced = frame;
        replaced += maps.statistics.estimate.sanitized.replaced;
        return maps;
    };
    std::map<std::int64_t, std::string> hashes;  // SHA-1 of the pictures, each read once; empty where there is none
    const auto hash_of = [&](std::int64_t frame) {
        const auto [known, is_new] = hashes.emplace(frame, "");
        const auto file = images.files.find(frame);
        if (is_new && file != images.files.end()) known->second = hash_bytes(read_text(file->second));
        return known->second;
    };
    const std::string identity = identity_of(prepared, options);
    // A frame's motion needs one of its neighbours.
    const FramePrints prints{identity, [&](int frame) {
                                 return hash_bytes(fmt::format("{}\n{}\n{}\n{}\n{}", identity, frame,
                                                               hash_of(frame - 1), hash_of(frame), hash_of(frame + 1)));
                             }};
    FrameClaims claims = claim_frames(prepared, options.common, prints);
    write_frames({prepared.scene, prepared.settings, *prepared.scene.film.exposure, make, claims}, options.common,
                 maps_request);
    if (options.common.quiet || replaced == 0) return;
    std::cerr << fmt::format(
        "aleph: warning: {} pixels of the pictures, the first in frame {}, are NaN or infinite; they count as the "
        "median of their neighbours\n",
        replaced, first_replaced);
}

/// "  NAMES    HELP", in lines of at most 112 bytes.
std::string format_channel(const ChannelInfo& info) {
    constexpr int line_length = 112, indent = 27;
    std::string names = fmt::format("  {}", fmt::join(info.names, " "));
    if (names.size() + 1 > indent) names += "\n" + std::string(indent, ' ');
    return fmt::format("{:<{}}{}\n", names, indent, OIIO::Strutil::wordwrap(info.help, line_length, indent));
}

constexpr const char* after_channels =
    "\n"
    "With --images, framesPerSecond, whiteLuminance, pixelsPerDegree and displayPersistence come from the first EXR\n"
    "file if it has them. --fps and --set viewing.KEY=N override them; KEY is display_white, pixels_per_degree or\n"
    "persistence. Motion and depth come from the files that hold them. Else motion is found by comparison, by optical\n"
    "flow where the program was built with it (--motion names another way): it is unreliable without detail in the\n"
    "picture, and the faster things move. Pixels whose motion is not confirmed from the other picture count as still.\n"
    "\n"
    "Examples:\n"
    "  aleph maps scenes/pool/scene.json --frames 20 -o maps.exr\n"
    "  aleph maps scenes/pool/scene.json --frames 20 -o maps.png      six maps in one picture, to look at\n"
    "  aleph maps --images 'shot/frame.####.png' --fps 24 -o maps/\n"
    "  aleph maps --images 'shot/frame.####.png' --motion census -o maps/   motion as the thesis finds it\n"
    "  aleph maps --images 'quick.####.exr' --importance -o importance.####.png\n"
    "  aleph maps --images 'blender.####.exr' --layer ViewLayer.Combined -o maps/\n"
    "  aleph compare guided.exr dense.exr --threshold maps.exr      which differences would a viewer see?";

/// The channels (channel_table), where values of the shot come from, and examples.
std::string maps_footer() {
    std::string text = "EXR channels (render: only of `aleph render`; scene: not with --images):\n";
    for (const ChannelInfo& info : channel_table()) text += format_channel(info);
    return text + after_channels;
}

void add_picture_options(CLI::App& maps, MapsOptions& options) {
    const std::string group = "Frames without a scene";
    add_text(
        maps, "--images", "PATTERN", options.images,
        "pictures in place of a scene, such as 'frame.####.exr' or 'frame.%04d.png', in quotes: EXR and HDR (linear "
        "Rec.709), PNG and JPEG (sRGB), numbered without gaps; motion comes from the files that hold it, or from "
        "comparing them")
        ->group(group);
    const auto add_layer = [&](const char* option, std::string& layer, const char* help) {
        add_text(maps, option, "NAME", layer, help)->group(group);
    };
    add_layer("--layer", options.layers.color,
              "layer of an EXR file that holds the picture, such as ViewLayer.Combined; default: R, G and B outside of "
              "layers, else the only layer with colour, else the only one called Combined");
    add_layer("--motion-layer", options.layers.motion,
              "layer that holds motion to the next frame: channels u and v (pixels, u right, v up), or X, Y, Z and W "
              "as Blender's Vector pass (Z and W: this frame's position minus the next one's); none: compare pictures; "
              "default: forward, else the only layer called Vector");
    add_layer("--depth-layer", options.layers.depth,
              "layer whose channel Z is depth, which is copied; 1e10 and beyond without motion is background; none: no "
              "depth; default: Z outside of layers, else the only layer called Depth");
    add_text(maps, "--cuts", "LIST", options.cuts, "frames that begin a new shot: no motion from the frame before")
        ->group(group);
}

}  // namespace

void add_maps_command(CLI::App& app, Command& command) {
    CLI::App* maps =
        app.add_subcommand("maps", "write motion, saliency and Aleph maps of a scene's frames, or of any pictures");
    const auto options = std::make_shared<MapsOptions>();
    add_scene_options(*maps, options->common);
    maps->get_option("scene")->required(false);
    maps->add_flag("--importance", options->common.importance,
                   "write one picture in place of the maps: how much each pixel needs samples, 1 over aleph.Y, for "
                   "renderers that take such a picture; EXR (channel Y) or PNG (grey)");
    add_picture_options(*maps, *options);
    add_number(
        *maps, "--exposure", options->exposure,
        "factor on the values of pictures, so that white is 1 (default: 1), or on a scene's radiance in place of "
        "its own");
    maps->footer(maps_footer());
    maps->callback([options, maps, &command] {
        if (options->exposure && !(*options->exposure > 0.0 && *options->exposure <= 1e18))
            throw CLI::ValidationError("--exposure", "expected a number above 0, at most 1e+18");
        if (options->images.empty()) {
            if (options->common.scene.empty()) {
                throw CLI::RequiredError("a scene, or --images 'frame.####.exr'");
            }
            if (!options->cuts.empty()) throw CLI::ValidationError("--cuts", "a scene file names its own cuts");
            for (const char* const option : {"--layer", "--motion-layer", "--depth-layer"}) {
                if (maps->count(option) > 0) throw CLI::ValidationError(option, "a scene has no layers: give --images");
            }
            if (options->exposure) options->common.settings["exposure"] = *options->exposure;
        }
        command = [options] {
            // --resume goes on after a signal that comes while pictures or a scene are loaded.
            std::optional<RenderSignals> signals;
            if (options->common.resume) signals.emplace();
            const FilmFolder folder = choose_film(options->common, maps_request);
            if (!options->images.empty()) {
                write_image_maps(*options);
            } else {
                PreparedScene prepared = prepare_scene(options->common);
                prepared.name += maps_suffix;
                render_frames(std::move(prepared), options->common, maps_request);
            }
            return exit_done;
        };
    });
}

}  // namespace aleph
