// The format of aleph's own scene files (.json): the pictures and files that they name, and saving.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <system_error>

#include "engine/base/atomic_file.h"
#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/parallel.h"
#include "engine/image/image_file.h"
#include "engine/load/format_rows.h"
#include "engine/pose/pose.h"
#include "engine/scene_file/scene_text.h"

namespace aleph {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t images_at_once = 16;  // whose encoded bytes are in memory

/// Materials have no values below 0: those, and what is not finite, count as 0.
/// @return texels that were changed
std::size_t clean_texels(Image<glm::vec4>& image) {
    std::size_t changed = 0;
    for (glm::vec4& texel : image.pixels) {
        const glm::vec4 before = texel;
        for (int c = 0; c < 4; ++c) {
            if (!std::isfinite(texel[c]) || texel[c] < 0.0f) texel[c] = 0.0f;
        }
        if (!(texel == before)) ++changed;
    }
    return changed;
}

/// OpenEXR's colours are multiplied by alpha, those of textures are not.
void divide_by_alpha(Image<glm::vec4>& image) {
    for (glm::vec4& texel : image.pixels) {
        if (texel.w > 0.0f && texel.w != 1.0f) texel = glm::vec4(glm::vec3(texel) / texel.w, texel.w);
    }
}

/// Rendering leaves out what is no light. Most infinite texels are lamps and suns beyond the range of half precision.
void warn_of_infinite_light(const SceneImage& image, std::vector<std::string>& warnings) {
    const auto infinite = std::ranges::count_if(image.floats.pixels, [](const glm::vec4& texel) {
        return std::isinf(texel.x) || std::isinf(texel.y) || std::isinf(texel.z);
    });
    if (infinite == 0) return;
    warnings.push_back(
        fmt::format("{}: {} texels of {} are infinite there, and count as 0: its brightest light is missing",
                    image.path, infinite, image.floats.size()));
}

/// @param warnings  what of the picture does not count
void load_image(SceneImage& image, const Bytes& encoded, bool is_environment, std::vector<std::string>& warnings) {
    DecodedTexture decoded = decode_texture(encoded, image.path);
    image.bytes = std::move(decoded.bytes);
    image.floats = std::move(decoded.floats);
    if (is_environment) return warn_of_infinite_light(image, warnings);
    divide_by_alpha(image.floats);
    if (const std::size_t changed = clean_texels(image.floats); changed > 0) {
        warnings.push_back(fmt::format("{}: {} texels of {} are below 0, NaN or infinite there, and count as 0",
                                       image.path, changed, image.floats.size()));
    }
}

/// Images [begin, end): read one by one, and decoded in parallel.
void load_images(SceneText& text, const LoadRequest& request, std::size_t begin, std::size_t end) {
    std::vector<SceneImage>& images = text.scene.images;
    std::vector<Bytes> encoded(end - begin);
    std::vector<std::vector<std::string>> warnings(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
        const fs::path path = request.path.parent_path() / images[i].path;
        check_regular_file(path, request.file, text.image_places[i]);
        encoded[i - begin] = read_regular_file(path, request.file, text.image_places[i]);
    }
    parallel_in_order(end - begin, [&](std::size_t i) {
        const bool is_environment = static_cast<int>(begin + i) == text.scene.environment.image;
        try {
            load_image(images[begin + i], encoded[i], is_environment, warnings[i]);
        } catch (const InputError& error) {
            throw InputError(request.file, text.image_places[begin + i],
                             fmt::format("{}: {}", error.file(), error.reason()));
        }
    });
    for (auto& own : warnings) std::ranges::move(own, std::back_inserter(text.scene.source.warnings));
}

bool is_texture(const Scene& scene, int image) {
    return std::ranges::any_of(scene.materials, [&](const Material& material) {
        return std::ranges::any_of(material.textures.all,
                                   [&](const TextureRef& texture) { return texture.image == image; });
    });
}

std::string unused_name(const Scene& scene, const std::string& name) {
    const auto is_used = [&](const std::string& candidate) {
        return std::ranges::any_of(scene.images, [&](const SceneImage& image) { return image.name == candidate; });
    };
    std::string candidate = name;
    for (int i = 2; is_used(candidate); ++i) candidate = fmt::format("{} {}", name, i);
    return candidate;
}

Image<glm::vec4> to_linear(const Image<glm::u8vec4>& bytes) {
    std::array<float, 256> linear;
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    Image<glm::vec4> floats(bytes.width, bytes.height);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const glm::u8vec4& c = bytes.pixels[i];
        floats.pixels[i] = {linear[c.x], linear[c.y], linear[c.z], static_cast<float>(c.w) / 255.0f};
    }
    return floats;
}

/// Turns the pixels of the environment's picture into linear floats where they are 8-bit sRGB. A picture that is a
/// texture too stays as it is: the environment gets a copy, under a name of its own and with the same path.
/// Called before includes are appended, as the scene's own images come first.
void make_environment_linear(Scene& scene) {
    if (scene.environment.image == no_index) return;
    const SceneImage& picture = scene.images[scene.environment.image];
    if (picture.bytes.empty()) return;
    if (is_texture(scene, scene.environment.image)) {
        SceneImage copy = picture;
        copy.name = unused_name(scene, copy.name);
        scene.environment.image = append(scene.images, std::move(copy));
    }
    SceneImage& own = scene.images[scene.environment.image];
    own.floats = to_linear(own.bytes);
    own.bytes = {};
}

void check_cameras(const Scene& scene, const std::string& file) {
    const CameraNames cameras(scene);
    const auto check = [&](const std::string& name, const std::string& place) {
        try {
            cameras.find(name);
        } catch (const InputError& error) {
            throw InputError(file, place, error.reason());
        }
    };
    if (!scene.film.camera.empty()) check(scene.film.camera, "/camera");
    for (std::size_t i = 0; i < scene.film.camera_keys.size(); ++i)
        check(scene.film.camera_keys[i].camera, fmt::format("/camera/keys/{}", i));
}

SceneText read_text_of(const LoadRequest& request) {
    const Bytes bytes = read_regular_file(request.path, request.file, "");
    return read_scene_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, request.file, request.limits);
}

/// Opens the files that the text names.
Scene load_files_of(SceneText text, const LoadRequest& request) {
    const std::string& file = request.file;
    Scene& scene = text.scene;
    scene.source.file = request.path.string();
    const fs::path folder = request.path.parent_path();
    for (std::size_t i = 0; i < scene.source.includes.size(); ++i) {
        const std::string &path = scene.source.includes[i].path, &place = text.include_places[i];
        require_format(request.formats, FormatUse::include, path, file, place);
        check_regular_file(folder / path, file, place);
    }
    for (std::size_t i = 0; i < scene.images.size(); i += images_at_once)
        load_images(text, request, i, std::min(i + images_at_once, scene.images.size()));
    make_environment_linear(scene);
    load_includes(scene, text.include_places, request);
    check_cameras(scene, file);
    return std::move(scene);
}

Scene load_scene_file(const LoadRequest& request) {
    const std::string& file = request.file;
    if (std::error_code error; fs::file_size(request.path, error) > request.limits.text()) {
        throw InputError(file, "",
                         fmt::format("the file is larger than {} MiB; keep large meshes in a .glb or .abc file and "
                                     "include that",
                                     request.limits.text() >> 20));
    }
    return load_files_of(read_text_of(request), request);
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

std::vector<std::string> save_scene_file(const Scene& scene, const fs::path& path) {
    const std::string file = path.string();
    Scene own = without_includes(scene, file);
    if (!scene.source.file.empty()) {  // paths are relative to the file they stand in
        const fs::path from = folder_of(scene.source.file), to = folder_of(path);
        if (from != to) {
            for (Include& include : own.source.includes) include.path = move_path(include.path, from, to);
            for (SceneImage& image : own.images) image.path = move_path(image.path, from, to);
        }
    }
    write_file(path, write_scene_text(own, file));
    return {};
}

bool is_there(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// The pictures and includes that are not there, and what included files miss.
void list_missing_of_scene_file(const LoadRequest& request, std::vector<MissingFile>& missing) {
    std::error_code error;
    if (fs::file_size(request.path, error) > request.limits.text()) return;  // also where the size is not known
    const SceneText text = read_text_of(request);
    const fs::path folder = request.path.parent_path();
    for (std::size_t i = 0; i < text.scene.images.size(); ++i) {
        if (!is_there(folder / text.scene.images[i].path))
            missing.push_back({request.file, text.image_places[i], text.scene.images[i].path});
    }
    std::set<fs::path> seen;  // a thousand includes of one large file cost one
    for (std::size_t i = 0; i < text.scene.source.includes.size(); ++i) {
        const fs::path include = folder / text.scene.source.includes[i].path;
        if (!is_there(include)) {
            missing.push_back({request.file, text.include_places[i], text.scene.source.includes[i].path});
            continue;
        }
        const SceneFormat* format = find_format(request.formats, include);
        if (format == nullptr || format->append == nullptr || format->list_missing == nullptr) continue;
        if (!seen.insert(fs::weakly_canonical(include, error)).second) continue;
        try {
            format->list_missing({include, include.string(), request.limits, request.formats}, missing);
        } catch (const InputError&) {  // the other includes may miss files too
        }
    }
}

}  // namespace

Scene load_scene_file_text(std::string_view text, const LoadRequest& request) {
    return load_files_of(read_scene_text(text, request.file, request.limits), request);
}

SceneFormat scene_file_format() {
    SceneFormat format;
    format.endings = {".json"};
    format.description = "a scene file";
    format.load = load_scene_file;
    format.save = save_scene_file;
    format.list_missing = list_missing_of_scene_file;
    return format;
}

}  // namespace aleph
