#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <unordered_set>

#include "engine/base/errors.h"
#include "engine/json/format.h"
#include "engine/scene/visit.h"
#include "engine/scene_file/scene_text.h"
#include "engine/scene_file/tracks.h"
#include "engine/scene_file/write_elements.h"
#include "engine/surface/cage_checks.h"
#include "engine/surface/shapes.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

template <class Element>
std::string place_of(const char* kind, const std::vector<Element>& list, std::size_t i) {
    return fmt::format("{} {} (\"{}\")", kind, i, printable(list[i].name, 40));
}

class Writer {
  public:
    Writer(const Scene& scene, const std::string& file) : scene_(scene), at_{scene, file, {}} {}

    ordered_json write() {
        if (!scene_.skins.empty()) {
            at_.place = place_of("skin", scene_.skins, 0);
            at_.refuse("a scene file cannot hold skins: keep the mesh in a .glb and include that");
        }
        for_each_list([&](const char* kind, const auto& list) { check_names(kind, list); }, scene_);
        write_header();
        write_list("images", "image", scene_.images, [&](const SceneImage& image) { return ordered_json(image.path); });
        write_list("materials", "material", scene_.materials,
                   [&](const Material& material) { return write_material(at_, material); });
        write_list("points", "points", scene_.point_caches,
                   [&](const PointCache& cache) { return write_point_cache(cache); });
        write_list("cages", "cage", scene_.cages, [&](const Cage& cage) { return write_control_mesh(cage); });
        write_list("meshes", "mesh", scene_.meshes, [&](const Mesh& mesh) { return write_mesh(mesh); });
        write_list("lights", "light", scene_.lights, [&](const Light& light) { return write_light(at_, light); });
        write_list("cameras", "camera", scene_.cameras,
                   [&](const Camera& camera) { return write_camera(at_, camera); });
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            at_.place = place_of("node", scene_.nodes, i);
            out_["nodes"].push_back(write_node(i));
        }
        for (std::size_t i = 0; i < scene_.source.includes.size(); ++i) {
            at_.place = fmt::format("include {}", i);
            const int node = scene_.source.includes[i].node;
            if (node != no_index) at_.name_in(scene_.nodes, node, "node");
        }
        write_includes(out_, no_index);
        return std::move(out_);
    }

  private:
    /// Elements refer to each other by name. Nodes may have no name if nothing refers to them.
    template <class Element>
    void check_names(const char* kind, const std::vector<Element>& list) {
        std::unordered_set<std::string> names;
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i].name.empty() && std::is_same_v<Element, Node>) continue;
            at_.place = place_of(kind, list, i);
            if (list[i].name.empty()) at_.refuse("a scene file needs a name for it");
            if (!names.insert(list[i].name).second)
                at_.refuse("another one has this name: names have to differ in a scene file");
        }
    }

    template <class Element, class Write>
    void write_list(const char* key, const char* kind, const std::vector<Element>& list, const Write& write) {
        if (list.empty()) return;
        out_[key] = ordered_json::object();
        auto& object = out_[key].template get_ref<ordered_json::object_t&>();
        for (std::size_t i = 0; i < list.size(); ++i) {
            at_.place = place_of(kind, list, i);
            object.emplace_back(list[i].name, write(list[i]));  // without a search for the key: names differ
        }
    }

    void write_header() {
        const Scene absent;
        out_["aleph"] = 1;
        if (!scene_.source.name.empty()) out_["name"] = scene_.source.name;
        if (at_.rate().denominator == 1) {
            out_["fps"] = at_.rate().numerator;
        } else {
            out_["fps"] = fmt::format("{}/{}", at_.rate().numerator, at_.rate().denominator);
        }
        if (scene_.film.range) out_["frames"] = {scene_.film.range->first, scene_.film.range->last};
        if (!scene_.film.cuts.empty()) out_["cuts"] = scene_.film.cuts;
        if (scene_.film.viewing != absent.film.viewing)
            at_.fields(out_["viewing"], scene_.film.viewing, absent.film.viewing, viewing_numbers);
        if (scene_.film.exposure) out_["exposure"] = *scene_.film.exposure;
        if (!scene_.film.camera.empty()) out_["camera"] = scene_.film.camera;
        for (const CameraKey& key : scene_.film.camera_keys) out_["camera"]["keys"].push_back({key.frame, key.camera});
        if (scene_.environment.radiance) {
            at_.place = "environment";
            validate(*scene_.environment.radiance, at_.file, at_.place);
            out_["environment"] = write_vector(*scene_.environment.radiance, at_.rate());
        }
        write_environment_picture();
        for (const auto& [key, value] : scene_.source.settings) {
            std::visit([&, name = key](const auto& v) { out_["settings"][name] = v; }, value);
        }
    }

    void write_environment_picture() {
        at_.place = "environment_image";
        if (scene_.environment.image != no_index) {
            if (!scene_.environment.radiance) at_.refuse("needs `environment`, the factor on the picture");
            out_["environment_image"] = at_.name_in(scene_.images, scene_.environment.image, "image");
        }
        at_.place = "environment";
        at_.rotation(out_, "environment_rotation", scene_.environment.rotation, scene_.environment.axis_rotation);
    }

    ordered_json write_mesh(const Mesh& mesh) const {
        if (!mesh.deformation.targets.empty() || mesh.deformation.skin != no_index) {
            at_.refuse("a scene file cannot hold morph targets and skins: keep the mesh in a .glb and include that");
        }
        ordered_json out;
        const PointCache* const points = points_of(mesh);
        if (mesh.subdivision.cage != no_index) {
            out["shape"] = {{"type", "cage"}, {"cage", at_.name_in(scene_.cages, mesh.subdivision.cage, "cage")}};
            if (mesh.subdivision.part != 0) out["shape"]["part"] = mesh.subdivision.part;
        } else if (mesh.shape) {
            validate(*mesh.shape, at_.file, at_.place);
            out["shape"] = write_shape(*mesh.shape);
        } else {
            out["shape"] = write_triangles(mesh, points, at_.rate());
        }
        if (mesh.material != no_index) out["material"] = at_.name_in(scene_.materials, mesh.material, "material");
        at_.track(out, "present", mesh.present, Mesh{}.present, write_visibility);
        return out;
    }

    const PointCache* points_of(const Mesh& mesh) const {
        if (mesh.deformation.points == no_index) return nullptr;
        at_.name_in(scene_.point_caches, mesh.deformation.points, "points");
        const PointCache& cache = scene_.point_caches[mesh.deformation.points];
        for (const std::uint32_t point : mesh.deformation.vertex_points) {
            if (point >= cache.point_count())
                at_.refuse(fmt::format("its points \"{}\" have no point {}", cache.name, point));
        }
        return &cache;
    }

    ordered_json write_point_cache(const PointCache& cache) const {
        if (cache.positions.empty()) at_.refuse("it has no positions");
        validate(cache.sampling, cache.positions.size(), at_.file, at_.place);
        return write_points(cache, at_.rate());
    }

    ordered_json write_control_mesh(const Cage& cage) const {
        const std::string points = at_.name_in(scene_.point_caches, cage.points, "points");
        try {
            validate(cage, scene_.point_caches[cage.points].point_count());
        } catch (const InputError& error) {
            at_.refuse(error.reason());
        }
        return write_cage(cage, points);
    }

    ordered_json write_node(std::size_t index) const {
        const Node absent;
        const Node& node = scene_.nodes[index];
        ordered_json out = {{"name", node.name}};
        if (node.parent != no_index) {
            const std::string parent = at_.name_in(std::span(scene_.nodes).first(index), node.parent, "parent node");
            if (parent.empty())
                at_.refuse(fmt::format("its parent, node {}, needs a name in a scene file", node.parent));
            out["parent"] = parent;
        }
        at_.track(out, "translation", node.transform.translation, absent.transform.translation, write_vector);
        at_.rotation(out, "rotation", node.transform.rotation, node.transform.axis_rotation);
        at_.track(out, "scale", node.transform.scale, absent.transform.scale, write_scale);
        if (node.transform.matrix) {
            validate(*node.transform.matrix, at_.file, at_.place + " matrix");
            out["matrix"] = write_matrix(*node.transform.matrix, at_.rate());
        }
        if (node.transform.operations)
            out["operations"] =
                write_operations(*node.transform.operations, at_.rate(), at_.file, at_.place + " operations");
        at_.track(out, "inherits", node.inherits, absent.inherits, write_visibility);
        at_.track(out, "visible", node.visible, absent.visible, write_visibility);
        if (node.meshes.size() == 1) {
            out["mesh"] = at_.name_in(scene_.meshes, node.meshes.front(), "mesh");
        } else {
            for (const int mesh : node.meshes) out["meshes"].push_back(at_.name_in(scene_.meshes, mesh, "mesh"));
        }
        if (node.camera != no_index) out["camera"] = at_.name_in(scene_.cameras, node.camera, "camera");
        if (node.light != no_index) out["light"] = at_.name_in(scene_.lights, node.light, "light");
        write_includes(out, static_cast<int>(index));
        return out;
    }

    void write_includes(ordered_json& out, int node) const {
        ordered_json paths = ordered_json::array();
        for (const Include& include : scene_.source.includes) {
            if (include.node == node) paths.push_back(write_include(include));
        }
        if (!paths.empty()) out["include"] = paths.size() == 1 ? paths.front() : paths;
    }

    static ordered_json write_include(const Include& include) {
        Include plain;
        plain.path = include.path;
        plain.node = include.node;
        if (include == plain) return include.path;
        ordered_json out{{"file", include.path}};
        if (include.animations) out["animation"] = *include.animations;
        if (!include.materials.empty()) out["materials"] = include.materials;
        if (include.scale != 1.0) out["scale"] = include.scale;
        if (include.up != Include::Up::y) out["up"] = std::string(1, "xyz"[static_cast<int>(include.up)]);
        return out;
    }

    const Scene& scene_;
    SceneWriting at_;
    ordered_json out_;
};

/// The elements before the first included one. Only these are copied: included meshes are large.
template <class Element>
std::vector<Element> own_part(const char* kind, const std::vector<Element>& list, const std::string& file) {
    const auto is_included = [](const Element& element) { return element.include != no_index; };
    const auto end = std::find_if(list.begin(), list.end(), is_included);
    const auto late = std::find_if_not(end, list.end(), is_included);
    if (late != list.end()) {
        throw InputError(file, fmt::format("{} {}", kind, late - list.begin()),
                         "comes after an element of an include; the scene's own elements have to come first");
    }
    return {list.begin(), end};
}

template <class Element>
std::string first_difference(const char* kind, const std::vector<Element>& a, const std::vector<Element>& b) {
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (!(a[i] == b[i])) return place_of(kind, a, i);
    }
    return a.size() == b.size() ? "" : fmt::format("the list of {}s", kind);
}

std::string first_difference(const Scene& a, const Scene& b) {
    std::string place;
    const auto compare = [&](const char* kind, const auto& list, const auto& other) {
        if (place.empty()) place = first_difference(kind, list, other);
    };
    for_each_list(compare, a, b);
    if (!place.empty()) return place;
    return a.source.includes == b.source.includes ? "header" : "includes";
}

}  // namespace

Scene without_includes(const Scene& scene, const std::string& file) {
    Scene own;
    own.source = scene.source;
    own.film = scene.film;
    own.environment = scene.environment;
    for_each_list([&](const char* kind, auto& to, const auto& from) { to = own_part(kind, from, file); }, own, scene);
    return own;
}

std::string write_scene_text(const Scene& scene, const std::string& file) {
    Scene own = without_includes(scene, file);
    const std::string text = format_json(Writer(own, file).write(), file);
    // Finds everything that the format cannot hold: the text is read and compared.
    for (SceneImage& image : own.images) {
        if (image.path.empty())
            throw InputError(file, "image " + image.name, "a scene file needs the path of a picture");
        image.bytes = {};
        image.floats = {};
    }
    own.source.file.clear();
    own.source.warnings.clear();
    for (Include& include : own.source.includes) include.content = no_index;  // known once its file is read
    Scene again = read_scene_text(text, file).scene;
    again.source.warnings.clear();
    if (again != own) {
        throw InputError(file, first_difference(own, again), "holds something that a scene file cannot store exactly");
    }
    return text;
}

}  // namespace aleph
