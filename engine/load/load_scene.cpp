#include "engine/load/load_scene.h"

#include <algorithm>

#include "engine/load/format_rows.h"
#include "engine/load/warnings.h"
#include "engine/pose/pose.h"

namespace aleph {

namespace {

/// Frame rate and range as the file states them. The range includes samples at both ends that do not change.
void set_timing(const FileTiming& timing, Scene& scene) {
    if (timing.frame_rate) scene.film.frame_rate = *timing.frame_rate;
    if (!timing.first) return;
    Scene ends;  // a scene with two keys: frame_range turns their times into frames
    ends.film.frame_rate = scene.film.frame_rate;
    ends.nodes.emplace_back().visible = Track<double>({*timing.first, *timing.last}, {1.0, 0.0});
    scene.film.range = frame_range(ends);
}

Scene load_alone(const SceneFormat& format, const LoadRequest& request) {
    Scene scene;
    scene.source.file = request.file;
    scene.source.name = request.path.stem().string();
    scene.source.includes.emplace_back().path = request.path.filename().string();
    set_timing(format.append({request.path, no_index, 0, request.limits}, scene), scene);
    const bool has_camera =
        std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const Node& node) { return node.camera != no_index; });
    if (!has_camera) add_framing_camera(scene);
    return scene;
}

/// Checks scales, adds the warnings, and a light where there is none.
void complete(Scene& scene) {
    add_rotation_warnings(scene);
    add_mesh_warnings(scene);
    check_scales(scene);
    add_radian_warnings(scene);
    add_key_warnings(scene);
    add_cut_warnings(scene);
    add_missing_light(scene);
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const LoadLimits& limits, const SceneFormats& formats) {
    const LoadRequest request{path, path.string(), limits, formats};
    const SceneFormat& format = require_format(formats, FormatUse::load, path, request.file, "");
    check_regular_file(path, request.file, "");
    Scene scene = format.load != nullptr ? format.load(request) : load_alone(format, request);
    complete(scene);
    return scene;
}

Scene load_scene_text(std::string_view text, const std::filesystem::path& folder, const LoadLimits& limits) {
    Scene scene = load_scene_file_text(text, {folder / "", "", limits, scene_formats()});
    complete(scene);
    return scene;
}

std::vector<std::string> save_scene(const Scene& scene, const std::filesystem::path& path,
                                    const SceneFormats& formats) {
    return require_format(formats, FormatUse::save, path, path.string(), "").save(scene, path);
}

}  // namespace aleph
