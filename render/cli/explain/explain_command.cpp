// `aleph explain`: describes a scene.

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "engine/scene/points.h"
#include "render/cli/commands.h"
#include "render/cli/explain/explain.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/options.h"
#include "render/settings/fingerprint.h"
#include "render/settings/frame_list.h"

namespace aleph {

using nlohmann::ordered_json;

namespace {

struct ExplainOptions {
    std::string scene, camera, frames;
    SettingMap settings;  ///< from options and --set
    double at = 0.0;
    bool json = false, moment = false, fingerprint = false;
    LoadLimits limits;
    std::uint32_t objects = 60;
};

constexpr std::size_t shown_points = 6;

ordered_json to_rows(const glm::dmat4& m) {
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) rows.push_back(m[column][row]);
    return rows;
}

/// The points as the file has them: those of the point cache or cage if the mesh has one, else the vertices.
std::vector<glm::dvec3> source_points(const Scene& scene, const ScenePose& posed_scene, int mesh_index) {
    const Mesh& mesh = scene.meshes[mesh_index];
    const int cache = point_cache_of(scene, mesh);
    if (cache != no_index) return sample_points(scene.point_caches[cache], posed_scene.seconds);
    const PosedMesh& posed = posed_scene.meshes[mesh_index];
    if (!posed.positions.empty()) return posed.positions;
    return {mesh.positions.begin(), mesh.positions.end()};
}

/// The points of a node's meshes. Points that several meshes share count once.
ordered_json describe_points(const Scene& scene, const ScenePose& posed_scene, const Node& node) {
    std::size_t count = 0;
    ordered_json first = ordered_json::array();
    std::map<std::pair<int, int>, bool> counted;
    for (const int index : node.meshes) {
        const Mesh& mesh = scene.meshes[index];
        if (mesh.present.key_count() > 1 && evaluate(mesh.present, posed_scene.seconds) == 0.0) continue;
        const bool own = mesh.subdivision.cage == no_index && mesh.deformation.points == no_index;
        if (!own && !counted.emplace(std::pair(mesh.subdivision.cage, mesh.deformation.points), true).second) continue;
        const std::vector<glm::dvec3> points = source_points(scene, posed_scene, index);
        for (std::size_t i = 0; i < points.size() && first.size() < shown_points; ++i)
            first.push_back(to_json(points[i]));
        count += points.size();
    }
    return {{"count", count}, {"first", std::move(first)}};
}

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

ordered_json describe_settings(const std::vector<SettingOrigin>& settings) {
    ordered_json list = ordered_json::array();
    for (const SettingOrigin& setting : settings)
        list.push_back({{"key", setting.key}, {"value", setting_json(setting.value)}, {"from", setting.from}});
    return list;
}

/// Names that are not UTF-8 are written with replacement characters.
void print_json(const ordered_json& object) {
    std::cout << object.dump(1, ' ', false, ordered_json::error_handler_t::replace) << "\n";
}

int explain(const ExplainOptions& options) {
    Scene scene = load_or_list_missing(options.scene, options.limits);
    if (options.moment) {
        print_json(explain_moment(scene, options.at));
        return exit_done;
    }
    const RenderSettings settings = join_settings(scene, options.settings, true);
    std::vector<int> frames = options.frames.empty() ? choose_planned_frames(scene) : parse_frame_list(options.frames);
    std::ranges::sort(frames);
    warn_of_frames_outside(frames, frame_range(scene));
    if (options.fingerprint) {
        std::cout << format_fingerprint(make_fingerprint(scene, settings, list_camera_shots(scene, options.camera)))
                  << "\n";
        return exit_done;
    }
    ordered_json explained = explain_scene(scene, settings, options.camera, frames);
    explained["settings"] = describe_settings(list_origins(scene.source.settings, options.settings));
    if (options.json) {
        print_json(explained);
    } else {
        std::cout << explain_text(explained, options.objects);
    }
    return exit_done;
}

}  // namespace

ordered_json explain_moment(const Scene& scene, double seconds) {
    const ScenePose posed_scene = pose(scene, seconds);
    const NodePaths paths(scene);
    std::vector<Bounds> bounds(scene.nodes.size());
    for (const Instance& instance : posed_scene.instances)
        add_instance(bounds[instance.node], scene, posed_scene, instance);
    ordered_json objects = ordered_json::array();
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        ordered_json object = {
            {"path", paths[i]}, {"world", to_rows(posed_scene.world[i])}, {"visible", posed_scene.visible[i] != 0}};
        object["bounds"] = to_json(bounds[i]);
        if (!scene.nodes[i].meshes.empty()) object["points"] = describe_points(scene, posed_scene, scene.nodes[i]);
        objects.push_back(std::move(object));
    }
    return {{"seconds", seconds}, {"objects", std::move(objects)}};
}

void add_explain_command(CLI::App& app, Command& command) {
    CLI::App* explain_app = app.add_subcommand("explain", "describe a scene without rendering it");
    const auto options = std::make_shared<ExplainOptions>();
    add_scene_argument(*explain_app, options->scene);
    explain_app->add_flag("--json", options->json, "print everything as JSON");
    CLI::Option* const fingerprint = explain_app->add_flag(
        "--fingerprint", options->fingerprint,
        "print what pictures of the scene depend on, as JSON: SHA-1 of the program and of the content of all files "
        "that it reads, and the settings that `aleph render` has with these options");
    CLI::Option* at =
        add_value(*explain_app, "--at", options->at,
                  "print world matrix, visibility, bounds and points of every object at this time (s) as JSON");
    at->excludes(fingerprint);
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
        "The settings are those of `aleph render` with the same options. The text has the error that is asked for, and "
        "what an option (option), the scene file (scene) or that error (error) sets; the JSON has all of them.\n"
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
