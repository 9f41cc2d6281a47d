#include "engine/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/errors.h"

namespace aleph {

namespace {

/// Where an accessor's elements lie; the validator has checked the range.
struct Layout {
    const std::uint8_t* first;
    std::size_t stride;
    std::size_t count;
    std::size_t components;
};

Layout find_layout(const GltfSource& source, const tinygltf::Accessor& accessor) {
    const tinygltf::BufferView& view = source.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
    const Bytes& buffer = source.buffers[static_cast<std::size_t>(view.buffer)];
    return {buffer.data() + view.byteOffset + accessor.byteOffset, static_cast<std::size_t>(accessor.ByteStride(view)),
            accessor.count,
            static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)))};
}

/// Reads components as C and hands each to store(value, element).
template <class C, class Store>
void for_each_component(const Layout& layout, const Store& store) {
    for (std::size_t i = 0; i < layout.count; ++i) {
        const std::uint8_t* element = layout.first + i * layout.stride;
        for (std::size_t k = 0; k < layout.components; ++k) {
            C value;  // buffers promise no alignment
            std::memcpy(&value, element + k * sizeof(C), sizeof(C));
            store(value, i);
        }
    }
}

/// glTF 2.0, 3.6.2.2: unsigned c / max; signed max(c / max, -1).
template <class T, class C>
T from_integer(C value, bool normalized) {
    if (!normalized) return static_cast<T>(value);
    const double unit = static_cast<double>(value) / static_cast<double>(std::numeric_limits<C>::max());
    return static_cast<T>(std::max(unit, -1.0));
}

}  // namespace

GltfAccessors::GltfAccessors(const GltfSource& source) : source_(source) {
    for (const Bytes& buffer : source.buffers) bytes_left_ += decoded_bytes_per_buffer_byte * buffer.size();
}

template <class T>
std::vector<T> GltfAccessors::read(int index) {
    const tinygltf::Accessor& accessor = source_.model.accessors[static_cast<std::size_t>(index)];
    const Layout layout = find_layout(source_, accessor);
    const std::string place = fmt::format("/accessors/{}", index);
    charge(layout.count * layout.components * sizeof(T), place);
    std::vector<T> values;
    values.reserve(layout.count * layout.components);
    const auto read_integers = [&]<class C>(C) {
        for_each_component<C>(
            layout, [&](C value, std::size_t) { values.push_back(from_integer<T>(value, accessor.normalized)); });
    };
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            read_integers(std::int8_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            read_integers(std::uint8_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            read_integers(std::int16_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            read_integers(std::uint16_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            read_integers(std::uint32_t{});
            break;
        default:
            for_each_component<float>(layout, [&](float value, std::size_t element) {
                if (!std::isfinite(value) || std::abs(value) > static_cast<float>(max_json_number)) {
                    throw InputError(source_.file, place,
                                     fmt::format("element {} is {}: must be finite and within +-{}", element, value,
                                                 max_json_number));
                }
                values.push_back(static_cast<T>(value));
            });
    }
    return values;
}

template std::vector<float> GltfAccessors::read<float>(int);
template std::vector<double> GltfAccessors::read<double>(int);

std::vector<std::uint32_t> GltfAccessors::read_indices(int index, std::size_t vertex_count) {
    const tinygltf::Accessor& accessor = source_.model.accessors[static_cast<std::size_t>(index)];
    const Layout layout = find_layout(source_, accessor);
    const std::string place = fmt::format("/accessors/{}", index);
    charge(layout.count * sizeof(std::uint32_t), place);
    std::vector<std::uint32_t> indices;
    indices.reserve(layout.count);
    const auto store = [&](std::uint32_t value, std::size_t element) {
        if (value >= vertex_count) {
            throw InputError(
                source_.file, place,
                fmt::format("element {} is vertex index {}, there are {} vertices", element, value, vertex_count));
        }
        indices.push_back(value);
    };
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            for_each_component<std::uint8_t>(layout, store);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            for_each_component<std::uint16_t>(layout, store);
            break;
        default:
            for_each_component<std::uint32_t>(layout, store);
    }
    return indices;
}

std::size_t GltfAccessors::count(int accessor) const {
    return source_.model.accessors[static_cast<std::size_t>(accessor)].count;
}

int GltfAccessors::components(int accessor) const {
    const int type = source_.model.accessors[static_cast<std::size_t>(accessor)].type;
    return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
}

void GltfAccessors::charge(std::uint64_t bytes, const std::string& place) {
    if (bytes > bytes_left_) {
        throw InputError(source_.file, place, "the file's meshes and animations decode to too many bytes for its size");
    }
    bytes_left_ -= bytes;
}

}  // namespace aleph
