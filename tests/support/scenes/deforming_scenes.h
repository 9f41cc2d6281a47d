#pragma once
// Small deforming scenes made in code.

#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>
#include <vector>

#include "engine/pose/pose.h"

namespace aleph {

/// A square sheet in the xy plane from -1 to 1, facing +z.
inline Mesh make_sheet(unsigned cells) {
    Mesh mesh;
    const auto at = [&](unsigned i) { return 2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1.0f; };
    for (unsigned y = 0; y <= cells; ++y)
        for (unsigned x = 0; x <= cells; ++x) mesh.positions.emplace_back(at(x), at(y), 0.0f);
    for (unsigned y = 0; y < cells; ++y) {
        for (unsigned x = 0; x < cells; ++x) {
            const unsigned a = y * (cells + 1) + x, c = a + cells + 1;
            mesh.triangles.emplace_back(a, a + 1, c + 1);
            mesh.triangles.emplace_back(a, c + 1, c);
        }
    }
    return mesh;
}

/// One node that carries one sheet.
inline Scene make_sheet_scene(unsigned cells = 4) {
    Scene scene;
    scene.meshes = {make_sheet(cells)};
    scene.nodes.resize(1);
    scene.nodes[0].meshes = {0};
    return scene;
}

/// A point cache for a mesh: sample i at times[i], of move(rest position, i).
template <class Move>
void add_cache(Scene& scene, std::size_t mesh, std::vector<double> times, const Move& move) {
    PointCache cache;
    const std::size_t count = times.size();
    cache.sampling = {TimeSampling::Kind::acyclic, 0.0, 1.0, std::move(times)};
    for (std::size_t sample = 0; sample < count; ++sample) {
        cache.positions.emplace_back();
        for (const glm::vec3& p : scene.meshes[mesh].positions) cache.positions.back().push_back(move(p, sample));
    }
    scene.meshes[mesh].deformation.points = static_cast<int>(scene.point_caches.size());
    scene.meshes[mesh].positions = cache.positions.front();
    scene.point_caches.push_back(std::move(cache));
}

/// Node 0 carries a sheet with a skin. Points with x > 0 follow joint node 2, which turns about z; the others follow
/// joint node 1, which is at rest. Node 0 is moved and scaled, which must not change the result.
inline Scene make_skin_scene() {
    Scene scene = make_sheet_scene();
    scene.nodes.resize(3);
    scene.nodes[0].transform.translation = glm::dvec3(5.0, -3.0, 2.0);
    scene.nodes[0].transform.scale = glm::dvec3(2.0, 1.0, 0.5);
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, -1.0);
    scene.nodes[2].parent = 1;
    scene.nodes[2].transform.translation = glm::dvec3(0.0, 0.0, 1.0);
    Skin skin;
    skin.joints = {1, 2};
    skin.inverse_binds = {glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 1.0)), glm::dmat4(1.0)};
    scene.skins = {skin};
    Mesh& mesh = scene.meshes[0];
    mesh.deformation.skin = 0;
    mesh.deformation.joints_per_vertex = 2;
    for (const glm::vec3& p : mesh.positions) {
        const float right = p.x > 0.0f ? 1.0f : 0.0f;
        mesh.deformation.joint_weights.push_back({0, 1.0f - right});
        mesh.deformation.joint_weights.push_back({1, right});
    }
    return scene;
}

/// Where make_skin_scene's sheet has a point, in the world.
inline glm::dvec3 bent_by(const glm::vec3& rest, double angle) {
    const glm::dvec3 p(rest);
    if (!(p.x > 0.0)) return p;
    return {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle), p.z};
}

/// One of each thing that can change with time, and things that do not.
inline Scene make_everything_scene() {
    Scene scene = make_skin_scene();
    scene.nodes[2].transform.rotation =
        Track<glm::dquat>({0.0, 1.0}, {glm::dquat(1.0, 0.0, 0.0, 0.0), glm::dquat(0.6, 0.0, 0.0, 0.8)});
    const auto add_node = [&](int parent) -> Node& {
        scene.nodes.emplace_back();
        scene.nodes.back().parent = parent;
        return scene.nodes.back();
    };
    const auto add_mesh = [&](unsigned cells) {
        scene.meshes.push_back(make_sheet(cells));
        return static_cast<int>(scene.meshes.size()) - 1;
    };
    const int cached = add_mesh(3), morphed = add_mesh(2), still = add_mesh(2), passing = add_mesh(1),
              held = add_mesh(1);
    add_cache(scene, static_cast<std::size_t>(cached), {0.0, 1.0, 2.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, p.x * p.y * static_cast<float>(sample));
    });
    Mesh& morph = scene.meshes[morphed];
    morph.deformation.targets.resize(1);
    morph.deformation.targets[0].positions.assign(morph.positions.size(), glm::vec3(0.25f, 0.5f, 1.0f));
    morph.deformation.target_weights = {Track<double>({0.0, 1.5}, {0.0, 1.0})};
    Mesh& always = scene.meshes[held];
    always.deformation.targets.resize(1);
    always.deformation.targets[0].positions.assign(always.positions.size(), glm::vec3(1.0f));
    always.deformation.target_weights = {Track<double>(0.5)};
    scene.meshes[passing].present = Track<double>({0.5, 1.0}, {1.0, 0.0}, Interpolation::step);
    add_node(no_index).meshes = {cached, still};
    add_node(3).meshes = {morphed, passing};
    add_node(no_index).meshes = {still, held};
    Node& mover = add_node(4);  // 6
    mover.transform.translation =
        Track<glm::dvec3>({0.0, 2.0}, {glm::dvec3(0.0, 0.0, -2.0), glm::dvec3(3.0, 0.0, -2.0)});
    mover.meshes = {cached, still};
    Node& detached = add_node(6);  // 7
    detached.inherits = Track<double>({0.0, 0.5}, {0.0, 1.0}, Interpolation::step);
    detached.meshes = {still};
    detached.visible = Track<double>({0.0, 1.0}, {1.0, 0.0}, Interpolation::step);
    scene.nodes[5].visible = Track<double>({0.0, 0.75}, {1.0, 0.0}, Interpolation::step);
    Node& stack = add_node(no_index);  // 8
    stack.transform.operations = OperationStack{{OperationStack::Kind::rotate_y}, {}, {0.0, 1.0}};
    stack.light = 0;
    scene.lights.resize(2);
    scene.lights[1].intensity = Track<double>({0.0, 1.0}, {1.0, 5.0});
    add_node(7).light = 1;
    scene.cameras.resize(2);
    add_node(8).camera = 0;
    add_node(no_index).camera = 1;
    scene.cameras[1].fov = Track<double>({0.0, 1.0}, {0.5, 1.0});
    scene.materials.resize(2);
    scene.materials[1].gloss.roughness = Track<double>({0.0, 1.0}, {0.1, 0.9});
    scene.environment.radiance = Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(1.0)});
    return scene;
}

}  // namespace aleph
