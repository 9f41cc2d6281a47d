#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "engine/base/errors.h"
#include "engine/cage_validate.h"
#include "engine/json_text.h"
#include "engine/scene_json.h"
#include "engine/scene_json_operations.h"
#include "engine/scene_json_tracks.h"
#include "engine/scene_json_write_meshes.h"
#include "engine/shapes.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

template <class Element>
std::string place_of(const char* kind, const std::vector<Element>& list, std::size_t i) {
    return fmt::format("{} {} (\"{}\")", kind, i, printable(list[i].name, 40));
}

class Writer {
  public:
    Writer(const Scene& scene, const std::string& file) : scene_(scene), rate_(scene.frame_rate), file_(file) {}

    ordered_json write() {
        if (!scene_.skins.empty()) {
            place_ = place_of("skin", scene_.skins, 0);
            refuse("a scene file cannot hold skins: keep the mesh in a .glb and include that");
        }
        check_names("image", scene_.images);
        check_names("material", scene_.materials);
        check_names("points", scene_.point_caches);
        check_names("cage", scene_.cages);
        check_names("mesh", scene_.meshes);
        check_names("light", scene_.lights);
        check_names("camera", scene_.cameras);
        check_names("node", scene_.nodes);
        write_header();
        write_list("images", scene_.images, [&](const SceneImage& image) { return ordered_json(image.path); });
        write_list("materials", scene_.materials, [&](const Material& material) { return write_material(material); });
        write_list("points", scene_.point_caches, [&](const PointCache& cache) { return write_point_cache(cache); });
        write_list("cages", scene_.cages, [&](const Cage& cage) { return write_control_mesh(cage); });
        write_list("meshes", scene_.meshes, [&](const Mesh& mesh) { return write_mesh(mesh); });
        write_list("lights", scene_.lights, [&](const Light& light) { return write_light(light); });
        write_list("cameras", scene_.cameras, [&](const Camera& camera) { return write_camera(camera); });
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            place_ = place_of("node", scene_.nodes, i);
            out_["nodes"].push_back(write_node(i));
        }
        write_includes(out_, no_index);
        return std::move(out_);
    }

  private:
    [[noreturn]] void refuse(const std::string& reason) const { throw InputError(file_, place_, reason); }

    /// Elements refer to each other by name; only nodes may go without, as long as nothing refers to them.
    template <class Element>
    void check_names(const char* kind, const std::vector<Element>& list) {
        std::unordered_set<std::string> names;
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i].name.empty() && std::is_same_v<Element, Node>) continue;
            place_ = place_of(kind, list, i);
            if (list[i].name.empty()) refuse("a scene file needs a name for it");
            if (!names.insert(list[i].name).second)
                refuse("another one has this name: a scene file tells them apart by name");
        }
    }

    template <class Element, class Write>
    void write_list(const char* key, const std::vector<Element>& list, const Write& write) {
        if (list.empty()) return;
        out_[key] = ordered_json::object();
        auto& object = out_[key].template get_ref<ordered_json::object_t&>();
        for (std::size_t i = 0; i < list.size(); ++i) {
            place_ = place_of(key, list, i);
            object.emplace_back(list[i].name, write(list[i]));  // as a vector: names are known to differ
        }
    }

    template <class List>
    std::string name_in(const List& list, int index) const {
        if (index < 0 || static_cast<std::size_t>(index) >= list.size())
            refuse(fmt::format("there is no element {}", index));
        return list[static_cast<std::size_t>(index)].name;
    }

    /// Writes a track under a key unless it says what an absent key says.
    template <class T, class Write>
    void track(ordered_json& out, const char* key, const Track<T>& value, const Track<T>& absent,
               const Write& write) const {
        if (value == absent) return;
        validate(value, file_, place_ + " " + key);
        out[key] = write(value, rate_);
    }

    /// In degrees where they give back every bit, else in radians.
    void angle(ordered_json& out, const char* degrees_key, const char* radians_key, const Track<double>& value) const {
        validate(value, file_, place_ + " " + degrees_key);
        if (const auto degrees = write_degrees(value, rate_)) {
            out[degrees_key] = *degrees;
        } else {
            out[radians_key] = write_number(value, rate_);
        }
    }

    void write_header() {
        const Scene absent;
        out_["aleph"] = 1;
        if (!scene_.name.empty()) out_["name"] = scene_.name;
        if (rate_.denominator == 1) {
            out_["fps"] = rate_.numerator;
        } else {
            out_["fps"] = fmt::format("{}/{}", rate_.numerator, rate_.denominator);
        }
        if (scene_.range) out_["frames"] = {scene_.range->first, scene_.range->last};
        if (!scene_.cuts.empty()) out_["cuts"] = scene_.cuts;
        place_ = "viewing";
        if (scene_.viewing.frames_per_second != rate_.per_second()) {
            refuse(fmt::format("frames_per_second is {}, the frame rate {}: they have to agree",
                               scene_.viewing.frames_per_second, rate_.per_second()));
        }
        if (scene_.viewing.pixels_per_degree != absent.viewing.pixels_per_degree) {
            out_["viewing"]["pixels_per_degree"] = scene_.viewing.pixels_per_degree;
        }
        if (scene_.viewing.display_white != absent.viewing.display_white) {
            out_["viewing"]["display_white"] = scene_.viewing.display_white;
        }
        if (scene_.exposure) out_["exposure"] = *scene_.exposure;
        if (!scene_.camera.empty()) out_["camera"] = scene_.camera;
        if (scene_.environment) {
            place_ = "environment";
            validate(*scene_.environment, file_, place_);
            out_["environment"] = write_vector(*scene_.environment, rate_);
        }
        for (const auto& [key, value] : scene_.settings) {
            std::visit([&, name = key](const auto& v) { out_["settings"][name] = v; }, value);
        }
    }

    ordered_json write_texture(const TextureRef& texture) const {
        ordered_json out = name_in(scene_.images, texture.image);
        if (texture == TextureRef{.image = texture.image}) return out;
        out = {{"image", out}};
        if (texture.uv_set != 0) out["uv_set"] = texture.uv_set;
        const auto word = [](Wrap wrap) { return wrap_words[static_cast<std::size_t>(wrap)]; };
        if (texture.wrap_u != texture.wrap_v) {
            out["wrap"] = {word(texture.wrap_u), word(texture.wrap_v)};
        } else if (texture.wrap_u != Wrap::repeat) {
            out["wrap"] = word(texture.wrap_u);
        }
        if (texture.nearest) out["filter"] = "nearest";
        if (texture.uv_offset != glm::dvec2(0.0)) out["offset"] = {texture.uv_offset.x, texture.uv_offset.y};
        if (texture.uv_scale != glm::dvec2(1.0)) out["scale"] = {texture.uv_scale.x, texture.uv_scale.y};
        if (texture.uv_rotation != 0.0) {
            const auto degrees = exact_degrees(texture.uv_rotation);
            out[degrees ? "rotation" : "rotation_radians"] = degrees.value_or(texture.uv_rotation);
        }
        return out;
    }

    ordered_json write_material(const Material& material) const {
        const Material absent = absent_material();
        ordered_json out = ordered_json::object();
        for (const auto& field : material_colors) {
            track(out, field.key, material.*field.member, absent.*field.member, write_vector);
        }
        for (const auto& field : material_numbers) {
            track(out, field.key, material.*field.member, absent.*field.member, write_number);
        }
        for (const auto& field : material_textures) {
            if ((material.*field.member).image != no_index) out[field.key] = write_texture(material.*field.member);
        }
        if (material.alpha_mode != absent.alpha_mode) {
            out["alpha_mode"] = alpha_words[static_cast<std::size_t>(material.alpha_mode)];
        }
        if (material.alpha_cutoff != absent.alpha_cutoff) out["alpha_cutoff"] = material.alpha_cutoff;
        if (material.unlit) out["unlit"] = true;
        if (material.double_sided) out["double_sided"] = true;
        return out;
    }

    ordered_json write_mesh(const Mesh& mesh) const {
        if (!mesh.targets.empty() || mesh.skin != no_index) {
            refuse("a scene file cannot hold morph targets and skins: keep the mesh in a .glb and include that");
        }
        ordered_json out;
        if (mesh.cage != no_index) {
            out["shape"] = {{"type", "cage"}, {"cage", name_in(scene_.cages, mesh.cage)}};
            if (mesh.cage_part != 0) out["shape"]["part"] = mesh.cage_part;
        } else if (mesh.shape) {
            validate(*mesh.shape, file_, place_);
            out["shape"] = write_shape(*mesh.shape);
        } else {
            out["shape"] = write_triangles(mesh, points_of(mesh), rate_);
        }
        if (mesh.material != no_index) out["material"] = name_in(scene_.materials, mesh.material);
        track(out, "present", mesh.present, Mesh{}.present, write_visibility);
        return out;
    }

    const PointCache* points_of(const Mesh& mesh) const {
        if (mesh.points == no_index) return nullptr;
        name_in(scene_.point_caches, mesh.points);
        const PointCache& cache = scene_.point_caches[static_cast<std::size_t>(mesh.points)];
        for (const std::uint32_t point : mesh.vertex_points) {
            if (point >= cache.point_count())
                refuse(fmt::format("its points \"{}\" have no point {}", cache.name, point));
        }
        return &cache;
    }

    ordered_json write_point_cache(const PointCache& cache) const {
        if (cache.positions.empty()) refuse("it has no positions");
        validate(cache.sampling, cache.positions.size(), file_, place_);
        return write_points(cache, rate_);
    }

    ordered_json write_control_mesh(const Cage& cage) const {
        const std::string points = name_in(scene_.point_caches, cage.points);
        try {
            validate(cage, scene_.point_caches[static_cast<std::size_t>(cage.points)].point_count());
        } catch (const InputError& error) {
            refuse(error.reason());
        }
        return write_cage(cage, points);
    }

    ordered_json write_light(const Light& light) const {
        const Light absent;
        ordered_json out = {{"type", light_words[static_cast<std::size_t>(light.kind)]}};
        track(out, "color", light.color, absent.color, write_vector);
        track(out, "intensity", light.intensity, absent.intensity, write_number);
        track(out, "range", light.range, absent.range, write_number);
        for (const auto& field : light_cones) {
            if (light.*field.member != absent.*field.member) {
                angle(out, field.key, field.key_in_radians, light.*field.member);
            }
        }
        return out;
    }

    ordered_json write_camera(const Camera& camera) const {
        const Camera absent;
        ordered_json out = ordered_json::object();
        if (camera.fov != absent.fov) angle(out, "fov", "fov_radians", camera.fov);
        if (camera.orthographic || camera.half_height != absent.half_height) out["orthographic"] = camera.orthographic;
        for (const auto& field : camera_numbers) {
            track(out, field.key, camera.*field.member, absent.*field.member, write_number);
        }
        if (camera.near_plane != absent.near_plane) out["near"] = camera.near_plane;
        if (camera.shutter != absent.shutter) out["shutter"] = {camera.shutter.x, camera.shutter.y};
        return out;
    }

    ordered_json write_node(std::size_t index) const {
        const Node absent;
        const Node& node = scene_.nodes[index];
        ordered_json out = {{"name", node.name}};
        if (node.parent != no_index) {
            const std::string parent = name_in(scene_.nodes, node.parent);
            if (parent.empty()) refuse(fmt::format("its parent, node {}, needs a name in a scene file", node.parent));
            out["parent"] = parent;
        }
        track(out, "translation", node.translation, absent.translation, write_vector);
        if (node.axis_rotation) {
            out["rotation"]["axis"] = write_dvec3(node.axis_rotation->axis);
            angle(out["rotation"], "degrees", "radians", node.axis_rotation->angle);
        } else {
            track(out, "rotation", node.rotation, absent.rotation, write_quaternion);
        }
        track(out, "scale", node.scale, absent.scale, write_scale);
        if (node.matrix) {
            validate(*node.matrix, file_, place_ + " matrix");
            out["matrix"] = write_matrix(*node.matrix, rate_);
        }
        if (node.operations)
            out["operations"] = write_operations(*node.operations, rate_, file_, place_ + " operations");
        track(out, "inherits", node.inherits, absent.inherits, write_visibility);
        track(out, "visible", node.visible, absent.visible, write_visibility);
        if (node.meshes.size() == 1) {
            out["mesh"] = name_in(scene_.meshes, node.meshes.front());
        } else {
            for (const int mesh : node.meshes) out["meshes"].push_back(name_in(scene_.meshes, mesh));
        }
        if (node.camera != no_index) out["camera"] = name_in(scene_.cameras, node.camera);
        if (node.light != no_index) out["light"] = name_in(scene_.lights, node.light);
        write_includes(out, static_cast<int>(index));
        return out;
    }

    void write_includes(ordered_json& out, int node) const {
        ordered_json paths = ordered_json::array();
        for (const Include& include : scene_.includes) {
            if (include.node == node) paths.push_back(include.path);
        }
        if (!paths.empty()) out["include"] = paths.size() == 1 ? paths.front() : paths;
    }

    const Scene& scene_;
    const FrameRate rate_;
    const std::string& file_;
    std::string place_;  ///< what is being written, for errors
    ordered_json out_;
};

template <class Element>
std::string first_difference(const char* kind, const std::vector<Element>& a, const std::vector<Element>& b) {
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (!(a[i] == b[i])) return place_of(kind, a, i);
    }
    return a.size() == b.size() ? "" : fmt::format("the list of {}s", kind);
}

std::string first_difference(const Scene& a, const Scene& b) {
    for (const std::string& place :
         {first_difference("node", a.nodes, b.nodes), first_difference("points", a.point_caches, b.point_caches),
          first_difference("cage", a.cages, b.cages), first_difference("mesh", a.meshes, b.meshes),
          first_difference("material", a.materials, b.materials), first_difference("image", a.images, b.images),
          first_difference("light", a.lights, b.lights), first_difference("camera", a.cameras, b.cameras)}) {
        if (!place.empty()) return place;
    }
    return a.includes == b.includes ? "header" : "includes";
}

}  // namespace

std::string write_scene_text(const Scene& scene, const std::string& file) {
    Scene own = without_includes(scene, file);
    const std::string text = format_json(Writer(own, file).write(), file);
    // What the format cannot say, in one place and for certain: read it again.
    for (SceneImage& image : own.images) {
        if (image.path.empty())
            throw InputError(file, "image " + image.name, "a scene file needs the path of a picture");
        image.bytes = {};
        image.floats = {};
    }
    own.file.clear();
    own.warnings.clear();
    Scene again = read_scene_text(text, file).scene;
    again.warnings.clear();
    if (again != own) {
        throw InputError(file, first_difference(own, again), "holds something that a scene file cannot say exactly");
    }
    return text;
}

}  // namespace aleph
