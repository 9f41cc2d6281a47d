// The objects of a scene at one time, for `aleph explain --at`.

#include <map>

#include "engine/scene/points.h"
#include "render/cli/explain/explain.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t shown_points = 6;

ordered_json to_rows(const glm::dmat4& m) {
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) rows.push_back(m[column][row]);
    return rows;
}

/// The points as the file has them: those of the point cache or cage if the mesh has one, else the vertices.
std::vector<glm::dvec3> source_points(const Scene& scene, const ScenePose& posed_scene, int mesh_index) {
    const Mesh& mesh = scene.meshes[mesh_index];
    const int cache =
        mesh.subdivision.cage == no_index ? mesh.deformation.points : scene.cages[mesh.subdivision.cage].points;
    if (cache != no_index) return sample_points(scene.point_caches[cache], posed_scene.seconds);
    const PosedMesh& posed = posed_scene.meshes[mesh_index];
    if (!posed.positions.empty()) return posed.positions;
    return {mesh.positions.begin(), mesh.positions.end()};
}

/// The points of a node's meshes. Points that several meshes share count once.
ordered_json describe_points(const Scene& scene, const ScenePose& posed_scene, const Node& node) {
    std::size_t count = 0;
    ordered_json first = ordered_json::array();
    std::map<std::pair<int, int>, bool> counted;
    for (const int index : node.meshes) {
        const Mesh& mesh = scene.meshes[index];
        if (mesh.present.key_count() > 1 && evaluate(mesh.present, posed_scene.seconds) == 0.0) continue;
        const bool own = mesh.subdivision.cage == no_index && mesh.deformation.points == no_index;
        if (!own && !counted.emplace(std::pair(mesh.subdivision.cage, mesh.deformation.points), true).second) continue;
        const std::vector<glm::dvec3> points = source_points(scene, posed_scene, index);
        for (std::size_t i = 0; i < points.size() && first.size() < shown_points; ++i)
            first.push_back(to_json(points[i]));
        count += points.size();
    }
    return {{"count", count}, {"first", std::move(first)}};
}

}  // namespace

ordered_json explain_moment(const Scene& scene, double seconds) {
    const ScenePose posed_scene = pose(scene, seconds);
    const NodePaths paths(scene);
    std::vector<Bounds> bounds(scene.nodes.size());
    for (const Instance& instance : posed_scene.instances)
        add_instance(bounds[instance.node], scene, posed_scene, instance);
    ordered_json objects = ordered_json::array();
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        ordered_json object = {
            {"path", paths[i]}, {"world", to_rows(posed_scene.world[i])}, {"visible", posed_scene.visible[i] != 0}};
        object["bounds"] = to_json(bounds[i]);
        if (!scene.nodes[i].meshes.empty()) object["points"] = describe_points(scene, posed_scene, scene.nodes[i]);
        objects.push_back(std::move(object));
    }
    return {{"seconds", seconds}, {"objects", std::move(objects)}};
}

}  // namespace aleph
