#include "tests/metamorphic/changes.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "engine/scene/operations.h"
#include "engine/scene/visit.h"

namespace aleph {
namespace {

template <class T>
void multiply(Track<T>& track, double factor) {
    for (T& value : track.values) value *= factor;
}

void scale_column(glm::dmat4& matrix, double factor) {
    for (int i = 0; i < 3; ++i) matrix[3][i] *= factor;
}

void scale_stack(OperationStack& stack, double factor) {
    using Kind = OperationStack::Kind;
    for (std::size_t channel = 0; channel < stack.channels.size();) {
        for (const Kind kind : stack.operations) {
            const std::size_t first = kind == Kind::matrix ? 12 : 0;
            if (kind == Kind::translate || kind == Kind::matrix)
                for (std::size_t i = first; i < first + 3; ++i) stack.channels[channel + i] *= factor;
            channel += channel_count(kind);
        }
    }
}

void scale_points(std::vector<glm::vec3>& points, double factor) {
    for (glm::vec3& p : points) p *= static_cast<float>(factor);
}

void delay(TimeSampling& sampling, double seconds) {
    if (sampling.kind == TimeSampling::Kind::uniform) sampling.start += seconds;
    for (double& time : sampling.times) time += seconds;
}

/// Samples at t become samples at -t.
void reverse(TimeSampling& sampling, std::size_t count) {
    std::vector<double> times;
    for (std::size_t i = count; i-- > 0;) times.push_back(-sample_time(sampling, i));
    sampling.kind = TimeSampling::Kind::acyclic;
    sampling.times = std::move(times);
}

template <class T>
void reverse(Track<T>& track) {
    if (track.key_count() < 2) return;
    reverse(track.sampling, track.key_count());
    std::ranges::reverse(track.values);
    if (track.interpolation != Interpolation::cubic) return;
    for (std::size_t i = 0; i < track.values.size(); ++i)
        if (i % 3 != 1) track.values[i] = track.values[i] * -1.0;  // tangents
}

void reverse(OperationStack&) {
    throw std::logic_error("operation stacks cannot be reversed");
}

}  // namespace

void scale_lengths(Scene& scene, double factor) {
    for (Node& node : scene.nodes) {
        multiply(node.transform.translation, factor);
        if (node.transform.matrix)
            for (glm::dmat4& matrix : node.transform.matrix->values) scale_column(matrix, factor);
        if (node.transform.operations) scale_stack(*node.transform.operations, factor);
    }
    for (Mesh& mesh : scene.meshes) {
        mesh.shape.reset();
        scale_points(mesh.positions, factor);
        for (MorphTarget& target : mesh.deformation.targets) scale_points(target.positions, factor);
    }
    for (PointCache& cache : scene.point_caches)
        for (auto& sample : cache.positions) scale_points(sample, factor);
    for (Skin& skin : scene.skins)
        for (glm::dmat4& bind : skin.inverse_binds) scale_column(bind, factor);
    for (Material& material : scene.materials) {
        multiply(material.glass.thickness, factor);
        multiply(material.glass.attenuation_distance, factor);
    }
    for (Light& light : scene.lights) {
        if (light.kind != Light::Kind::directional) multiply(light.intensity, factor * factor);
        multiply(light.range, factor);
    }
    for (Camera& camera : scene.cameras) {
        multiply(camera.half_height, factor);
        multiply(camera.aperture, factor);
        multiply(camera.focus_distance, factor);
        camera.near_plane *= factor;
    }
}

void scale_light(Scene& scene, double factor) {
    for (Material& material : scene.materials) multiply(material.glow.strength, factor);
    for (Light& light : scene.lights) multiply(light.intensity, factor);
    if (scene.environment.radiance) multiply(*scene.environment.radiance, factor);
    *scene.film.exposure /= factor;
}

void delay(Scene& scene, std::int64_t frames) {
    const double seconds = static_cast<double>(frames) / scene.film.frame_rate.per_second();
    const auto later = [&](const auto& seen) {  // visit.h gives what is not to be changed
        delay(const_cast<TimeSampling&>(seen.sampling), seconds);
    };
    for (const Node& node : scene.nodes) visit_tracks(node, later);
    for (const Material& material : scene.materials) visit_tracks(material, later);
    for (const Light& light : scene.lights) visit_tracks(light, later);
    for (const Camera& camera : scene.cameras) visit_tracks(camera, later);
    visit_tracks(scene.environment, later);
    for (Mesh& mesh : scene.meshes) {
        visit_tracks(mesh, later);
        delay(mesh.deformation.normal_sampling, seconds);
    }
    for (PointCache& cache : scene.point_caches) delay(cache.sampling, seconds);
    for (std::int64_t& cut : scene.film.cuts) cut += frames;
    for (CameraKey& key : scene.film.camera_keys) key.frame += frames;
    if (scene.film.range) *scene.film.range = {scene.film.range->first + frames, scene.film.range->last + frames};
}

void reverse_time(Scene& scene) {
    const auto back = [](const auto& seen) { reverse(const_cast<std::decay_t<decltype(seen)>&>(seen)); };
    for (const Node& node : scene.nodes) visit_tracks(node, back);
    for (const Camera& camera : scene.cameras) visit_tracks(camera, back);
    visit_tracks(scene.environment, back);
    for (const Mesh& mesh : scene.meshes) visit_tracks(mesh, back);
    for (PointCache& cache : scene.point_caches) {
        reverse(cache.sampling, cache.positions.size());
        std::ranges::reverse(cache.positions);
    }
}

void place_below(Scene& scene, const glm::dvec3& translation, const glm::dquat& rotation) {
    for (Node& node : scene.nodes) ++node.parent;
    for (Skin& skin : scene.skins)
        for (int& joint : skin.joints) ++joint;
    for (Include& include : scene.source.includes) ++include.node;
    Node root{.name = "above everything", .transform = {.translation = translation, .rotation = rotation}};
    scene.nodes.insert(scene.nodes.begin(), root);
    for (glm::dquat& value : scene.environment.rotation.values) value = rotation * value;
}

void reverse_nodes(Scene& scene) {
    const int count = static_cast<int>(scene.nodes.size());
    std::vector<int> depth(count, 0), order(count), place(count);
    for (int i = 0; i < count; ++i) {
        order[i] = i;
        if (scene.nodes[i].parent != no_index) depth[i] = depth[scene.nodes[i].parent] + 1;
    }
    std::ranges::sort(order, [&](int a, int b) { return depth[a] != depth[b] ? depth[a] < depth[b] : a > b; });
    for (int i = 0; i < count; ++i) place[order[i]] = i;
    std::vector<Node> nodes;
    for (const int i : order) {
        nodes.push_back(scene.nodes[i]);
        int& parent = nodes.back().parent;
        if (parent != no_index) parent = place[parent];
    }
    scene.nodes = std::move(nodes);
    for (Skin& skin : scene.skins)
        for (int& joint : skin.joints) joint = place[joint];
    for (Include& include : scene.source.includes) include.node = place[include.node];
}

void rename_everything(Scene& scene) {
    const auto renamed = [](std::string& name) {
        if (!name.empty()) name = "z" + std::string(name.rbegin(), name.rend());
    };
    for (auto& node : scene.nodes) renamed(node.name);
    for (auto& mesh : scene.meshes) renamed(mesh.name);
    for (auto& material : scene.materials) renamed(material.name);
    for (auto& image : scene.images) renamed(image.name);
    for (auto& light : scene.lights) renamed(light.name);
    for (auto& camera : scene.cameras) renamed(camera.name);
    renamed(scene.film.camera);
    for (auto& key : scene.film.camera_keys) renamed(key.camera);
}

void add_unused(Scene& scene) {
    scene.materials.emplace_back().glow.color = glm::dvec3(7.0);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = static_cast<int>(scene.materials.size()) - 1;
    scene.meshes.push_back(mesh);
    scene.lights.emplace_back().name = "lamp without a node";
    scene.cameras.emplace_back().name = "camera without a node";
    scene.nodes.emplace_back().name = "group without content";
}

void split_meshes(Scene& scene) {
    const std::size_t count = scene.meshes.size();
    std::unordered_map<int, int> halves;
    for (std::size_t i = 0; i < count; ++i) {
        Mesh& mesh = scene.meshes[i];
        if (mesh.triangles.size() < 2 || mesh.deformation.points != no_index || !mesh.deformation.targets.empty() ||
            mesh.deformation.skin != no_index || mesh.subdivision.cage != no_index)
            continue;
        mesh.shape.reset();
        Mesh half = mesh;
        const auto middle = static_cast<std::ptrdiff_t>(mesh.triangles.size() / 2);
        mesh.triangles.erase(mesh.triangles.begin() + middle, mesh.triangles.end());
        half.triangles.erase(half.triangles.begin(), half.triangles.begin() + middle);
        halves[static_cast<int>(i)] = static_cast<int>(scene.meshes.size());
        scene.meshes.push_back(std::move(half));
    }
    for (Node& node : scene.nodes) {
        const std::vector<int> meshes = node.meshes;
        for (const int mesh : meshes)
            if (halves.contains(mesh)) node.meshes.push_back(halves[mesh]);
    }
}

}  // namespace aleph
