#include "render/cli/scene_options.h"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "render/cli/frame_list.h"
#include "render/cli/output_path.h"
#include "render/cli/progress.h"
#include "render/frame_files.h"

namespace aleph {

FrameRate parse_fps(const std::string& text) {
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos) {
        const FrameRate rate{parse_value<int>(text.substr(0, slash), "--fps"),
                             parse_value<int>(text.substr(slash + 1), "--fps")};
        if (rate.numerator > 0 && rate.denominator > 0) return rate;
    } else {
        const double fps = parse_value<double>(text, "--fps");
        if (fps > 0.0 && fps <= 1e6 && fps == static_cast<double>(static_cast<std::int64_t>(fps))) {
            return {static_cast<std::int64_t>(fps), 1};
        }
        if (fps > 1e-3 && fps <= 1e6) return {static_cast<std::int64_t>(fps * 1000.0 + 0.5), 1000};
    }
    throw InputError("--fps", printable(text), "expected frames per second, such as 30 or 30000/1001");
}

void set_scene_numbers(Scene& scene, SettingMap& settings) {
    const auto take = [&](const std::string& key, auto&& apply) {
        const auto found = settings.find(key);
        if (found == settings.end()) return;
        const double* number = std::get_if<double>(&found->second);
        if (number == nullptr || !(*number > 0.0 && *number <= 1e18)) {
            throw InputError("--set", key, "expected a number above 0");
        }
        apply(*number);
        settings.erase(found);
    };
    take("exposure", [&](double v) { scene.exposure = v; });
    take("viewing.pixels_per_degree", [&](double v) { scene.viewing.pixels_per_degree = v; });
    take("viewing.display_white", [&](double v) { scene.viewing.display_white = v; });
}

namespace {

std::string option_name(std::string key) {
    for (char& c : key) c = c == '_' ? '-' : c;
    return "--" + key;
}

/// PNG for people, EXR for everything else; by the pattern's ending.
bool is_png(const std::filesystem::path& path) {
    return path.extension() == ".png";
}

}  // namespace

void add_load_limits(CLI::App& app, LoadLimits& limits) {
    app.add_option_function<std::string>(
           "--load-memory",
           [&limits](const std::string& text) {
               const auto mebibytes = parse_value<std::uint32_t>(text, "--load-memory");
               if (mebibytes < 16) throw CLI::ValidationError("--load-memory", "at least 16 MiB are needed");
               limits.memory = std::size_t{mebibytes} << 20;
           },
           "most memory that a scene's text may take to load; raise it for large scene files of your own")
        ->type_name("MIB")
        ->default_str(fmt::format("{}", limits.memory >> 20));
}

void add_scene_options(CLI::App& app, SceneOptions& options) {
    app.add_option("scene", options.scene, "a scene file (.json), .gltf, .glb or .abc")->required()->type_name("SCENE");
    app.add_option("--frames", options.frames, "frames, such as 1-10,20-40x2 (default: the scene's range)")
        ->type_name("LIST");
    app.add_option("--fps", options.fps, "frames per second in place of the scene's: 30, 30000/1001")->type_name("N");
    app.add_option("-o,--output", options.output,
                   "name.####.exr, name.####.png or a folder (default: SCENE.####.exr here)")
        ->type_name("PATTERN");
    app.add_option("--camera", options.camera, "name of a camera or of its node")->type_name("NAME");
    app.add_option("--stats", options.stats, "write counts and times of every frame")->type_name("FILE.json");
    add_load_limits(app, options.limits);
    add_value(app, "-t,--threads", options.threads, "threads; 0: all");
    app.add_flag("-q,--quiet", options.quiet, "no progress, no warnings");
    for (const SettingKey& key : setting_keys()) {
        app.add_option_function<std::string>(
               option_name(key.name),
               [&options, name = key.name](const std::string& value) {
                   parse_setting(name + "=" + value, options.settings);
               },
               key.help)
            ->type_name("VALUE")
            ->group("Settings (the scene file's \"settings\" have the same names)");
    }
    app.add_option_function<std::vector<std::string>>(
           "--set",
           [&options](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) parse_setting(text, options.settings);
           },
           "any setting of the scene file; also exposure, viewing.pixels_per_degree, viewing.display_white")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

PreparedScene prepare_scene(const SceneOptions& options) {
    PreparedScene prepared;
    prepared.scene = load_scene(options.scene, options.limits);
    Scene& scene = prepared.scene;
    if (!options.fps.empty()) scene.frame_rate = parse_fps(options.fps);
    apply_settings(prepared.settings, scene.settings, options.scene);
    SettingMap given = options.settings;
    set_scene_numbers(scene, given);
    apply_settings(prepared.settings, given, "");
    if (!options.quiet) {
        for (const std::string& warning : scene.warnings) {
            std::cerr << "aleph: warning: " << printable(warning, 400) << "\n";
        }
    }
    if (options.frames.empty()) {
        const FrameRange range = frame_range(scene);
        if (range.last - range.first >= 10000000) {
            throw InputError(options.scene, "frames", "more than 10 million frames; choose some with --frames");
        }
        for (std::int64_t f = range.first; f <= range.last; ++f) prepared.frames.push_back(static_cast<int>(f));
    } else {
        prepared.frames = parse_frame_list(options.frames);
    }
    prepared.name = std::filesystem::path(options.scene).stem().string();
    if (prepared.name == "scene") {
        prepared.name = std::filesystem::absolute(options.scene).parent_path().filename().string();
    }
    return prepared;
}

namespace {

/// Thresholds are in cd/m2: a scene in other units would be all below or all above them (HARD_CASES CS-14).
void warn_of_units(const FrameStatistics& frame) {
    const double median = frame.median_luminance;
    if (median == 0.0 || (median >= 1e-3 && median <= 1e4)) return;
    std::cerr << fmt::format(
        "aleph: warning: frame {}: the median luminance is {:.3g} cd/m2, outside 1e-3 to 1e4: check \"exposure\" and "
        "\"display_white\" of the scene\n",
        frame.frame, median);
}

}  // namespace

void write_frames(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request, bool maps,
                  const std::string& title) {
    prepare_frames_output(prepared, options, maps);
    const ThreadLimit limit(options.threads);
    Sequence sequence(prepared.scene, prepared.settings, options.camera);
    write_made_frames(prepared, options, request, maps, title, sequence.exposure(),
                      [&](int frame, const FrameRequest& asked) { return sequence.render(frame, asked); });
}

void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, bool maps) {
    prepare_output(options.output, prepared.name, prepared.frames.size());
    if (maps && is_png(output_path(options.output, prepared.name, prepared.frames.front()))) {
        throw InputError("--output", printable(options.output), "maps need channels: write .exr, not .png");
    }
}

void write_made_frames(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request,
                       bool maps, const std::string& title, double exposure, const FrameMaker& make_frame) {
    std::vector<FrameStatistics> statistics;
    Progress progress(title, static_cast<double>(prepared.frames.size()), progress_look(options.quiet));
    for (std::size_t i = 0; i < prepared.frames.size(); ++i) {
        const int frame = prepared.frames[i];
        FrameRequest asked = request;
        asked.progress = [&](double fraction, const char* stage) {
            progress.update(static_cast<double>(i) + fraction, fmt::format("frame {}: {}", frame, stage));
        };
        FrameOutput output = make_frame(frame, asked);
        const auto start = std::chrono::steady_clock::now();
        const std::filesystem::path path = output_path(options.output, prepared.name, frame);
        if (is_png(path)) {
            write_png(path, output.shaded.color);
        } else {
            write_exr(path, make_frame_image(output, maps, prepared.scene, prepared.settings, exposure));
        }
        StageSeconds& seconds = output.statistics.seconds;
        seconds.write = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        seconds.total += seconds.write;
        if (i == 0 && !options.quiet) warn_of_units(output.statistics);
        statistics.push_back(output.statistics);
        progress.update(static_cast<double>(i + 1), fmt::format("frame {}", frame));
    }
    if (!options.stats.empty()) {
        write_file(options.stats, format_statistics(statistics, prepared.scene, prepared.settings, exposure));
    }
}

}  // namespace aleph
