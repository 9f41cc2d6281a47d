#include "engine/load/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "engine/alembic/alembic.h"
#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/gltf/gltf.h"
#include "engine/image/image_file.h"
#include "engine/json/json_ref.h"
#include "engine/json/text.h"
#include "engine/load/camera_check.h"
#include "engine/load/environment_picture.h"
#include "engine/load/flat_warnings.h"
#include "engine/load/framing_camera.h"
#include "engine/load/load_includes.h"
#include "engine/load/mesh_warnings.h"
#include "engine/load/unlikely_values.h"
#include "engine/load/warnings.h"
#include "engine/pose/pose.h"
#include "engine/scene_file/scene_text.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

/// @param accepted  the kinds of file that are allowed there, for the message
void check_asset_name(const fs::path& path, const std::string& file, const std::string& place, const char* accepted) {
    const std::string extension = lower_extension(path);
    if (extension == ".gltf" || extension == ".glb" || extension == ".abc") return;
    throw InputError(file, place,
                     fmt::format("files of the kind \"{}\" are not read; expected {}", printable(extension), accepted));
}

void check_regular_file(const fs::path& path, const std::string& file, const std::string& place) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status))
        throw InputError(file, place, fmt::format("there is no file {}", printable(path.string(), 300)));
    if (!fs::is_regular_file(status)) {
        throw InputError(file, place, fmt::format("{} is not a regular file", printable(path.string(), 300)));
    }
}

void load_images(SceneText& text, const fs::path& folder, const std::string& file) {
    for (std::size_t i = 0; i < text.scene.images.size(); ++i) {
        SceneImage& image = text.scene.images[i];
        const std::string& place = text.image_places[i];
        check_regular_file(folder / image.path, file, place);
        try {
            const DecodedTexture decoded =
                decode_texture(read_regular_file(folder / image.path, file, place), image.path);
            image.bytes = Image<glm::u8vec4>(decoded.bytes.width, decoded.bytes.height);
            for (std::size_t p = 0; p < image.bytes.size(); ++p) {
                const auto& c = decoded.bytes.pixels[p];
                image.bytes.pixels[p] = {c[0], c[1], c[2], c[3]};
            }
            image.floats = Image<glm::vec4>(decoded.floats.width, decoded.floats.height);
            for (std::size_t p = 0; p < image.floats.size(); ++p) {
                const auto& c = decoded.floats.pixels[p];
                image.floats.pixels[p] = {c[0], c[1], c[2], c[3]};
            }
        } catch (const InputError& error) {
            if (error.file() == file) throw;
            throw InputError(file, place, fmt::format("{}: {}", error.file(), error.reason()));
        }
    }
}

AlembicTiming append_asset(const fs::path& path, Scene& scene, int parent_node, int include, const LoadLimits& limits) {
    if (lower_extension(path) == ".abc") return append_alembic(path, scene, parent_node, include);
    append_gltf(path, scene, parent_node, include, limits);
    return {};
}

Scene load_scene_file(const fs::path& path, const std::string& file, const LoadLimits& limits) {
    check_regular_file(path, file, "");
    if (std::error_code error; fs::file_size(path, error) > limits.text()) {
        throw InputError(file, "",
                         fmt::format("the file is larger than {} MiB; keep large meshes in a .glb or .abc file and "
                                     "include that",
                                     limits.text() >> 20));
    }
    const Bytes bytes = read_regular_file(path, file, "");
    SceneText text = read_scene_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, limits);
    Scene& scene = text.scene;
    scene.file = file;
    const fs::path folder = path.parent_path();
    for (std::size_t i = 0; i < scene.includes.size(); ++i) {
        check_asset_name(scene.includes[i].path, file, text.include_places[i], "a .gltf, .glb or .abc file");
        check_regular_file(folder / scene.includes[i].path, file, text.include_places[i]);
    }
    load_images(text, folder, file);
    make_environment_linear(scene);
    load_includes(scene, folder, text.include_places, limits);
    if (!scene.camera.empty()) {
        try {
            find_camera(scene, scene.camera);
        } catch (const InputError& error) {
            throw InputError(file, "/camera", error.reason());
        }
    }
    for (std::size_t i = 0; i < scene.camera_keys.size(); ++i) {
        try {
            find_camera(scene, scene.camera_keys[i].camera);
        } catch (const InputError& error) {
            throw InputError(file, fmt::format("/camera/keys/{}", i), error.reason());
        }
    }
    return std::move(scene);
}

/// Frame rate and range of an Alembic archive. The range includes samples at both ends that do not change.
void set_timing(const AlembicTiming& timing, Scene& scene) {
    if (timing.frame_rate) scene.frame_rate = *timing.frame_rate;
    if (!timing.first) return;
    Scene ends;  // a scene with two keys: frame_range turns their times into frames
    ends.frame_rate = scene.frame_rate;
    ends.nodes.emplace_back().visible.values = {1.0, 0.0};
    ends.nodes.back().visible.sampling.kind = TimeSampling::Kind::acyclic;
    ends.nodes.back().visible.sampling.times = {*timing.first, *timing.last};
    scene.range = frame_range(ends);
}

Scene load_asset_file(const fs::path& path, const std::string& file, const LoadLimits& limits) {
    check_asset_name(path, file, "", "a .json, .gltf, .glb or .abc file");
    check_regular_file(path, file, "");
    Scene scene;
    scene.file = file;
    scene.name = path.stem().string();
    scene.includes.emplace_back().path = path.filename().string();
    set_timing(append_asset(path, scene, no_index, 0, limits), scene);
    const bool has_camera =
        std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const Node& node) { return node.camera != no_index; });
    if (!has_camera) add_framing_camera(scene);
    return scene;
}

/// A path relative to the folder `from`, made relative to `to`.
std::string move_path(const std::string& path, const fs::path& from, const fs::path& to) {
    return path.empty() ? path : (from / path).lexically_relative(to).generic_string();
}

fs::path folder_of(const fs::path& file) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(file).parent_path(), error);
    return error ? fs::absolute(file).parent_path() : folder;
}

}  // namespace

Scene load_scene(const std::filesystem::path& path, const LoadLimits& limits) {
    const std::string file = path.string();
    Scene scene =
        lower_extension(path) == ".json" ? load_scene_file(path, file, limits) : load_asset_file(path, file, limits);
    check_camera_axes(scene);
    add_rotation_warnings(scene);
    add_mesh_warnings(scene);
    add_flat_warnings(scene);
    add_radian_warnings(scene);
    add_cut_warnings(scene);
    add_missing_light(scene);
    return scene;
}

void save_scene(const Scene& scene, const std::filesystem::path& path) {
    const std::string file = path.string();
    if (lower_extension(path) != ".json") {
        throw InputError(file, "", "the name of a scene file must end in .json: load_scene tells files apart by it");
    }
    Scene own = without_includes(scene, file);
    if (!scene.file.empty()) {  // paths are relative to the file they stand in
        const fs::path from = folder_of(scene.file), to = folder_of(path);
        if (from != to) {
            for (Include& include : own.includes) include.path = move_path(include.path, from, to);
            for (SceneImage& image : own.images) image.path = move_path(image.path, from, to);
        }
    }
    write_file(path, write_scene_text(own, file));
}

}  // namespace aleph
