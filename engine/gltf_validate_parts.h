#pragma once
// The validator's parts, one per kind of element; only gltf_validate*.cpp use them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gltf_json.h"

namespace aleph {

/// What later checks need to know about an accessor that was checked itself.
struct AccessorInfo {
    std::int64_t component_type = 0;
    std::string type;
    std::int64_t count = 0;
    bool normalized = false;
    bool interleaved = false;  ///< its view has a byteStride
};

/// How many elements of each kind the file has, so that any index can be checked at any time.
struct GltfCounts {
    std::size_t buffers = 0, views = 0, accessors = 0, images = 0, samplers = 0, textures = 0, materials = 0,
                meshes = 0, nodes = 0, cameras = 0, scenes = 0, lights = 0;
};

struct GltfCheck {
    const JsonRef& root;
    bool has_binary_chunk;
    std::vector<std::string>& warnings;
    GltfCounts counts;
    std::vector<AccessorInfo> accessors;

    void warn(const JsonRef& place, const std::string& text) {
        warnings.push_back(place.file() + ": " + place.pointer() + ": " + text);
    }
};

/// Bytes of one component, or nothing for a number that is no component type.
std::optional<std::int64_t> component_bytes(std::int64_t component_type);

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

// In this order; each relies on the ones before.
void check_extensions(GltfCheck& check);
void check_buffers(GltfCheck& check);
void check_accessors(GltfCheck& check);
void check_images(GltfCheck& check);
void check_materials(GltfCheck& check);
void check_nodes(GltfCheck& check);
void check_cameras_and_lights(GltfCheck& check);
void check_meshes(GltfCheck& check);
void check_animations(GltfCheck& check);

}  // namespace aleph
