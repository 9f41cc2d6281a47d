#include "render/shading_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/transforms.h"
#include "render/environment_map.h"
#include "render/texture.h"

namespace aleph {

namespace {

/// In units of rounding_bound: 16 half-ulps. Random triangles meet themselves with offsets of 2 half-ulps, and none of
/// them with 4.
constexpr float offset_scale = 0x1p-20f;

glm::mat3 abs_of(const glm::mat3& m) {
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

/// By how much rounding moves a point of a triangle along its normal, there and in the object's space or that of the
/// flat tree, where Embree tests the triangle, in units of the relative rounding: the sum of the terms' sizes,
/// component by component (as in Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", 6.8). What lies in the
/// plane of the triangle hardly counts, so that a wide floor has an offset about as small as a narrow one's. It counts
/// a little, because a plane through the origin has no rounding, and yet a ray that starts in it would meet it.
/// @param p0, e1, e2  object space: a corner and the edges from it
float rounding_bound(const PosedInstance& instance, const glm::vec3& p0, const glm::vec3& e1, const glm::vec3& e2,
                     const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 own = abs_of(instance.linear) * glm::max(glm::abs(p0), glm::max(glm::abs(e1), glm::abs(e2)));
    glm::vec3 place = glm::max(glm::abs(instance.translation), glm::abs(position));
    if (instance.flat) place = glm::max(place, glm::abs(position - instance.flat_origin));
    const glm::vec3 placed = instance.rounding * place;
    return glm::dot(glm::abs(normal), own + placed) + 0x1p-8f * std::max({own.x, own.y, own.z});
}

template <class T>
T interpolate(const std::vector<T>& values, const glm::uvec3& t, float u, float v) {
    return values[t.x] * (1.0f - u - v) + values[t.y] * u + values[t.z] * v;
}

void add(SceneBounds& bounds, const PosedInstance& instance) {
    if (!instance.visible) return;
    for (std::uint32_t v = 0; v < instance.mesh->positions.size(); ++v) {
        const glm::vec3 world = instance.linear * instance.corner(v) + instance.translation;
        bounds.low = glm::min(bounds.low, world);
        bounds.high = glm::max(bounds.high, world);
    }
}

bool can_emit(const Material& material) {
    const auto is_on = [](const auto& track, const auto& zero) {
        return is_animated(track) || !(key_value(track, 0) == zero);
    };
    return !material.unlit && is_on(material.emission, glm::dvec3(0.0)) && is_on(material.emission_strength, 0.0);
}

ShadingMaterial make_material(const Scene& scene, const ScenePose& pose, int i) {
    const MaterialValues& values = pose.materials[i];
    return {values, &scene.materials[i], scene.materials[i].double_sided,
            values.emission != Rgb(0.0f) && !scene.materials[i].unlit,
            values.clearcoat > 0.0f || values.sheen_color != Rgb(0.0f) || values.anisotropy > 0.0f};
}

/// What the pose says of the whole scene's light.
void set_surroundings(ShadingScene& shading) {
    const ScenePose& pose = *shading.pose;
    shading.environment = pose.environment;
    shading.environment_rotation = glm::mat3(pose.environment_rotation);
    shading.has_sheets = std::ranges::any_of(pose.materials, [](const MaterialValues& values) {
        return values.transmission > 0.0f && values.thickness == 0.0f;
    });
}

PosedInstance make_instance(const ShadingScene& shading, const RayScene& rays, int i) {
    const ScenePose& pose = *shading.pose;
    const Instance& instance = pose.instances[i];
    const Mesh& mesh = shading.scene->meshes[instance.mesh];
    const glm::dmat4& world = pose.world[instance.node];
    PosedInstance posed;
    posed.mesh = &mesh;
    posed.material = mesh.material == no_index ? static_cast<int>(shading.scene->materials.size()) : mesh.material;
    posed.linear = glm::mat3(glm::dmat3(world));
    posed.translation = glm::vec3(glm::dvec3(world[3]) - shading.anchor);
    posed.normals = glm::mat3(normal_matrix(world));
    posed.flat = rays.is_flat(i);
    if (posed.flat) posed.flat_origin = glm::vec3(rays.flat_origin() - shading.anchor);
    const PosedMesh& deformed = pose.meshes[instance.mesh];
    if (!deformed.positions.empty()) posed.deformed = &deformed;
    // Rays leave out instances without volume or with bad points, so these must not emit light or count for the scene's
    // size.
    posed.visible = pose.shown[i] != 0 && is_traceable(world, shading.anchor) && are_traceable(deformed.positions);
    if (posed.visible) posed.rounding = abs_of(posed.linear) * abs_of(glm::mat3(glm::inverse(glm::dmat3(world))));
    return posed;
}

void add_texture_coordinates(const PosedInstance& instance, const glm::uvec3& t, const glm::vec3& e1,
                             const glm::vec3& e2, float u, float v, SurfacePoint& point) {
    point.edges[0] = instance.linear * e1;
    point.edges[1] = instance.linear * e2;
    for (int k = 0; k < 2; ++k) {
        const std::vector<glm::vec2>& uv = instance.mesh->uv[k];
        if (uv.empty()) continue;
        point.uv[k] = interpolate(uv, t, u, v);
        point.uv_edges[k][0] = uv[t.y] - uv[t.x];
        point.uv_edges[k][1] = uv[t.z] - uv[t.x];
    }
}

}  // namespace

ShadingScene make_shading_scene(const Scene& scene, const ScenePose& pose, const RayScene& rays,
                                const TextureSet& textures) {
    ShadingScene shading;
    shading.scene = &scene;
    shading.pose = &pose;
    shading.textures = &textures;
    shading.anchor = rays.anchor();
    if (!textures.environment.empty()) shading.environment_map = &textures.environment;
    set_surroundings(shading);
    std::vector<bool> can_shine;
    for (int i = 0; i < std::ssize(scene.materials); ++i) {
        shading.materials.push_back(make_material(scene, pose, i));
        can_shine.push_back(can_emit(scene.materials[i]));
    }
    shading.materials.push_back({});
    can_shine.push_back(false);
    shading.instances.reserve(pose.instances.size());
    for (int i = 0; i < std::ssize(pose.instances); ++i) {
        shading.instances.push_back(make_instance(shading, rays, i));
        const PosedInstance& instance = shading.instances.back();
        if (can_shine[instance.material]) shading.emitting.push_back(i);
        add(shading.bounds, instance);
    }
    return shading;
}

void update_shading_scene(ShadingScene& shading, const PosePlan& plan, const RayScene& rays) {
    const ScenePose& pose = *shading.pose;
    if (rays.anchor() != shading.anchor) {
        shading = make_shading_scene(*shading.scene, pose, rays, *shading.textures);
        return;
    }
    if (!shading.still_bounds) {
        SceneBounds still;
        std::vector<bool> changes(shading.instances.size());
        for (const int i : plan.instances) changes[i] = true;
        for (std::size_t i = 0; i < changes.size(); ++i) {
            if (!changes[i]) add(still, shading.instances[i]);
        }
        shading.still_bounds = still;
    }
    set_surroundings(shading);
    for (const int i : plan.materials) shading.materials[i] = make_material(*shading.scene, pose, i);
    shading.bounds = *shading.still_bounds;
    for (const int i : plan.instances) {
        PosedInstance& instance = shading.instances[i];
        instance = make_instance(shading, rays, i);
        add(shading.bounds, instance);
    }
}

Rgb environment_radiance(const ShadingScene& shading, const glm::vec3& direction) {
    if (shading.environment_map == nullptr) return shading.environment;
    // Transposed: its inverse, since it is a rotation.
    return shading.environment * look_up(*shading.environment_map, direction * shading.environment_rotation);
}

namespace {

/// @param sees_front  whether the front is seen, from its unit normal
/// @param fallback    unit normal of a triangle without area
template <class SeesFront>
SurfacePoint make_point(const ShadingScene& shading, const Hit& hit, const SeesFront& sees_front,
                        const glm::vec3& fallback) {
    const PosedInstance& instance = shading.instances[hit.instance];
    const Mesh& mesh = *instance.mesh;
    const glm::uvec3 t = mesh.triangles[hit.primitive];
    // Rounding can place a hit slightly outside its triangle.
    float u = std::max(hit.u, 0.0f), v = std::max(hit.v, 0.0f);
    if (const float sum = u + v; sum > 1.0f) {
        u /= sum;
        v /= sum;
    }
    SurfacePoint point;
    point.material = instance.material;
    const glm::vec3 p0 = instance.corner(t.x), e1 = instance.corner(t.y) - p0, e2 = instance.corner(t.z) - p0;
    const glm::vec3 local = p0 + e1 * u + e2 * v;
    point.position = instance.linear * local + instance.translation;
    // normal_matrix keeps outward normals outward, under reflections too.
    glm::vec3 geometric = instance.normals * glm::cross(e1, e2);
    const float length = glm::length(geometric);
    geometric = length > 0.0f ? geometric / length : fallback;
    point.front = sees_front(geometric);
    point.geometric = point.front ? geometric : -geometric;
    point.offset = offset_scale * rounding_bound(instance, p0, e1, e2, point.position, geometric);
    point.normal = point.geometric;
    if (const std::vector<glm::vec3>& normals = instance.vertex_normals(); !normals.empty()) {
        const glm::vec3 n = instance.normals * interpolate(normals, t, u, v);
        const float n_length = glm::length(n);
        if (n_length > 0.0f && std::isfinite(n_length)) {
            glm::vec3 shading_normal = n / n_length;
            if (!point.front) shading_normal = -shading_normal;
            // With an interpolated normal on the other side of the surface, light would leak through it.
            if (glm::dot(shading_normal, point.geometric) > 0.0f) point.normal = shading_normal;
        }
    }
    add_texture_coordinates(instance, t, e1, e2, u, v, point);
    if (!mesh.colors.empty()) point.color = interpolate(mesh.colors, t, u, v);
    return point;
}

}  // namespace

SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction) {
    const auto sees_front = [&](const glm::vec3& normal) { return glm::dot(normal, direction) < 0.0f; };
    return make_point(shading, hit, sees_front, -direction / glm::length(direction));
}

SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, bool front) {
    return make_point(shading, hit, [front](const glm::vec3&) { return front; }, {0.0f, 1.0f, 0.0f});
}

}  // namespace aleph
