#include "render/cli/scene_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <iostream>
#include <map>
#include <ranges>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "render/cli/support/options.h"
#include "render/cli/watch.h"
#include "render/settings/frame_list.h"
#include "render/settings/setting_table.h"
#include "render/study/prepared_study.h"

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

PictureArea parse_crop(const std::string& text, const PictureSettings& picture) {
    std::vector<int> ends;
    for (const auto part : std::views::split(text, ','))
        ends.push_back(parse_value<int>(std::string_view(part.begin(), part.end()), "--crop"));
    const auto fits = [&](std::size_t i, int side) {
        return 0 <= ends[i] && ends[i] < ends[i + 1] && ends[i + 1] <= side;
    };
    if (ends.size() == 4 && fits(0, picture.width) && fits(2, picture.height))
        return {ends[0], ends[2], ends[1] - ends[0], ends[3] - ends[2]};
    throw InputError(
        "", "--crop",
        fmt::format("'{}': expected X0,X1,Y0,Y1 with 0 <= X0 < X1 <= {} and 0 <= Y0 < Y1 <= {}, within the "
                    "picture of {}x{}",
                    printable(text), picture.width, picture.height, picture.width, picture.height));
}

namespace {

std::string option_name(std::string key) {
    for (char& c : key) c = c == '_' ? '-' : c;
    return "--" + key;
}

/// "WIDTHxHEIGHT", "N", "NUMBER", "flat|direct".
std::string value_name(const Setting& setting) {
    constexpr const char* names[] = {"WIDTHxHEIGHT", "N", "NUMBER", "", "EFFECT,...", "true|false"};  // as SettingType
    if (setting.type == SettingType::choice) return fmt::format("{}", fmt::join(setting.choices, "|"));
    return names[static_cast<std::size_t>(setting.type)];
}

/// Help on a setting, with the range of a number and its unit.
std::string setting_help(const Setting& setting) {
    const std::string unit = setting.unit.empty() ? "" : " " + setting.unit;
    if (setting.type == SettingType::names)
        return fmt::format("{}, of {}; may be repeated", setting.help, fmt::join(setting.choices, ", "));
    if (setting.type == SettingType::number)
        return fmt::format("{} ({:g} to {:g}{})", setting.help, setting.min, setting.max, unit);
    if (setting.type == SettingType::choice || setting.type == SettingType::boolean) return setting.help;
    return fmt::format("{} ({:.0f} to {:.0f}{})", setting.help, setting.min, setting.max, unit);
}

constexpr const char* settings_group =
    "Settings (a scene file's \"settings\" have the same names, with _ in place of -)";
constexpr const char* hidden_group = "";  // of options that help leaves out

/// --KEY for a setting of the table; read_settings reads it.
void add_setting_option(CLI::App& app, const Setting& setting) {
    const std::string help = setting_help(setting);
    app.add_option(option_name(setting.key), help)
        ->type_name(value_name(setting))
        ->default_str(setting_text(setting.get(RenderSettings())))
        ->group(setting.rare ? hidden_group : settings_group);
}

void add_full_help(CLI::App& app) {
    app.add_flag_callback(
        "--help-all",
        [&app] {
            for (const Setting& setting : setting_table())
                app.get_option(option_name(setting.key))->group(settings_group);
            throw CLI::CallForHelp();
        },
        "print this help with the settings that are rarely changed, and exit");
}

/// "KEY=VALUE" of a list of names, with those that were given before.
std::string join_names(const Setting& setting, const std::string& names, const SettingMap& before) {
    const auto found = before.find(setting.key);
    const std::string* const known = found == before.end() ? nullptr : std::get_if<std::string>(&found->second);
    return setting.key + "=" + (known == nullptr ? names : *known + "," + names);
}

/// The settings of --KEY and --set in the order given, so that the last one counts; lists of names are joined.
/// @throws InputError (--set)
SettingMap read_settings(const CLI::App& app) {
    std::map<const CLI::Option*, std::size_t> seen;
    SettingMap settings;
    for (const CLI::Option* option : app.parse_order()) {
        const std::string name = option_label(*option);
        const auto setting =
            std::ranges::find(setting_table(), name, [](const Setting& s) { return option_name(s.key); });
        if (setting == setting_table().end() && name != "--set") continue;
        const std::string& value = option->results().at(seen[option]++);
        if (name == "--set") {
            parse_setting(value, settings);
        } else if (setting->type == SettingType::names) {
            parse_setting(join_names(*setting, value, settings), settings);
        } else {
            parse_setting(setting->key + "=" + value, settings);
        }
    }
    return settings;
}

constexpr int max_threads = 4096;

/// Notes the files of a scene for --watch, also where loading fails.
struct LoadedFiles {
    const ReadFiles read{};
    SceneWatch* const watch;
    ~LoadedFiles() {
        if (watch != nullptr) watch->note(read);
    }
};

}  // namespace

void warn_of_frames_outside(const std::vector<int>& frames, const FrameRange& range, const char* option) {
    for (const int frame : frames) {
        const std::optional<std::string> fault = describe_frame_outside(frame, range);
        if (!fault) continue;
        std::cerr << "aleph: warning: " << option << *fault << '\n';
        return;
    }
}

std::vector<std::int64_t> read_cuts(const std::string& text, const FrameRange& range, bool quiet) {
    if (text.empty()) return {};
    try {
        const std::vector<int> frames = parse_frame_list(text);
        if (!quiet) warn_of_frames_outside(frames, range, "--cuts: ");
        return {frames.begin(), frames.end()};
    } catch (const InputError& e) {
        throw InputError("", "--cuts", e.reason());
    }
}

void add_load_limits(CLI::App& app, LoadLimits& limits) {
    app.add_option_function<std::string>(
           "--load-memory",
           [&limits](const std::string& text) {
               const auto mebibytes = parse_value<std::uint32_t>(text, "--load-memory");
               if (mebibytes < 16) throw CLI::ValidationError("--load-memory", "expected at least 16 (MiB)");
               limits.memory = std::size_t{mebibytes} << 20;
           },
           "memory that loading a scene's text may take, at least 16; raise it for a large scene file")
        ->type_name("MIB")
        ->default_str(fmt::format("{}", limits.memory >> 20));
}

void add_scene_argument(CLI::App& app, std::string& scene) {
    add_text(app, "scene", "SCENE", scene, "scene file: " + list_endings(scene_formats(), FormatUse::load))->required();
}

void add_setting_options(CLI::App& app, SettingMap& settings) {
    for (const Setting& setting : setting_table()) add_setting_option(app, setting);
    add_full_help(app);
    app.add_option_function<std::vector<std::string>>(
           "--set", [](const std::vector<std::string>&) {},  // read_settings reads it
           "a setting by its key in scene files; also exposure, viewing.pixels_per_degree (pixels), "
           "viewing.display_white (cd/m2) and viewing.persistence (at most 1), numbers above 0, at most 1e18")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    app.parse_complete_callback([&app, &settings] { settings = read_settings(app); });
}

void add_shot_options(CLI::App& app, SceneOptions& options, const std::string& output_help) {
    add_scene_argument(app, options.scene);
    add_text(app, "--frames", "LIST", options.frames,
             "frames, such as 1-10,20-40x2 (x2: every second); default: the scene's range");
    add_text(app, "-o,--output", "PATTERN", options.output, output_help);
    add_text(app, "--camera", "NAME", options.camera, "name of a camera or of its node; default: the scene's choice");
    add_load_limits(app, options.limits);
    add_value(app, "-t,--threads", options.threads,
              "number of threads, 0 to 4096; 0: all processors, or those of a Slurm task (SLURM_CPUS_PER_TASK)");
    app.add_flag("-q,--quiet", options.quiet, "print no progress and no warnings");
    add_progress_form(app, options.progress);
}

void add_scene_options(CLI::App& app, SceneOptions& options) {
    add_shot_options(
        app, options,
        "output files: name.####.exr or .png (#### is the frame number), or a folder; missing folders are made; "
        "name.mp4, .mov, .webm or .gif: a film, made by the program ffmpeg; default: SCENE.####.exr, or "
        "SCENE-maps.####.exr, in the current folder");
    add_text(
        app, "--fps", "N", options.fps,
        "frames per second, such as 30 or 30000/1001; range, cuts and changes of camera keep their times; default: the "
        "scene's");
    add_text(
        app, "--crop", "X0,X1,Y0,Y1", options.crop,
        "only this window of the picture, in its pixels: columns X0 to X1-1 from the left, rows Y0 to Y1-1 from the "
        "top; EXR files keep its place (data window), PNG files and films have the window alone");
    add_text(app, "--stats", "FILE.json", options.stats,
             "write counts and times of every frame as JSON; while frames are made, the file has the finished ones");
    app.add_flag("--resume", options.resume,
                 "keep frames whose files are whole and have the fingerprint of this scene, these settings and this "
                 "program; several processes with the same command divide the frames");
    add_setting_options(app, options.settings);
}

void check_threads(int threads) {
    if (threads >= 0 && threads <= max_threads) return;
    throw InputError("", "--threads", fmt::format("{}: expected 0 (all processors) to {}", threads, max_threads));
}

int find_threads(int given) {
    const char* const slurm = std::getenv("SLURM_CPUS_PER_TASK");
    if (given > 0 || slurm == nullptr) return given;
    int cpus = 0;
    const std::string_view text(slurm);
    std::from_chars(text.data(), text.data() + text.size(), cpus);
    return std::clamp(cpus, 0, max_threads);
}

void check_as_options(const std::function<void()>& check) {
    try {
        check();
    } catch (const InputError& e) {
        throw InputError("", option_name(e.place()), e.reason());
    }
}

void apply_given(RenderSettings& settings, const SettingMap& given) {
    check_as_options([&] { apply_settings(settings, given, ""); });
}

RenderSettings join_settings(Scene& scene, SettingMap given, bool keeps_to_error) {
    RenderSettings settings;
    if (keeps_to_error) add_default_error(scene.source.settings, given);
    apply_settings(settings, scene.source.settings, scene.source.file);
    set_scene_numbers(scene, given, "--set");
    apply_given(settings, given);
    return settings;
}

PreparedScene prepare_scene(const SceneOptions& options) {
    check_threads(options.threads);
    PreparedScene prepared;
    {
        const ThreadLimit limit(find_threads(options.threads));
        const LoadedFiles files{.watch = options.watch};
        prepared.scene = load_scene(options.scene, options.limits);
        prepared.read = files.read.paths();
    }
    Scene& scene = prepared.scene;
    if (!options.fps.empty()) change_frame_rate(scene.film, parse_fps(options.fps));
    prepared.settings = join_settings(scene, options.settings, options.keeps_to_error);
    if (!options.crop.empty()) prepared.window = parse_crop(options.crop, prepared.settings.picture);
    if (!options.quiet) print_warnings(scene.source.warnings);
    const FrameRange range = frame_range(scene);
    if (options.frames.empty()) {
        if (range.last - range.first >= 10000000) {
            throw InputError(options.scene, "frames", "more than 10 million frames; choose some with --frames");
        }
        for (std::int64_t f = range.first; f <= range.last; ++f) prepared.frames.push_back(static_cast<int>(f));
    } else {
        prepared.frames = parse_frame_list(options.frames);
        if (!options.quiet) warn_of_frames_outside(prepared.frames, range);
    }
    prepared.name = name_scene(options.scene);
    return prepared;
}

}  // namespace aleph
