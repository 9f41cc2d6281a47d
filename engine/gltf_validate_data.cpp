// Validator: buffers, views, accessors, images, samplers, textures.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/errors.h"
#include "engine/gltf_files.h"
#include "engine/gltf_validate_parts.h"

namespace aleph {

namespace {

constexpr std::int64_t max_count = 0x7fffffff;  // sizes below fit 64 bits by far: 2^31 elements of at most 64 bytes

struct ElementType {
    std::string_view name;
    std::int64_t columns;
    std::int64_t rows;
};

constexpr std::array<ElementType, 7> element_types = {
    {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4}, {"MAT2", 2, 2}, {"MAT3", 3, 3}, {"MAT4", 4, 4}}};

/// Bytes of one element; a matrix column starts at a multiple of 4 bytes.
std::int64_t element_bytes(const ElementType& type, std::int64_t component) {
    const std::int64_t column = type.rows * component;
    return type.columns == 1 ? column : type.columns * ((column + 3) / 4 * 4);
}

void check_views(const GltfCheck& check) {
    const std::optional<JsonRef> buffers = check.root.find("buffers");
    for_each_object(check.root, "bufferViews", [&](const JsonRef& view, std::size_t) {
        view.find_string("name");
        const JsonRef buffer = view.require("buffer");
        const JsonRef owner = (*buffers)[buffer.index(buffers ? buffers->array_size() : 0, "buffer")];
        const std::int64_t buffer_length = owner.require("byteLength").integer(1, max_count);
        const std::int64_t offset = view.find_integer("byteOffset", 0, max_count).value_or(0);
        const std::int64_t length = view.require("byteLength").integer(1, max_count);
        if (offset > buffer_length || length > buffer_length - offset) {
            view.fail(
                fmt::format("bytes {} to {} lie outside the buffer's {}", offset, offset + length, buffer_length));
        }
        if (const auto stride = view.find_integer("byteStride", 4, 252); stride && *stride % 4 != 0) {
            view.fail(fmt::format("byteStride {} is no multiple of 4", *stride));
        }
        view.find_integer("target", 0, max_count);
    });
}

void check_accessor(GltfCheck& check, const JsonRef& accessor) {
    accessor.find_string("name");
    if (const std::optional<JsonRef> sparse = accessor.find("sparse"))
        sparse->fail("sparse accessors are not supported");
    AccessorInfo info;
    const JsonRef component = accessor.require("componentType");
    info.component_type = component.integer(0, max_count);
    const std::optional<std::int64_t> bytes = component_bytes(info.component_type);
    if (!bytes) component.fail(fmt::format("{} is no component type", info.component_type));

    const JsonRef type = accessor.require("type");
    info.type = type.string();
    const auto shape = std::find_if(element_types.begin(), element_types.end(),
                                    [&](const ElementType& known) { return known.name == info.type; });
    if (shape == element_types.end()) type.fail(fmt::format("\"{}\" is no accessor type", printable(info.type)));

    info.count = accessor.require("count").integer(1, max_count);
    if (const std::optional<JsonRef> normalized = accessor.find("normalized")) {
        info.normalized = normalized->boolean();
        if (info.normalized && *bytes == 4) normalized->fail("only 8-bit and 16-bit integers can be normalized");
    }
    const JsonRef view_index = accessor.require("bufferView");
    const JsonRef views = check.root.require("bufferViews");
    const JsonRef view = views[view_index.index(check.counts.views, "buffer view")];
    const std::int64_t view_offset = view.find_integer("byteOffset", 0, max_count).value_or(0);
    const std::int64_t view_length = view.require("byteLength").integer(1, max_count);
    const std::int64_t offset = accessor.find_integer("byteOffset", 0, max_count).value_or(0);
    if (offset % *bytes != 0 || (view_offset + offset) % *bytes != 0) {
        accessor.fail(
            fmt::format("starts at byte {}, no multiple of its component's {}", view_offset + offset, *bytes));
    }
    const std::int64_t element = element_bytes(*shape, *bytes);
    const std::optional<std::int64_t> stated_stride = view.find_integer("byteStride", 4, 252);
    info.interleaved = stated_stride.has_value();
    const std::int64_t stride = stated_stride.value_or(element);
    if (stride < element)
        accessor.fail(fmt::format("the view's byteStride {} is below the element's {}", stride, element));
    if (stride % *bytes != 0)
        accessor.fail(fmt::format("the view's byteStride {} is no multiple of {}", stride, *bytes));
    const std::int64_t need = stride * (info.count - 1) + element;
    if (offset > view_length || need > view_length - offset) {
        accessor.fail(fmt::format("{} elements need {} bytes from byte {}, the view has {}", info.count, need, offset,
                                  view_length));
    }
    check.accessors.push_back(std::move(info));
}

void check_allowed(const JsonRef& element, std::string_view key, std::initializer_list<std::int64_t> allowed) {
    const std::optional<JsonRef> member = element.find(key);
    if (!member) return;
    const std::int64_t value = member->integer(0, max_count);
    if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
        member->fail(fmt::format("{} is not an allowed value", value));
    }
}

}  // namespace

std::optional<std::int64_t> component_bytes(std::int64_t component_type) {
    switch (component_type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return std::nullopt;
    }
}

void check_buffers(GltfCheck& check) {
    for_each_object(check.root, "buffers", [&](const JsonRef& buffer, std::size_t i) {
        buffer.find_string("name");
        buffer.require("byteLength").integer(1, max_count);
        if (!buffer.find_string("uri") && !(i == 0 && check.has_binary_chunk)) {
            buffer.fail("\"uri\" is missing, and there is no BIN chunk for it");
        }
    });
    check_views(check);
}

void check_accessors(GltfCheck& check) {
    for_each_object(check.root, "accessors",
                    [&](const JsonRef& accessor, std::size_t) { check_accessor(check, accessor); });
}

void check_images(GltfCheck& check) {
    for_each_object(check.root, "images", [&](const JsonRef& image, std::size_t) {
        image.find_string("name");
        const bool has_uri = image.find_string("uri").has_value();
        const bool has_view = image.find_index("bufferView", check.counts.views, "buffer view").has_value();
        if (has_uri == has_view) image.fail("needs either \"uri\" or \"bufferView\"");
        const std::optional<JsonRef> mime = image.find("mimeType");
        if (has_view && !mime) image.fail("\"mimeType\" is missing");
        if (mime && mime->string() != "image/png" && mime->string() != "image/jpeg") {
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
    for_each_object(check.root, "textures", [&](const JsonRef& texture, std::size_t) {
        texture.find_index("sampler", check.counts.samplers, "sampler");
        if (!texture.find_index("source", check.counts.images, "image")) {
            texture.fail("\"source\" is missing: images from extensions are not supported");
        }
    });
}

}  // namespace aleph
