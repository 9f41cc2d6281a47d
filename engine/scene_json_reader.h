#pragma once
// What the parts of the scene file's reader share: the scene so far and the names in it.

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/gltf_json.h"
#include "engine/scene_json.h"

namespace aleph {

/// Elements of one kind by name.
class NameIndex {
  public:
    explicit NameIndex(std::string kind) : kind_(std::move(kind)) {}

    void add(const std::string& name, int index);
    /// `name`, or "name 2" and so on if an element has it.
    std::string unused(const std::string& name) const;
    std::optional<int> find(const std::string& name) const;
    /// The element that a text in the file names. @throws InputError at that text, with names that are close
    int require(const JsonRef& at) const;

  private:
    std::string kind_;
    std::vector<std::string> names_;
    std::unordered_map<std::string, int> index_;
};

struct SceneReader {
    SceneText result;
    Scene& scene = result.scene;
    NameIndex images{"image"}, materials{"material"}, meshes{"mesh"}, lights{"light"}, cameras{"camera"}, nodes{"node"};
    std::unordered_map<std::string, int> image_of_path;
    std::size_t shape_triangles = 0;
};

using KeyOrder = std::map<std::string, std::vector<std::string>>;

/// The root's images, materials, meshes, lights and cameras, in the order of the file.
void read_elements(SceneReader& reader, const JsonRef& root, const KeyOrder& key_order);

// An element where a node, or a mesh, gives a name or the element itself; `name` is what that one is called then.
int read_material_use(SceneReader& reader, const JsonRef& at, const std::string& name);
int read_light_use(SceneReader& reader, const JsonRef& at, const std::string& name);
int read_camera_use(SceneReader& reader, const JsonRef& at, const std::string& name);

/// Adds a mesh whose triangles are made at the end. @param material  nothing: glTF's default material
int read_shape_mesh(SceneReader& reader, const JsonRef& shape, const std::optional<JsonRef>& material,
                    const std::string& name);

/// The root's nodes with all that stands in them.
void read_nodes(SceneReader& reader, const JsonRef& root);

/// Paths under the key "include" of the root or of a node. @param node  no_index for the root
void read_includes(SceneReader& reader, const JsonRef& parent, int node);

}  // namespace aleph
