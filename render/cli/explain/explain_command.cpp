// `aleph explain`: describes a scene.

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "render/cli/commands.h"
#include "render/cli/explain/explain.h"
#include "render/cli/scene_options.h"
#include "render/settings/fingerprint.h"
#include "render/settings/frame_list.h"

namespace aleph {

namespace {

struct ExplainOptions {
    std::string scene, camera, frames;
    SettingMap settings;  ///< from options and --set
    double at = 0.0;
    bool json = false, moment = false, fingerprint = false;
    LoadLimits limits;
    std::uint32_t objects = 60;
};

Scene load_or_list_missing(const std::string& file, const LoadLimits& limits) {
    try {
        return load_scene(file, limits);
    } catch (const InputError&) {
        const std::vector<MissingFile> missing = list_missing_files(file, limits);
        for (const MissingFile& item : missing) {
            std::cerr << fmt::format("aleph: missing: {} {} names {}\n", printable(item.file, 300),
                                     printable(item.place), printable(item.path, 300));
        }
        throw;
    }
}

/// Names that are not UTF-8 are written with replacement characters.
void print_json(const nlohmann::ordered_json& object) {
    std::cout << object.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
}

int explain(const ExplainOptions& options) {
    Scene scene = load_or_list_missing(options.scene, options.limits);
    if (options.moment) {
        print_json(explain_moment(scene, options.at));
        return exit_done;
    }
    RenderSettings settings;
    apply_settings(settings, scene.source.settings, options.scene);
    SettingMap given = options.settings;
    if (options.fingerprint) add_default_error(scene.source.settings, given);
    set_scene_numbers(scene, given, "--set");
    apply_settings(settings, given, "");
    std::vector<int> frames = options.frames.empty() ? choose_planned_frames(scene) : parse_frame_list(options.frames);
    std::ranges::sort(frames);
    if (options.fingerprint) {
        std::cout << format_fingerprint(make_fingerprint(scene, settings, list_camera_shots(scene, options.camera)))
                  << "\n";
        return exit_done;
    }
    const nlohmann::ordered_json explained = explain_scene(scene, settings, options.camera, frames);
    if (options.json) {
        print_json(explained);
    } else {
        std::cout << explain_text(explained, options.objects);
    }
    return exit_done;
}

}  // namespace

void add_explain_command(CLI::App& app, Command& command) {
    CLI::App* explain_app = app.add_subcommand("explain", "describe a scene without rendering it");
    const auto options = std::make_shared<ExplainOptions>();
    add_text(*explain_app, "scene", "SCENE", options->scene,
             "scene file: " + list_endings(scene_formats(), FormatUse::load))
        ->required();
    explain_app->add_flag("--json", options->json, "print everything as JSON");
    explain_app->add_flag(
        "--fingerprint", options->fingerprint,
        "print what pictures of the scene depend on, as JSON: SHA-1 of the program and of the content of all files "
        "that it reads, and the settings that `aleph render` has with these options");
    CLI::Option* at =
        add_value(*explain_app, "--at", options->at,
                  "print world matrix, visibility, bounds and points of every object at this time (s) as JSON");
    add_value(*explain_app, "--objects", options->objects, "number of objects that the text lists; 0: all");
    add_text(*explain_app, "--camera", "NAME", options->camera,
             "name of a camera or of its node; default: the scene's choice");
    add_text(*explain_app, "--frames", "LIST", options->frames,
             "frames whose effects plan is made, such as 1-10,20-40x2; default: all of a short shot, else some of it");
    add_load_limits(*explain_app, options->limits);
    add_setting_options(*explain_app, options->settings);
    explain_app->footer(
        "The effects plan says which effects a frame is rendered with, why, and how much those that are left out can "
        "change: --force and --forbid override it, --plan off simulates everything. `aleph study --effects` measures "
        "what each costs and what a viewer would miss without it.\n"
        "If files that the scene names are missing, all of them are listed.\n"
        "Paths of more than 256 bytes are shortened in the middle, where the hash of the whole path tells them apart; "
        "the text indents 32 levels.\n\n"
        "Examples:\n"
        "  aleph explain scenes/pool/scene.json              objects, animation, counts, bounds, warnings\n"
        "  aleph explain scenes/pool/scene.json --frames 20 --error 1   the plan of a frame at an error\n"
        "  aleph explain shot.abc --json > shot.json         the same and more, for programs\n"
        "  aleph explain shot.abc --at 0.5                   all objects at 0.5 s");
    explain_app->callback([options, at, &command] {
        options->moment = at->count() > 0;
        command = [options] { return explain(*options); };
    });
}

}  // namespace aleph
