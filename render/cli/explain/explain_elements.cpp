// The elements of a scene, with their keyed properties.

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "engine/load/warnings.h"
#include "engine/scene/operations.h"
#include "engine/scene/points.h"
#include "engine/scene_file/fields.h"
#include "render/cli/explain/explain.h"

namespace aleph {

using nlohmann::ordered_json;

namespace {

ordered_json describe_sampling(const TimeSampling& sampling, std::size_t keys) {
    ordered_json out;
    switch (sampling.kind) {
        case TimeSampling::Kind::uniform:
            out = {{"sampling", "uniform"}, {"start", sampling.start}, {"period", sampling.period}};
            break;
        case TimeSampling::Kind::cyclic:
            out = {{"sampling", "cyclic"}, {"period", sampling.period}, {"samples_per_cycle", sampling.times.size()}};
            break;
        case TimeSampling::Kind::acyclic:
            out = {{"sampling", "acyclic"}};
            break;
    }
    out["keys"] = keys;
    out["first"] = sample_time(sampling, 0);
    out["last"] = sample_time(sampling, keys - 1);
    return out;
}

/// The keyed properties of an element: name as in scene files, kind of sampling, number of keys, first and last time,
/// interpolation, and `constant` if all keys are equal.
class TrackList {
  public:
    template <class T>
    void add(const std::string& property, const Track<T>& track) {
        add(property, track.sampling, track.key_count(), track.interpolation, is_animated(track));
    }

    template <class Element, class Fields>
    void add_all(const Element& element, const Fields& fields) {
        for (const auto& field : fields) add(field.key, field.in(element));
    }

    void add(const std::string& property, const TimeSampling& sampling, std::size_t samples,
             Interpolation interpolation, bool animated) {
        if (samples <= 1) return;
        ordered_json item = {{"property", property}};
        item.update(describe_sampling(sampling, samples));
        item["interpolation"] = interpolation_words[index_of(interpolation)];
        if (!animated) item["constant"] = true;
        tracks_.push_back(std::move(item));
    }

    ordered_json take() { return std::move(tracks_); }

  private:
    ordered_json tracks_ = ordered_json::array();
};

void add_rotation(TrackList& list, const std::string& key, const Track<glm::dquat>& rotation,
                  const std::optional<AxisRotation>& about_axis) {
    if (about_axis) {
        list.add(key + ".degrees", about_axis->angle);
    } else {
        list.add(key, rotation);
    }
}

void add_transform(TrackList& list, const Node& node) {
    const LocalTransform& local = node.transform;
    if (local.operations) {
        list.add("operations", local.operations->sampling, sample_count(*local.operations), Interpolation::linear,
                 is_animated(*local.operations));
    } else if (local.matrix) {
        list.add("matrix", *local.matrix);
    } else {
        list.add("translation", local.translation);
        add_rotation(list, "rotation", local.rotation, local.axis_rotation);
        list.add("scale", local.scale);
    }
    list.add("inherits", node.inherits);
    list.add("visible", node.visible);
}

ordered_json list_tracks(const Material& material) {
    TrackList list;
    list.add_all(material, material_colors);
    list.add_all(material, material_numbers);
    list.add_all(material, material_angles);
    return list.take();
}

ordered_json list_environment_tracks(const Scene& scene) {
    TrackList list;
    if (scene.environment.radiance) list.add("environment", *scene.environment.radiance);
    add_rotation(list, "environment_rotation", scene.environment.rotation, scene.environment.axis_rotation);
    return list.take();
}

ordered_json list_tracks(const Light& light) {
    TrackList list;
    list.add_all(light, light_colors);
    list.add_all(light, light_numbers);
    list.add_all(light, light_cones);
    return list.take();
}

ordered_json list_tracks(const Camera& camera) {
    TrackList list;
    list.add_all(camera, camera_angles);
    list.add_all(camera, camera_numbers);
    return list.take();
}

ordered_json list_tracks(const Scene& scene, const Node& node) {
    TrackList list;
    add_transform(list, node);
    int points_listed = no_index;
    for (const int index : node.meshes) {
        const Mesh& mesh = scene.meshes[index];
        list.add("present", mesh.present);
        for (std::size_t i = 0; i < mesh.deformation.target_weights.size(); ++i)
            list.add(fmt::format("weights[{}]", i), mesh.deformation.target_weights[i]);
        list.add("normals", mesh.deformation.normal_sampling, mesh.deformation.normal_samples.size(),
                 Interpolation::linear, true);
        const int points = point_cache_of(scene, mesh);
        if (points == no_index || points == points_listed) continue;
        points_listed = points;
        const PointCache& cache = scene.point_caches[points];
        list.add("points", cache.sampling, cache.positions.size(), Interpolation::linear, is_animated(cache));
    }
    return list.take();
}

/// Returns whether a mesh of the node has a material that gives light at some time.
bool is_area_light(const Scene& scene, const Node& node) {
    return std::ranges::any_of(node.meshes, [&](int mesh) {
        const int material = scene.meshes[mesh].material;
        return material != no_index && gives_light(scene.materials[material]);
    });
}

std::string path_or_name(const Scene& scene, int index) {
    const SceneImage& image = scene.images[index];
    return image.path.empty() ? name_or_number(image.name, "image", static_cast<std::size_t>(index)) : image.path;
}

ordered_json size_of(const SceneImage& image) {
    if (image.bytes.empty()) return {image.floats.width, image.floats.height};
    return {image.bytes.width, image.bytes.height};
}

}  // namespace

int point_cache_of(const Scene& scene, const Mesh& mesh) {
    return mesh.subdivision.cage == no_index ? mesh.deformation.points : scene.cages[mesh.subdivision.cage].points;
}

ordered_json to_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

ordered_json to_json(const Bounds& bounds) {
    if (bounds.empty()) return nullptr;
    return {{"min", to_json(bounds.low)}, {"max", to_json(bounds.high)}};
}

void add_instance(Bounds& bounds, const Scene& scene, const ScenePose& posed_scene, const Instance& instance) {
    const glm::dmat4& world = posed_scene.world[instance.node];
    const auto add = [&](const glm::dvec3& point) { bounds.add(glm::dvec3(world * glm::dvec4(point, 1.0))); };
    const PosedMesh& posed = posed_scene.meshes[instance.mesh];
    if (!posed.positions.empty()) {
        for (const glm::dvec3& point : posed.positions) add(point);
    } else {
        for (const glm::vec3& point : scene.meshes[instance.mesh].positions) add(glm::dvec3(point));
    }
}

const char* how_it_deforms(const Scene& scene, const Mesh& mesh) {
    if (mesh.deformation.skin != no_index) return mesh.deformation.targets.empty() ? "skin" : "morph targets, skin";
    if (!mesh.deformation.targets.empty()) return "morph targets";
    const int cache = point_cache_of(scene, mesh);
    const bool moves = cache != no_index && is_animated(scene.point_caches[cache]);
    if (moves) return mesh.subdivision.cage == no_index ? "points" : "cage points";
    return nullptr;
}

ordered_json describe_node(const Scene& scene, std::size_t index, const NodePaths& paths) {
    const Node& node = scene.nodes[index];
    ordered_json out = {{"path", paths[index]}, {"name", node.name}, {"depth", paths.depth(index)}};
    if (node.include != no_index) out["from"] = scene.source.includes[node.include].path;
    if (!node.meshes.empty()) {
        std::size_t triangles = 0;
        ordered_json materials = ordered_json::array();
        std::string deforms;
        for (const int m : node.meshes) {
            const Mesh& mesh = scene.meshes[m];
            triangles += mesh.triangles.size();
            const int material = mesh.material;
            const std::string name = material == no_index ? "(default)"
                                                          : name_or_number(scene.materials[material].name, "material",
                                                                           static_cast<std::size_t>(material));
            if (std::find(materials.begin(), materials.end(), name) == materials.end()) materials.push_back(name);
            if (const char* how = how_it_deforms(scene, mesh)) deforms = how;
            if (mesh.subdivision.cage != no_index) out["subdivision_level"] = scene.cages[mesh.subdivision.cage].level;
        }
        out["triangles"] = triangles;
        out["materials"] = std::move(materials);
        if (!deforms.empty()) out["deforms"] = deforms;
        if (node.meshes.size() > 1) out["meshes"] = node.meshes.size();
    }
    if (is_area_light(scene, node)) out["area_light"] = true;
    if (node.light != no_index) {
        const Light& light = scene.lights[node.light];
        out["light"] = {{"kind", light_words[static_cast<std::size_t>(light.kind)]}, {"animated", list_tracks(light)}};
    }
    if (node.camera != no_index) {
        const Camera& camera = scene.cameras[node.camera];
        ordered_json described = {{"kind", camera.orthographic ? "orthographic" : "perspective"}};
        if (camera.orthographic) {
            described["half_height"] = key_value(camera.half_height, 0);
        } else {
            described["fov_degrees"] = key_value(camera.fov, 0) * 180.0 / std::numbers::pi;
        }
        described["animated"] = list_tracks(camera);
        out["camera"] = std::move(described);
    }
    if (node.visible.key_count() == 1 && key_value(node.visible, 0) == 0.0) out["hidden"] = true;
    if (node.inherits.key_count() == 1 && key_value(node.inherits, 0) == 0.0) out["detached"] = true;
    ordered_json animated = list_tracks(scene, node);
    if (!animated.empty()) out["animated"] = std::move(animated);
    return out;
}

ordered_json describe_materials(const Scene& scene) {
    ordered_json out = ordered_json::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        ordered_json item = {{"name", name_or_number(material.name, "material", i)}};
        for (const auto& field : material_textures) {
            const int index = material.textures[field.slot].image;
            if (index == no_index) continue;
            const std::string key = field.key;  // "base_color_texture"
            item["textures"][key.substr(0, key.rfind("_texture"))] = path_or_name(scene, index);
        }
        if (ordered_json animated = list_tracks(material); !animated.empty()) item["animated"] = std::move(animated);
        out.push_back(std::move(item));
    }
    return out;
}

ordered_json describe_images(const Scene& scene) {
    ordered_json out = ordered_json::array();
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        const SceneImage& image = scene.images[i];
        out.push_back({{"name", name_or_number(image.name, "image", i)},
                       {"path", image.path},
                       {"size", size_of(image)},
                       {"channel", image.bytes.empty() ? "float" : "8 bits"}});
    }
    return out;
}

ordered_json describe_environment(const Scene& scene) {
    if (!scene.environment.radiance) return nullptr;
    const ordered_json radiance = to_json(key_value(*scene.environment.radiance, 0));
    ordered_json out = {{"radiance", radiance}};
    if (scene.environment.image != no_index) {
        const auto& about_axis = scene.environment.axis_rotation;
        out = {{"factor", radiance},
               {"image", path_or_name(scene, scene.environment.image)},
               {"size", size_of(scene.images[scene.environment.image])},
               {"rotates", about_axis ? is_animated(about_axis->angle) : is_animated(scene.environment.rotation)}};
    }
    out["animated"] = list_environment_tracks(scene);
    return out;
}

}  // namespace aleph
