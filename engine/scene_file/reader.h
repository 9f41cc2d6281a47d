#pragma once
// The reader of scene files: state shared by its parts, and the parts.

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/base/errors.h"
#include "engine/json/json_ref.h"
#include "engine/scene_file/guided_nodes.h"
#include "engine/scene_file/scene_text.h"

namespace aleph {

/// Elements of one kind by name.
class NameIndex {
  public:
    explicit NameIndex(std::string kind) : kind_(std::move(kind)) {}

    void add(const std::string& name, int index);
    /// `name`, or "name 2" and so on if an element has it.
    std::string unused(const std::string& name) const;
    std::optional<int> find(const std::string& name) const;
    /// The element named by the text at `at`.
    /// @throws InputError with the text's pointer, close names, and `advice`
    int require(const JsonRef& at, std::string_view advice = {}) const;

  private:
    std::string kind_;
    std::vector<std::string> names_;
    std::unordered_map<std::string, int> index_;
};

/// The elements of a scene file by name.
struct SceneNames {
    NameIndex images{"image"}, materials{"material"}, meshes{"mesh"}, lights{"light"}, cameras{"camera"}, nodes{"node"};
    NameIndex points{"list of points"}, cages{"cage"};
};

struct SceneReader {
    SceneText result;
    Scene& scene = result.scene;
    std::string file;  ///< its name in errors
    LoadLimits limits;
    SceneNames names;
    std::vector<std::string> cage_places;  ///< JSON pointer per scene.cages
    std::unordered_map<std::string, int> image_of_path;
    GuidedNodes guided;
    std::size_t memory = 0;  ///< about, of the elements so far, bytes

    /// Adds the memory of an element that will be made.
    /// @throws InputError with the pointer of `at` if the sum is above limits.scene()
    void charge(std::size_t bytes, const JsonRef& at, const char* advice);
    void charge(std::size_t bytes, const std::string& place, const char* advice);

    /// Appends an element to its list under its name. @return its index
    template <class Element>
    static int add(Element element, std::vector<Element>& list, NameIndex& names) {
        const int index = static_cast<int>(list.size());
        names.add(element.name, index);
        list.push_back(std::move(element));
        return index;
    }
};

using KeyOrder = std::map<std::string, std::vector<std::string>>;

/// The root's images, materials, meshes, lights and cameras, in the order of the file.
void read_elements(SceneReader& reader, const JsonRef& root, const KeyOrder& key_order);

// Each adds an element to its list. @return its index
int add_material(SceneReader& reader, const JsonRef& at, const std::string& name);
int add_light(SceneReader& reader, const JsonRef& at, const std::string& name);
int add_camera(SceneReader& reader, const JsonRef& at, const std::string& name);
int add_points(SceneReader& reader, const JsonRef& at, const std::string& name);
int add_cage(SceneReader& reader, const JsonRef& at, const std::string& name);

/// Where a node or mesh holds the name of an element, or the element itself, which then gets the name `name`.
/// @param names, add  of its kind
template <class Add>
int read_use(SceneReader& reader, const JsonRef& at, const NameIndex& names, const std::string& name, const Add& add) {
    return at.json().is_string() ? names.require(at) : add(reader, at, names.unused(name));
}

/// The image that a text names: a name from "images", or a path, which becomes an image.
int read_image_use(SceneReader& reader, const JsonRef& at);

/// The enumerator that the text names. @param words  in the order of the enumerators
template <class Enum, class Words>
Enum read_word(const JsonRef& at, const Words& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (at.string() == words[i]) return static_cast<Enum>(i);
    }
    at.fail("unknown word");  // the schema has the same words
}

/// Adds a mesh. Triangles of shapes and cages are made at the end, by make_meshes.
/// @param material  absent: Material{}
int read_mesh(SceneReader& reader, const JsonRef& shape, const std::optional<JsonRef>& material,
              const std::optional<JsonRef>& present, const std::string& name);

/// Makes the triangles of shapes and cages, after all were counted (SceneReader::charge).
void make_meshes(SceneReader& reader);
void make_cage_meshes(SceneReader& reader);

/// Vertex positions of a mesh in the cache's first sample.
std::vector<glm::vec3> first_positions(const Mesh& mesh, const PointCache& cache);

/// The root's nodes and the elements in them.
void read_nodes(SceneReader& reader, const JsonRef& root);

/// Paths under the key "include" of the root or of a node. @param node  no_index for the root
void read_includes(SceneReader& reader, const JsonRef& parent, int node);

// Named values: numbers, vectors and tracks of the root's object "named", used elsewhere as {"named": "door height"}.

/// Puts the values in the places where they are used; values may use others. Not in "settings", and not directly in
/// "images" and "materials", where "named" is a name of the file's own.
/// @param text  of the file; its values and the copies together take at most limits.json_values()
/// @throws InputError with the place of use: no value of that name, one that holds itself, too many copies, too deep
void replace_named_values(nlohmann::json& root, std::string_view text, const std::string& file,
                          const LoadLimits& limits);

/// The error, and where the value at its place is defined if that is a named one.
/// @param root  of the file, before replace_named_values
InputError with_definition(const InputError& error, const nlohmann::json& root);

}  // namespace aleph
