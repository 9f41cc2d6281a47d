// Validator: accessors and their sparse values.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/errors.h"
#include "engine/gltf/validate/parts.h"

namespace aleph {

namespace {

struct ElementType {
    std::string_view name;
    std::int64_t columns;
    std::int64_t rows;
};

constexpr std::array<ElementType, 7> element_types = {
    {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4}, {"MAT2", 2, 2}, {"MAT3", 3, 3}, {"MAT4", 4, 4}}};

/// Bytes of one component; 0 for a number that is no component type.
std::int64_t component_bytes(std::int64_t type) {
    if (type == type_i8 || type == type_u8) return 1;
    if (type == type_i16 || type == type_u16) return 2;
    return type == type_u32 || type == type_float ? 4 : 0;
}

/// Bytes of one element; a matrix column starts at a multiple of 4 bytes.
std::int64_t element_bytes(const ElementType& type, std::int64_t component) {
    const std::int64_t column = type.rows * component;
    return type.columns == 1 ? column : type.columns * ((column + 3) / 4 * 4);
}

/// Where `count` elements lie in a view.
struct Block {
    std::int64_t stride = 0;
    std::int64_t first = 0;  ///< byte in the buffer
    bool is_strided = false;
};

/// @param owner    what has the byteOffset, and what errors name
/// @param element  bytes of one element; @param component  bytes of one component
Block check_block(const GltfCheck& check, const JsonRef& owner, const JsonRef& view_index, std::int64_t count,
                  std::int64_t element, std::int64_t component) {
    const JsonRef views = check.root.require("bufferViews");
    const JsonRef view = views[view_index.index(check.count("bufferViews"), "buffer view")];
    const std::int64_t view_offset = view.find_integer("byteOffset", 0, max_gltf_count).value_or(0);
    const std::int64_t view_length = view.require("byteLength").integer(1, max_gltf_count);
    const std::int64_t offset = owner.find_integer("byteOffset", 0, max_gltf_count).value_or(0);
    if (offset % component != 0 || (view_offset + offset) % component != 0) {
        owner.fail(
            fmt::format("starts at byte {}, no multiple of its component's {}", view_offset + offset, component));
    }
    const std::optional<std::int64_t> stated_stride = view.find_integer("byteStride", 4, 252);
    const std::int64_t stride = stated_stride.value_or(element);
    if (stride < element)
        owner.fail(fmt::format("the view's byteStride {} is below the element's {}", stride, element));
    if (stride % component != 0)
        owner.fail(fmt::format("the view's byteStride {} is no multiple of {}", stride, component));
    const std::int64_t need = stride * (count - 1) + element;
    if (offset > view_length || need > view_length - offset) {
        owner.fail(
            fmt::format("{} elements need {} bytes from byte {}, the view has {}", count, need, offset, view_length));
    }
    return {stride, view_offset + offset, stated_stride.has_value()};
}

void check_sparse(const GltfCheck& check, const JsonRef& sparse, std::int64_t element_count, std::int64_t element,
                  std::int64_t component) {
    sparse.expect_object();
    const std::int64_t count = sparse.require("count").integer(1, element_count);
    const JsonRef indices = sparse.require("indices");
    const JsonRef type = indices.require("componentType");
    const std::int64_t kind = type.integer(0, max_gltf_count);
    if (kind != type_u8 && kind != type_u16 && kind != type_u32) type.fail("sparse indices must be unsigned integers");
    const JsonRef index_view = indices.require("bufferView");
    const std::int64_t index_bytes = component_bytes(kind);
    if (check_block(check, indices, index_view, count, index_bytes, index_bytes).is_strided) {
        index_view.fail("the view of sparse indices must not have a byteStride");
    }
    const JsonRef values = sparse.require("values");
    const JsonRef value_view = values.require("bufferView");
    if (check_block(check, values, value_view, count, element, component).is_strided) {
        value_view.fail("the view of sparse values must not have a byteStride");
    }
}

std::int64_t total_buffer_bytes(const GltfCheck& check) {
    std::int64_t total = 0;
    for_each_object(check.root, "buffers", [&](const JsonRef& buffer, std::size_t) {
        total += buffer.require("byteLength").integer(1, max_gltf_count);
    });
    return total;
}

void check_accessor(GltfCheck& check, const JsonRef& accessor, std::int64_t buffer_bytes) {
    accessor.find_string("name");
    AccessorInfo info;
    const JsonRef component = accessor.require("componentType");
    info.component_type = component.integer(0, max_gltf_count);
    const std::int64_t bytes = component_bytes(info.component_type);
    if (bytes == 0) component.fail(fmt::format("{} is no component type", info.component_type));

    const JsonRef type = accessor.require("type");
    info.type = type.string();
    const auto shape = std::find_if(element_types.begin(), element_types.end(),
                                    [&](const ElementType& known) { return known.name == info.type; });
    if (shape == element_types.end()) type.fail(fmt::format("\"{}\" is no accessor type", printable(info.type)));

    const JsonRef count = accessor.require("count");
    info.count = count.integer(1, max_gltf_count);
    if (const std::optional<JsonRef> normalized = accessor.find("normalized")) {
        info.normalized = normalized->boolean();
        if (info.normalized && bytes == 4) normalized->fail("only 8-bit and 16-bit integers can be normalized");
    }
    const std::int64_t element = element_bytes(*shape, bytes);
    if (const std::optional<JsonRef> view_index = accessor.find("bufferView")) {
        const Block block = check_block(check, accessor, *view_index, info.count, element, bytes);
        info.interleaved = block.is_strided;
        info.aligned = block.first % 4 == 0 && (block.stride % 4 == 0 || info.count == 1);
    } else {
        // All values are zero. No data supports the count, so it is limited by the size of the buffers.
        if (info.count > buffer_bytes) {
            count.fail(fmt::format("{} elements without a buffer view, the buffers have {} bytes in all", info.count,
                                   buffer_bytes));
        }
        if (accessor.has("byteOffset")) {
            check.warn(accessor, "byteOffset means nothing without a bufferView and is ignored");
        }
    }
    if (const std::optional<JsonRef> sparse = accessor.find("sparse")) {
        check_sparse(check, *sparse, info.count, element, bytes);
    }
    check.accessors.push_back(std::move(info));
}

}  // namespace

void check_accessors(GltfCheck& check) {
    const std::int64_t buffer_bytes = total_buffer_bytes(check);
    for_each_object(check.root, "accessors",
                    [&](const JsonRef& accessor, std::size_t) { check_accessor(check, accessor, buffer_bytes); });
}

}  // namespace aleph
