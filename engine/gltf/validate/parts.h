#pragma once
// The validator's parts, one per kind of element; only this folder uses them.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/json/json_ref.h"

namespace aleph {

/// The properties of an accessor that later checks need.
struct AccessorInfo {
    std::int64_t component_type = 0;
    std::string type;
    std::int64_t count = 0;
    bool normalized = false;
    bool interleaved = false;  ///< its view has a byteStride
    bool aligned = true;       ///< every element starts at a multiple of 4 bytes, as vertex attributes must
};

/// Extension `name` of an element, with its parents kept alive for error messages.
class ExtensionRef {
  public:
    ExtensionRef(const JsonRef& element, std::string_view name) : extensions_(element.find("extensions")) {
        if (extensions_) extension_ = extensions_->find(name);
    }
    ExtensionRef(const ExtensionRef&) = delete;
    ExtensionRef& operator=(const ExtensionRef&) = delete;
    explicit operator bool() const { return extension_.has_value(); }
    const JsonRef& operator*() const { return *extension_; }
    const JsonRef* operator->() const { return &*extension_; }

  private:
    std::optional<JsonRef> extensions_, extension_;
};

struct GltfCheck {
    const JsonRef& root;
    bool has_binary_chunk;
    std::vector<std::string>& warnings;
    std::vector<AccessorInfo> accessors{};
    std::vector<std::size_t> target_counts{};  ///< morph targets of each mesh
    bool is_quantized = false;                 ///< KHR_mesh_quantization: vertex attributes may be small integers

    /// Elements of a list of the file: what indices are checked against.
    std::size_t count(const char* list) const { return count_of(root, list); }
    std::size_t light_count() const {
        const ExtensionRef lights(root, "KHR_lights_punctual");
        return lights ? count_of(*lights, "lights") : 0;
    }
    const AccessorInfo& accessor(const JsonRef& index) const {
        return accessors[index.index(accessors.size(), "accessor")];
    }
    void warn(const JsonRef& place, const std::string& text) {
        const std::string pointer = place.pointer();
        warnings.push_back(place.file() + (pointer.empty() ? ": " : ": " + pointer + ": ") + text);
    }
};

inline constexpr std::int64_t type_i8 = 5120, type_u8 = 5121, type_i16 = 5122, type_u16 = 5123, type_u32 = 5125,
                              type_float = 5126;

/// The largest count, offset or length: sizes made of them fit 64 bits (2^31 elements of at most 64 bytes).
inline constexpr std::int64_t max_gltf_count = 0x7fffffff;

inline bool is_float(const AccessorInfo& info) {
    return info.component_type == type_float;
}
/// Floats, or signed integers that stand for -1 to 1, or unsigned ones that stand for 0 to 1.
inline bool is_unit_range(const AccessorInfo& info) {
    return is_float(info) || info.normalized;
}
/// The same without signed integers.
inline bool is_positive_unit_range(const AccessorInfo& info) {
    const bool is_unsigned = info.component_type == type_u8 || info.component_type == type_u16;
    return is_float(info) || (is_unsigned && info.normalized);
}

/// Refuses a text that is none of the words. @param kind  of the words, for messages
void expect_word(const JsonRef& at, std::initializer_list<std::string_view> words, std::string_view kind);

// Called in this order: each relies on the ones before.
void check_extensions(GltfCheck& check);
void check_buffers(GltfCheck& check);
void check_accessors(GltfCheck& check);
void check_images(GltfCheck& check);
void check_materials(GltfCheck& check);
void check_nodes(GltfCheck& check);
void check_cameras_and_lights(GltfCheck& check);
void check_meshes(GltfCheck& check);
void check_skins(GltfCheck& check);  ///< and the nodes that use them, and node weights and instances
void check_animations(GltfCheck& check);

}  // namespace aleph
