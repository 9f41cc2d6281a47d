#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"

namespace aleph {

namespace {

/// Where elements lie; the validator has checked the range.
struct Layout {
    const std::uint8_t* first;
    std::size_t stride;
    std::size_t count;
    std::size_t components;
};

std::size_t component_bytes_of(int component_type) {
    return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

Layout find_layout(const GltfSource& source, std::size_t view_index, std::size_t byte_offset, std::size_t count,
                   std::size_t components, int component_type) {
    const tinygltf::BufferView& view = source.model.bufferViews[view_index];
    const Bytes& buffer = source.buffers[view.buffer];
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : components * component_bytes_of(component_type);
    return {buffer.data() + view.byteOffset + byte_offset, stride, count, components};
}

/// Reads components as C and hands each to store(value, element, component).
template <class C, class Store>
void for_each_component(const Layout& layout, const Store& store) {
    for (std::size_t i = 0; i < layout.count; ++i) {
        const std::uint8_t* element = layout.first + i * layout.stride;
        for (std::size_t k = 0; k < layout.components; ++k) {
            C value;  // buffers promise no alignment
            std::memcpy(&value, element + k * sizeof(C), sizeof(C));
            store(value, i, k);
        }
    }
}

/// Calls visit(C{}) with the C++ type of a component type.
template <class Visit>
void with_component_type(int component_type, const Visit& visit) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return visit(std::int8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return visit(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return visit(std::int16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return visit(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return visit(std::uint32_t{});
        default:
            return visit(float{});
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

std::vector<std::uint32_t> GltfAccessors::read_sparse_indices(int accessor, const nlohmann::json& sparse,
                                                              std::size_t limit) {
    const nlohmann::json& at = sparse["indices"];
    const int type = at["componentType"].get<int>();
    const Layout layout =
        find_layout(source_, at["bufferView"].get<std::size_t>(), at.value("byteOffset", std::size_t{0}),
                    sparse["count"].get<std::size_t>(), 1, type);
    const std::string place = fmt::format("/accessors/{}/sparse/indices", accessor);
    charge(layout.count * sizeof(std::uint32_t), place);
    std::vector<std::uint32_t> indices;
    indices.reserve(layout.count);
    with_component_type(type, [&]<class C>(C) {
        for_each_component<C>(layout, [&](C value, std::size_t i, std::size_t) {
            const auto index = static_cast<std::uint32_t>(value);
            if (index >= limit) {
                throw InputError(source_.file, place,
                                 fmt::format("index {} is {}, the accessor has {} elements", i, index, limit));
            }
            if (!indices.empty() && index <= indices.back()) {
                throw InputError(source_.file, place,
                                 fmt::format("index {} is {}, the one before {}: they must strictly increase", i, index,
                                             indices.back()));
            }
            indices.push_back(index);
        });
    });
    return indices;
}

template <class Store>
void GltfAccessors::for_each_value(int index, const Store& store) {
    const tinygltf::Accessor& accessor = source_.model.accessors[index];
    const std::size_t components = this->components(index);
    const auto read = [&](const Layout& layout, const auto& element_of) {
        with_component_type(accessor.componentType, [&]<class C>(C) {
            for_each_component<C>(layout,
                                  [&](C value, std::size_t i, std::size_t k) { store(element_of(i), k, value); });
        });
    };
    if (accessor.bufferView >= 0) {
        read(find_layout(source_, static_cast<std::size_t>(accessor.bufferView), accessor.byteOffset, accessor.count,
                         components, accessor.componentType),
             [](std::size_t i) { return i; });
    }
    const nlohmann::json& raw = source_.document["accessors"][index];
    const auto sparse = raw.find("sparse");
    if (sparse == raw.end()) return;
    const std::vector<std::uint32_t> elements = read_sparse_indices(index, *sparse, accessor.count);
    const nlohmann::json& values = (*sparse)["values"];
    read(find_layout(source_, values["bufferView"].get<std::size_t>(), values.value("byteOffset", std::size_t{0}),
                     elements.size(), components, accessor.componentType),
         [&](std::size_t i) { return std::size_t{elements[i]}; });
}

template <class T>
std::vector<T> GltfAccessors::read(int index, double max_value) {
    const tinygltf::Accessor& accessor = source_.model.accessors[index];
    const std::size_t components = this->components(index);
    const std::string place = fmt::format("/accessors/{}", index);
    charge(accessor.count * components * sizeof(T), place);
    std::vector<T> values(accessor.count * components);
    for_each_value(index, [&]<class C>(std::size_t element, std::size_t component, C value) {
        if constexpr (std::is_same_v<C, float>) {
            if (!std::isfinite(value) || std::abs(value) > static_cast<float>(max_value)) {
                throw InputError(
                    source_.file, place,
                    fmt::format("element {} is {}: must be finite and within +-{}", element, value, max_value));
            }
            values[element * components + component] = static_cast<T>(value);
        } else {
            values[element * components + component] = from_integer<T>(value, accessor.normalized);
        }
    });
    return values;
}

template std::vector<float> GltfAccessors::read<float>(int, double);
template std::vector<double> GltfAccessors::read<double>(int, double);

std::vector<std::uint32_t> GltfAccessors::read_indices(int index, std::size_t limit, const char* kind) {
    const tinygltf::Accessor& accessor = source_.model.accessors[index];
    const std::size_t components = this->components(index);
    const std::string place = fmt::format("/accessors/{}", index);
    charge(accessor.count * components * sizeof(std::uint32_t), place);
    std::vector<std::uint32_t> indices(accessor.count * components);
    for_each_value(index, [&](std::size_t element, std::size_t component, auto value) {
        indices[element * components + component] = static_cast<std::uint32_t>(value);
    });
    // Once all is read: a sparse value may replace one that is out of range.
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < limit) continue;
        throw InputError(
            source_.file, place,
            fmt::format("element {} is {} index {}, there are {}", i / components, kind, indices[i], limit));
    }
    return indices;
}

std::size_t GltfAccessors::components(int accessor) const {
    const int type = source_.model.accessors[accessor].type;
    return static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
}

void GltfAccessors::charge(std::uint64_t bytes, const std::string& place) {
    if (bytes > bytes_left_) {
        throw InputError(source_.file, place, "the file's meshes and animations decode to too many bytes for its size");
    }
    bytes_left_ -= bytes;
}

}  // namespace aleph
