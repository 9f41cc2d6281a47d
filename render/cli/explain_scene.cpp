// A whole scene, described.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "engine/base/errors.h"
#include "engine/lookup.h"
#include "render/cli/explain.h"
#include "render/cli/world_bounds.h"
#include "render/sequence.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

/// Bounds over the range are looked at on so many frames at most.
constexpr std::int64_t most_bounds_frames = 33;

ordered_json to_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

ordered_json to_json(const Bounds& bounds) {
    if (bounds.empty()) return nullptr;
    return {{"min", to_json(bounds.low)}, {"max", to_json(bounds.high)}};
}

std::string named(const std::string& name, const char* kind, std::size_t index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

ordered_json describe_frames(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    const FrameRate& rate = scene.frame_rate;
    return {{"per_second", rate.denominator == 1 ? fmt::format("{}", rate.numerator)
                                                 : fmt::format("{}/{}", rate.numerator, rate.denominator)},
            {"first", range.first},
            {"last", range.last},
            {"from", scene.range ? "given" : "keys"},
            {"first_second", rate.seconds_of(range.first)},
            {"last_second", rate.seconds_of(range.last)},
            {"cuts", scene.cuts}};
}

const char* how_it_deforms(const Scene& scene, const Mesh& mesh) {
    if (mesh.skin != no_index) return mesh.targets.empty() ? "skin" : "morph targets, skin";
    if (!mesh.targets.empty()) return "morph targets";
    const int cache = mesh.cage == no_index ? mesh.points : scene.cages[static_cast<std::size_t>(mesh.cage)].points;
    const bool moves = cache != no_index && is_animated(scene.point_caches[static_cast<std::size_t>(cache)]);
    if (moves) return mesh.cage == no_index ? "points" : "cage points";
    return nullptr;
}

ordered_json count_elements(const Scene& scene) {
    std::size_t triangles = 0, instanced = 0, vertices = 0, instances = 0, animated = 0, deforming = 0, hidden = 0;
    for (const Mesh& mesh : scene.meshes) {
        triangles += mesh.triangles.size();
        vertices += mesh.positions.size();
        if (how_it_deforms(scene, mesh) != nullptr) ++deforming;
    }
    for (const Node& node : scene.nodes) {
        instances += node.meshes.size();
        for (const int mesh : node.meshes) instanced += scene.meshes[static_cast<std::size_t>(mesh)].triangles.size();
        if (!list_tracks(scene, node).empty()) ++animated;
        if (node.visible.key_count() == 1 && key_value(node.visible, 0) == 0.0) ++hidden;
    }
    return {{"objects", scene.nodes.size()},
            {"animated_objects", animated},
            {"hidden_objects", hidden},
            {"meshes", scene.meshes.size()},
            {"deforming_meshes", deforming},
            {"subdivision_cages", scene.cages.size()},
            {"instances", instances},
            {"vertices", vertices},
            {"triangles", triangles},
            {"instanced_triangles", instanced},
            {"materials", scene.materials.size()},
            {"images", scene.images.size()},
            {"lights", scene.lights.size()},
            {"cameras", scene.cameras.size()},
            {"skins", scene.skins.size()},
            {"includes", scene.includes.size()}};
}

ordered_json describe_bounds(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    const auto at_frame = [&](std::int64_t number, Bounds& bounds) {
        const SceneFrame frame = pose(scene, scene.frame_rate.seconds_of(number));
        for (std::size_t i = 0; i < frame.instances.size(); ++i)
            if (frame.shown[i] != 0) add_instance(bounds, scene, frame, frame.instances[i]);
    };
    Bounds first, all;
    at_frame(range.first, first);
    // Looking at every vertex on every frame would take longer than all the rest.
    const std::int64_t length = range.last - range.first;
    const std::int64_t steps = is_world_animated(scene) ? std::min(length, most_bounds_frames - 1) : 0;
    for (std::int64_t step = 0; step <= steps; ++step)
        at_frame(range.first + (steps == 0 ? 0 : length / steps * step + length % steps * step / steps), all);
    return {{"first_frame", to_json(first)}, {"range", to_json(all)}, {"range_frames_seen", steps + 1}};
}

ordered_json describe_node(const Scene& scene, std::size_t index, const std::string& path) {
    const Node& node = scene.nodes[index];
    ordered_json out = {{"path", path}};
    int depth = 0;
    for (int parent = node.parent; parent != no_index; parent = scene.nodes[static_cast<std::size_t>(parent)].parent)
        ++depth;
    out["depth"] = depth;
    if (node.include != no_index) out["from"] = scene.includes[static_cast<std::size_t>(node.include)].path;
    if (!node.meshes.empty()) {
        std::size_t triangles = 0;
        ordered_json materials = ordered_json::array();
        std::string deforms;
        for (const int m : node.meshes) {
            const Mesh& mesh = scene.meshes[static_cast<std::size_t>(m)];
            triangles += mesh.triangles.size();
            const int material = mesh.material;
            const std::string name = material == no_index
                                         ? "(default)"
                                         : named(scene.materials[static_cast<std::size_t>(material)].name, "material",
                                                 static_cast<std::size_t>(material));
            if (std::find(materials.begin(), materials.end(), name) == materials.end()) materials.push_back(name);
            if (const char* how = how_it_deforms(scene, mesh)) deforms = how;
            if (mesh.cage != no_index)
                out["subdivision_level"] = scene.cages[static_cast<std::size_t>(mesh.cage)].level;
        }
        out["triangles"] = triangles;
        out["materials"] = std::move(materials);
        if (!deforms.empty()) out["deforms"] = deforms;
        if (node.meshes.size() > 1) out["meshes"] = node.meshes.size();
    }
    if (node.light != no_index) {
        const Light& light = scene.lights[static_cast<std::size_t>(node.light)];
        constexpr const char* kinds[] = {"point", "directional", "spot"};
        out["light"] = {{"kind", kinds[static_cast<int>(light.kind)]}, {"animated", list_tracks(light)}};
    }
    if (node.camera != no_index) {
        const Camera& camera = scene.cameras[static_cast<std::size_t>(node.camera)];
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

/// The samplings that keyed properties use, each once, by how many use it.
ordered_json collect_samplings(const ordered_json& objects, const ordered_json& materials) {
    std::map<std::string, std::pair<ordered_json, int>> found;
    const auto collect = [&](const ordered_json& tracks) {
        for (ordered_json track : tracks) {
            track.erase("property");
            track.erase("interpolation");
            track.erase("constant");
            auto& entry = found[track.dump()];
            entry.first = track;
            ++entry.second;
        }
    };
    for (const ordered_json& object : objects) {
        if (object.contains("animated")) collect(object["animated"]);
        for (const char* part : {"light", "camera"})
            if (object.contains(part)) collect(object[part]["animated"]);
    }
    for (const ordered_json& material : materials)
        if (material.contains("animated")) collect(material["animated"]);
    ordered_json out = ordered_json::array();
    for (auto& [text, entry] : found) {
        entry.first["properties"] = entry.second;
        out.push_back(std::move(entry.first));
    }
    return out;
}

struct Use {
    std::set<int> meshes, materials, images, lights, cameras;
};

Use find_use(const Scene& scene) {
    Use use;
    for (const Node& node : scene.nodes) {
        use.meshes.insert(node.meshes.begin(), node.meshes.end());
        use.lights.insert(node.light);
        use.cameras.insert(node.camera);
    }
    for (const int mesh : use.meshes) use.materials.insert(scene.meshes[static_cast<std::size_t>(mesh)].material);
    for (const int material : use.materials) {
        if (material == no_index) continue;
        const Material& m = scene.materials[static_cast<std::size_t>(material)];
        for (const TextureRef* texture : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture,
                                          &m.specular_texture, &m.specular_color_texture, &m.transmission_texture})
            use.images.insert(texture->image);
    }
    return use;
}

ordered_json list_unused(const Scene& scene, const Use& use) {
    ordered_json out = ordered_json::array();
    const auto list = [&](const char* kind, const auto& elements, const std::set<int>& used) {
        for (std::size_t i = 0; i < elements.size(); ++i)
            if (!used.contains(static_cast<int>(i)))
                out.push_back(fmt::format("{} \"{}\"", kind, named(elements[i].name, kind, i)));
    };
    list("mesh", scene.meshes, use.meshes);
    list("material", scene.materials, use.materials);
    list("image", scene.images, use.images);
    list("light", scene.lights, use.lights);
    list("camera", scene.cameras, use.cameras);
    return out;
}

ordered_json describe_materials(const Scene& scene) {
    ordered_json out = ordered_json::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        ordered_json item = {{"name", named(material.name, "material", i)}};
        const auto texture = [&](const char* key, const TextureRef& ref) {
            if (ref.image == no_index) return;
            const auto image = static_cast<std::size_t>(ref.image);
            const std::string& path = scene.images[image].path;
            item["textures"][key] = path.empty() ? named(scene.images[image].name, "image", image) : path;
        };
        texture("base_color", material.base_color_texture);
        texture("metallic_roughness", material.metallic_roughness_texture);
        texture("emission", material.emission_texture);
        texture("specular", material.specular_texture);
        texture("specular_color", material.specular_color_texture);
        texture("transmission", material.transmission_texture);
        if (ordered_json animated = list_tracks(material); !animated.empty()) item["animated"] = std::move(animated);
        out.push_back(std::move(item));
    }
    return out;
}

ordered_json describe_images(const Scene& scene) {
    ordered_json out = ordered_json::array();
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        const SceneImage& image = scene.images[i];
        const bool eight = !image.bytes.empty();
        out.push_back(
            {{"name", named(image.name, "image", i)},
             {"path", image.path},
             {"size",
              {eight ? image.bytes.width : image.floats.width, eight ? image.bytes.height : image.floats.height}},
             {"channel", eight ? "8 bits" : "float"}});
    }
    return out;
}

/// The camera and what needs one: a scene without any can still be told of.
void describe_view(ordered_json& out, const Scene& scene, const RenderSettings& settings, const std::string& camera) {
    try {
        const Sequence sequence(scene, settings, camera);
        const SceneFrame frame = pose(scene, 0.0);
        const int index = find_camera(scene, camera);
        out["camera"] = scene.nodes[static_cast<std::size_t>(frame.cameras[static_cast<std::size_t>(index)].node)].name;
        out["exposure"] = {{"factor", sequence.exposure()}, {"from", scene.exposure ? "given" : "first frame"}};
    } catch (const InputError& error) {
        if (!camera.empty()) throw;
        out["camera"] = nullptr;
        out["warnings"].push_back(error.reason());
    }
}

}  // namespace

std::vector<std::string> node_paths(const Scene& scene) {
    std::vector<std::string> paths;
    std::map<std::string, int> times;
    paths.reserve(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        std::string path = node.parent == no_index ? "" : paths[static_cast<std::size_t>(node.parent)];
        path.append("/").append(named(node.name, "node", i));
        const int count = ++times[path];
        paths.push_back(count == 1 ? path : fmt::format("{}#{}", path, count));
    }
    return paths;
}

ordered_json explain_scene(const Scene& scene, const RenderSettings& settings, const std::string& camera) {
    ordered_json out = {{"file", scene.file}, {"name", scene.name}};
    out["units"] = {{"length", "m"}, {"time", "s"}, {"angle", "degrees"}, {"axes", "right-handed, y up"}};
    out["warnings"] = scene.warnings;
    out["frames"] = describe_frames(scene);
    describe_view(out, scene, settings, camera);
    out["counts"] = count_elements(scene);
    out["bounds"] = describe_bounds(scene);
    const std::vector<std::string> paths = node_paths(scene);
    ordered_json objects = ordered_json::array();
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) objects.push_back(describe_node(scene, i, paths[i]));
    ordered_json materials = describe_materials(scene);
    out["time_samplings"] = collect_samplings(objects, materials);
    out["objects"] = std::move(objects);
    out["materials"] = std::move(materials);
    out["images"] = describe_images(scene);
    out["includes"] = ordered_json::array();
    for (const Include& include : scene.includes) out["includes"].push_back(include.path);
    out["unused"] = list_unused(scene, find_use(scene));
    return out;
}

}  // namespace aleph
