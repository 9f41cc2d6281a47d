#include "engine/gltf/source.h"

#include <fmt/format.h>

#include <exception>
#include <set>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/gltf/validate/validate.h"
#include "engine/json/text.h"

namespace aleph {

namespace fs = std::filesystem;

namespace {

/// The bytes of a data URI, or of the file that a relative one names.
Bytes read_uri(const GltfSource& source, const std::string& uri, const std::string& place) {
    if (is_data_uri(uri)) return decode_data_uri(uri, source.file, place);
    return read_regular_file(resolve_file_uri(uri, source.folder, source.file, place), source.file, place);
}

Bytes load_buffer(const GltfSource& source, std::size_t i, const GltfChunks& chunks, std::uint64_t bytes_left) {
    const nlohmann::json& buffer = source.document["buffers"][i];
    const std::string place = fmt::format("/buffers/{}", i);
    const auto length = buffer["byteLength"].get<std::size_t>();
    if (!buffer.contains("uri")) {
        if (chunks.binary.size() < length) {
            throw InputError(source.file, place,
                             fmt::format("byteLength is {}, the BIN chunk has {} bytes", length, chunks.binary.size()));
        }
        return {chunks.binary.begin(), chunks.binary.begin() + static_cast<std::ptrdiff_t>(length)};
    }
    // Several buffers may name one large file.
    if (length > bytes_left) {
        throw InputError(source.file, place, fmt::format("all buffers together exceed {} bytes", max_file_bytes));
    }
    Bytes bytes = read_uri(source, buffer["uri"].get_ref<const std::string&>(), place + "/uri");
    if (bytes.size() < length) {
        throw InputError(source.file, place,
                         fmt::format("byteLength is {}, the data has {} bytes", length, bytes.size()));
    }
    bytes.resize(length);
    return bytes;
}

bool is_image_type(std::string_view type) {
    return type == "image/png" || type == "image/jpeg";
}

/// Checks that the image of a texture is there, also where no material uses it: whether a file loads does not depend on
/// materials. Images that extensions alone name are not read.
void locate_image(const GltfSource& source, std::size_t i) {
    const nlohmann::json& image = source.document["images"][i];
    if (!image.contains("uri")) return;
    const std::string place = fmt::format("/images/{}/uri", i);
    const std::string& uri = image["uri"].get_ref<const std::string&>();
    if (is_data_uri(uri)) {
        const std::string type = uri.substr(5, uri.find_first_of(";,") - 5);
        if (!is_image_type(type)) {
            throw InputError(source.file, place,
                             fmt::format("\"{}\" is not supported, only image/png and image/jpeg", printable(type)));
        }
        return;
    }
    const fs::path path = resolve_file_uri(uri, source.folder, source.file, place);
    note_read_file(path);
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        throw InputError(source.file, place, fmt::format("no such file: {}", printable(path.filename().string())));
    }
}

/// The document without what tinygltf would open or decode, and without what it refuses though it is valid: sparse
/// values, indices without a buffer view, channels without a node. Those are read from the document itself.
nlohmann::json make_parser_input(const GltfSource& source) {
    nlohmann::json input = nlohmann::json::object();
    for (const auto& [key, value] : source.document.items()) {
        if (key != "buffers" && key != "images" && key != "skins" && key != "extras") input[key] = value;
    }
    if (input.contains("accessors")) {
        for (nlohmann::json& accessor : input["accessors"]) accessor.erase("sparse");
    }
    if (input.contains("animations")) {
        for (nlohmann::json& animation : input["animations"]) animation["channels"] = nlohmann::json::array();
    }
    if (input.contains("meshes")) {
        for (nlohmann::json& mesh : input["meshes"]) {
            for (nlohmann::json& primitive : mesh["primitives"]) primitive.erase("indices");
        }
    }
    return input;
}

void parse_model(GltfSource& source) {
    const std::string text = make_parser_input(source).dump();
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({});  // there is no file to open
    parser.RemoveImageLoader();
    std::string error, warning;
    bool parsed = false;
    try {
        parsed = parser.LoadASCIIFromString(&source.model, &error, &warning, text.data(),
                                            static_cast<unsigned int>(text.size()), "");
    } catch (const std::exception& exception) {
        error += exception.what();
    }
    // tinygltf may return true with an error text: it has left an element out.
    if (!parsed || !error.empty()) throw InputError(source.file, "", "not valid glTF: " + printable(error, 300));
}

}  // namespace

std::size_t GltfSource::count(const char* list) const {
    const auto found = document.find(list);
    return found == document.end() ? 0 : found->size();
}

const nlohmann::json* find_extension(const nlohmann::json& element, const char* name) {
    const auto extensions = element.find("extensions");
    if (extensions == element.end()) return nullptr;
    const auto extension = extensions->find(name);
    return extension == extensions->end() ? nullptr : &*extension;
}

GltfSource load_gltf_source(const fs::path& path, const LoadLimits& limits) {
    GltfSource source;
    source.file = path.string();
    source.folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const Bytes bytes = read_regular_file(path, source.file, "");
    const GltfChunks chunks = split_gltf(bytes, source.file);
    source.document =
        parse_strict_json(chunks.json, source.file, limits, "keep vertices, keys and indices in the binary buffer");
    validate_gltf(JsonRef(source.document, source.file), chunks.has_binary, source.warnings);

    std::uint64_t bytes_left = max_file_bytes;
    for (std::size_t i = 0; i < source.count("buffers"); ++i) {
        source.buffers.push_back(load_buffer(source, i, chunks, bytes_left));
        bytes_left -= source.buffers.back().size();
    }
    std::set<std::size_t> images;
    for (std::size_t i = 0; i < source.count("textures"); ++i)
        images.insert(source.document["textures"][i]["source"].get<std::size_t>());
    for (const std::size_t image : images) locate_image(source, image);
    parse_model(source);
    return source;
}

Bytes load_encoded_image(const GltfSource& source, std::size_t i, std::string& path) {
    const nlohmann::json& image = source.document["images"][i];
    const std::string place = fmt::format("/images/{}", i);
    Bytes b;
    if (image.contains("bufferView")) {
        const tinygltf::BufferView& view = source.model.bufferViews[image["bufferView"].get<std::size_t>()];
        const auto begin = source.buffers[view.buffer].begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
        b.assign(begin, begin + static_cast<std::ptrdiff_t>(view.byteLength));
    } else {
        const auto& uri = image["uri"].get_ref<const std::string&>();
        if (!is_data_uri(uri)) path = percent_decode(uri, source.file, place + "/uri");
        b = read_uri(source, uri, place + "/uri");
    }
    const bool is_png = b.size() > 8 && b[0] == 0x89 && b[1] == 'P' && b[2] == 'N' && b[3] == 'G';
    const bool is_jpeg = b.size() > 3 && b[0] == 0xff && b[1] == 0xd8 && b[2] == 0xff;
    if (!is_png && !is_jpeg) throw InputError(source.file, place, "the data is neither PNG nor JPEG");
    return b;
}

}  // namespace aleph
