#include "render/shading_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/transforms.h"

namespace aleph {

namespace {

/// Relative size of the rounding of a float position and of Embree's own: 2^-16 is 256 half-ulps, after
/// Waechter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", but scaled by the triangle's
/// coordinates, so that it stays small in small scenes (HARD_CASES RC-05).
constexpr float offset_scale = 0x1p-16f;

float largest_component(const glm::vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

template <class T>
T interpolate(const std::vector<T>& values, const glm::uvec3& t, float u, float v) {
    return values[t.x] * (1.0f - u - v) + values[t.y] * u + values[t.z] * v;
}

}  // namespace

ShadingScene make_shading_scene(const Scene& scene, const SceneFrame& frame, const glm::dvec3& anchor,
                                const TextureSet& textures) {
    ShadingScene shading;
    shading.scene = &scene;
    shading.frame = &frame;
    shading.textures = &textures;
    shading.anchor = anchor;
    shading.environment = frame.environment;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const MaterialValues& values = frame.materials[i];
        shading.materials.push_back({values, &scene.materials[i], scene.materials[i].double_sided,
                                     values.emission != Rgb(0.0f) && !scene.materials[i].unlit});
    }
    shading.materials.push_back({});
    const int default_material = static_cast<int>(scene.materials.size());
    shading.instances.reserve(frame.instances.size());
    for (const Instance& instance : frame.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const glm::dmat4& world = frame.world[static_cast<std::size_t>(instance.node)];
        PosedInstance posed;
        posed.mesh = &mesh;
        posed.material = mesh.material == no_index ? default_material : mesh.material;
        posed.linear = glm::mat3(glm::dmat3(world));
        posed.translation = glm::vec3(glm::dvec3(world[3]) - anchor);
        posed.normals = glm::mat3(normal_matrix(world));
        // What rays leave out for want of volume (HARD_CASES RC-02) must not shine, nor count for the scene's size.
        posed.visible = frame.visible[static_cast<std::size_t>(instance.node)] != 0 && is_traceable(world, anchor);
        shading.instances.push_back(posed);
    }
    return shading;
}

SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction) {
    const PosedInstance& instance = shading.instances[static_cast<std::size_t>(hit.instance)];
    const Mesh& mesh = *instance.mesh;
    const glm::uvec3 t = mesh.triangles[static_cast<std::size_t>(hit.primitive)];
    // Robust hits may lie a rounding outside their triangle (HARD_CASES RP-18).
    float u = std::max(hit.u, 0.0f), v = std::max(hit.v, 0.0f);
    if (const float sum = u + v; sum > 1.0f) {
        u /= sum;
        v /= sum;
    }
    SurfacePoint point;
    point.material = instance.material;
    const glm::vec3 p0 = mesh.positions[t.x], e1 = mesh.positions[t.y] - p0, e2 = mesh.positions[t.z] - p0;
    const glm::vec3 local = p0 + e1 * u + e2 * v;
    point.position = instance.linear * local + instance.translation;
    const glm::vec3 w0 = instance.linear * p0, w1 = instance.linear * e1, w2 = instance.linear * e2;
    point.offset =
        offset_scale * std::max({largest_component(w0), largest_component(w1), largest_component(w2),
                                 largest_component(instance.translation), largest_component(point.position)});
    // normal_matrix keeps outward outward, under reflections too.
    glm::vec3 geometric = instance.normals * glm::cross(e1, e2);
    const float length = glm::length(geometric);
    geometric = length > 0.0f ? geometric / length : -direction / glm::length(direction);
    point.front = glm::dot(geometric, direction) < 0.0f;
    point.geometric = point.front ? geometric : -geometric;
    point.normal = point.geometric;
    if (!mesh.normals.empty()) {
        const glm::vec3 n = instance.normals * interpolate(mesh.normals, t, u, v);
        const float n_length = glm::length(n);
        if (n_length > 0.0f && std::isfinite(n_length)) {
            glm::vec3 shading_normal = n / n_length;
            if (!point.front) shading_normal = -shading_normal;
            // An interpolated normal on the other side of the surface would leak: take the geometric one (RC-11).
            if (glm::dot(shading_normal, point.geometric) > 0.0f) point.normal = shading_normal;
        }
    }
    point.edges[0] = w1;
    point.edges[1] = w2;
    for (int k = 0; k < 2; ++k) {
        if (mesh.uv[k].empty()) continue;
        point.uv[k] = interpolate(mesh.uv[k], t, u, v);
        point.uv_edges[k][0] = mesh.uv[k][t.y] - mesh.uv[k][t.x];
        point.uv_edges[k][1] = mesh.uv[k][t.z] - mesh.uv[k][t.x];
    }
    if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, t, u, v);
    return point;
}

}  // namespace aleph
