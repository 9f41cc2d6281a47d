// Validator: buffers, views, images, samplers, textures.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/gltf/validate/parts.h"

namespace aleph {

namespace {

void check_views(const GltfCheck& check) {
    const std::optional<JsonRef> buffers = check.root.find("buffers");
    for_each_object(check.root, "bufferViews", [&](const JsonRef& view, std::size_t) {
        view.find_string("name");
        const JsonRef buffer = view.require("buffer");
        const JsonRef owner = (*buffers)[buffer.index(check.count("buffers"), "buffer")];
        const std::int64_t buffer_length = owner.require("byteLength").integer(1, max_gltf_count);
        const std::int64_t offset = view.find_integer("byteOffset", 0, max_gltf_count).value_or(0);
        const std::int64_t length = view.require("byteLength").integer(1, max_gltf_count);
        if (offset > buffer_length || length > buffer_length - offset) {
            view.fail(
                fmt::format("bytes {} to {} lie outside the buffer's {}", offset, offset + length, buffer_length));
        }
        if (const auto stride = view.find_integer("byteStride", 4, 252); stride && *stride % 4 != 0) {
            view.fail(fmt::format("byteStride {} is no multiple of 4", *stride));
        }
        view.find_integer("target", 0, max_gltf_count);
    });
}

void check_allowed(const JsonRef& element, std::string_view key, std::initializer_list<std::int64_t> allowed) {
    const std::optional<JsonRef> member = element.find(key);
    if (!member) return;
    const std::int64_t value = member->integer(0, max_gltf_count);
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
        member->fail(fmt::format("{} is not an allowed value", value));
    }
}

}  // namespace

void check_buffers(GltfCheck& check) {
    for_each_object(check.root, "buffers", [&](const JsonRef& buffer, std::size_t i) {
        buffer.find_string("name");
        buffer.require("byteLength").integer(1, max_gltf_count);
        if (!buffer.find_string("uri") && !(i == 0 && check.has_binary_chunk)) {
            buffer.fail("\"uri\" is missing, and there is no BIN chunk for it");
        }
    });
    check_views(check);
}

void check_images(GltfCheck& check) {
    std::vector<bool> used(check.count("images"));  // others belong to extensions that may be ignored
    for_each_object(check.root, "textures", [&](const JsonRef& texture, std::size_t) {
        texture.find_index("sampler", check.count("samplers"), "sampler");
        const std::optional<std::size_t> source = texture.find_index("source", check.count("images"), "image");
        if (!source) texture.fail("\"source\" is missing: images from extensions are not supported");
        used[*source] = true;
    });
    for_each_object(check.root, "images", [&](const JsonRef& image, std::size_t i) {
        image.find_string("name");
        const bool has_uri = image.find_string("uri").has_value();
        const bool has_view = image.find_index("bufferView", check.count("bufferViews"), "buffer view").has_value();
        if (has_uri == has_view) image.fail("needs either \"uri\" or \"bufferView\"");
        const std::optional<JsonRef> mime = image.find("mimeType");
        if (has_view && !mime) image.fail("\"mimeType\" is missing");
        if (mime && used[i] && mime->string() != "image/png" && mime->string() != "image/jpeg") {
            mime->fail(
                fmt::format("\"{}\" is not supported, only image/png and image/jpeg", printable(mime->string())));
        }
    });
    for_each_object(check.root, "samplers", [&](const JsonRef& sampler, std::size_t) {
        check_allowed(sampler, "magFilter", {9728, 9729});
        check_allowed(sampler, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
        check_allowed(sampler, "wrapS", {33071, 33648, 10497});
        check_allowed(sampler, "wrapT", {33071, 33648, 10497});
    });
}

}  // namespace aleph
