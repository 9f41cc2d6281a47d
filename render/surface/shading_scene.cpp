#include "render/surface/shading_scene.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/transforms.h"
#include "render/surface/environment_map.h"
#include "render/surface/texture.h"

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
        bounds.low = glm::min(bounds.low, instance.place(v));
        bounds.high = glm::max(bounds.high, instance.place(v));
    }
}

bool can_emit(const Material& material) {
    const auto is_on = [](const auto& track, const auto& zero) {
        return is_animated(track) || !(key_value(track, 0) == zero);
    };
    return !material.unlit && is_on(material.glow.color, glm::dvec3(0.0)) && is_on(material.glow.strength, 0.0);
}

/// @param i  of the default material: one more than the scene's last
ShadingMaterial make_material(const ShadingScene& shading, int i) {
    ShadingMaterial made;
    if (i < std::ssize(shading.scene->materials)) {
        const MaterialValues& values = shading.pose->materials[i];
        const Material& material = shading.scene->materials[i];
        made = {values, &material, material.double_sided, values.emission != Rgb(0.0f) && !material.unlit,
                values.layers.clearcoat > 0.0f || values.layers.sheen_color != Rgb(0.0f) ||
                    values.layers.anisotropy > 0.0f};
    }
    const bool unlit = made.material != nullptr && made.material->unlit;
    made.plain_lambert = made.values.gloss.specular == 0.0f && made.values.gloss.metallic == 0.0f &&
                         made.values.glass.transmission == 0.0f && !made.layered && !unlit &&
                         !shading.textures->materials[i].maps_normals;
    return made;
}

/// Sets what the pose says of the whole scene's light.
void set_surroundings(ShadingScene& shading) {
    const ScenePose& pose = *shading.pose;
    shading.environment.radiance = pose.environment;
    shading.environment.rotation = glm::mat3(pose.environment_rotation);
    shading.has_thin_glass = shading.has_volumes = false;
    for (std::size_t i = 0; i < pose.materials.size(); ++i) {
        const MaterialValues& values = pose.materials[i];
        if (!(values.glass.transmission > 0.0f)) continue;
        const bool volume = values.glass.thickness > 0.0f;
        shading.has_volumes |= volume;
        // Texels of 0 are thin.
        shading.has_thin_glass |= !volume || shading.textures->materials[i][TextureSlot::thickness].texture != no_index;
    }
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
    posed.visible = pose.shown[i] != 0 && is_traceable(world) && are_traceable(deformed.positions);
    if (posed.visible) posed.rounding = abs_of(posed.linear) * abs_of(glm::mat3(glm::inverse(glm::dmat3(world))));
    return posed;
}

}  // namespace

ShadingScene make_shading_scene(const Scene& scene, const ScenePose& pose, const RayScene& rays,
                                const TextureSet& textures) {
    ShadingScene shading;
    shading.scene = &scene;
    shading.pose = &pose;
    shading.textures = &textures;
    shading.anchor = rays.anchor();
    if (!textures.environment.empty()) shading.environment.map = &textures.environment;
    set_surroundings(shading);
    std::vector<bool> can_shine;
    for (int i = 0; i < std::ssize(scene.materials); ++i) {
        shading.materials.push_back(make_material(shading, i));
        can_shine.push_back(can_emit(scene.materials[i]));
    }
    shading.materials.push_back(make_material(shading, static_cast<int>(scene.materials.size())));
    can_shine.push_back(false);
    shading.instances.reserve(pose.instances.size());
    for (int i = 0; i < std::ssize(pose.instances); ++i) {
        shading.instances.push_back(make_instance(shading, rays, i));
        const PosedInstance& instance = shading.instances.back();
        if (can_shine[instance.material]) shading.emitting.push_back(i);
        add(shading.bounds.all, instance);
    }
    return shading;
}

void update_shading_scene(ShadingScene& shading, const PosePlan& plan, const RayScene& rays) {
    const ScenePose& pose = *shading.pose;
    if (rays.anchor() != shading.anchor) {
        shading = make_shading_scene(*shading.scene, pose, rays, *shading.textures);
        return;
    }
    if (!shading.bounds.still) {
        SceneBounds still;
        std::vector<bool> changes(shading.instances.size());
        for (const int i : plan.instances) changes[i] = true;
        for (std::size_t i = 0; i < changes.size(); ++i) {
            if (!changes[i]) add(still, shading.instances[i]);
        }
        shading.bounds.still = still;
    }
    set_surroundings(shading);
    for (const int i : plan.materials) shading.materials[i] = make_material(shading, i);
    shading.bounds.all = *shading.bounds.still;
    for (const int i : plan.instances) {
        PosedInstance& instance = shading.instances[i];
        instance = make_instance(shading, rays, i);
        add(shading.bounds.all, instance);
    }
}

BoundingSphere find_sphere(const PosedInstance& instance) {
    SceneBounds box;
    add(box, instance);
    BoundingSphere sphere{0.5f * (box.low + box.high)};
    for (std::uint32_t v = 0; v < instance.mesh->positions.size(); ++v) {
        sphere.radius = std::max(sphere.radius, glm::length(instance.place(v) - sphere.center));
    }
    return sphere;
}

Rgb environment_radiance(const ShadingScene& shading, const glm::vec3& direction) {
    if (shading.environment.map == nullptr) return shading.environment.radiance;
    // Transposed: its inverse, since it is a rotation.
    return shading.environment.radiance * look_up(*shading.environment.map, direction * shading.environment.rotation);
}

namespace {

/// The triangle that a hit is on.
struct HitTriangle {
    const PosedInstance& instance;
    glm::uvec3 t;  ///< its vertices
    /// Barycentrics, within the triangle: rounding can place a hit slightly outside.
    float u, v;
    glm::vec3 p0, e1, e2;  ///< object space, m: a corner and the edges from it
};

HitTriangle find_triangle(const ShadingScene& shading, const Hit& hit) {
    const PosedInstance& instance = shading.instances[hit.instance];
    const glm::uvec3 t = instance.mesh->triangles[hit.primitive];
    float u = std::max(hit.u, 0.0f), v = std::max(hit.v, 0.0f);
    if (const float sum = u + v; sum > 1.0f) {
        u /= sum;
        v /= sum;
    }
    const glm::vec3 p0 = instance.corner(t.x);
    return {instance, t, u, v, p0, instance.corner(t.y) - p0, instance.corner(t.z) - p0};
}

constexpr float near_edge = 1e-3f;  // barycentric: only points this close to an edge are looked at

/// Moves a point off the edges of its triangle, by more than rounding. Where two walls meet in an edge, a point exactly
/// on it would lie in both, and see nothing but the other wall at distance 0.
void move_off_edges(const HitTriangle& triangle, SurfacePlace& place) {
    if (std::min({triangle.u, triangle.v, 1.0f - triangle.u - triangle.v}) >= near_edge) return;
    constexpr float most = 0.125f;  // of a triangle too thin to have points so far from its edges
    const PosedInstance& instance = triangle.instance;
    const glm::vec3 e1 = instance.linear * triangle.e1, e2 = instance.linear * triangle.e2;
    const float area2 = glm::length(glm::cross(e1, e2));
    if (!(area2 > 0.0f)) return;
    const glm::vec3 coordinates = glm::abs(place.position);
    const float distance = place.offset + offset_scale * std::max({coordinates.x, coordinates.y, coordinates.z});
    const glm::vec3 sides(glm::length(e2 - e1), glm::length(e2), glm::length(e1));
    const glm::vec3 weights(1.0f - triangle.u - triangle.v, triangle.u, triangle.v);
    glm::vec3 moved = glm::max(weights, glm::min(sides * (distance / area2), most));
    if (moved == weights) return;
    moved /= moved.x + moved.y + moved.z;
    place.position =
        instance.linear * (triangle.p0 + triangle.e1 * moved.y + triangle.e2 * moved.z) + instance.translation;
}

/// The side of a surface that a ray meets.
struct SeenAlong {
    const glm::vec3& direction;
    bool sees_front(const glm::vec3& normal) const { return glm::dot(normal, direction) < 0.0f; }
    /// Unit normal of a triangle without area.
    glm::vec3 fallback() const { return -direction / glm::length(direction); }
};

/// A side by itself.
struct SeenFrom {
    bool front;
    bool sees_front(const glm::vec3&) const { return front; }
    glm::vec3 fallback() const { return {0.0f, 1.0f, 0.0f}; }
};

template <class Side>
void set_place(const HitTriangle& triangle, const Side& side, SurfacePlace& place) {
    const auto& [instance, t, u, v, p0, e1, e2] = triangle;
    place.position = instance.linear * (p0 + e1 * u + e2 * v) + instance.translation;
    // normal_matrix keeps outward normals outward, under reflections too.
    glm::vec3 geometric = instance.normals * glm::cross(e1, e2);
    const float length = glm::length(geometric);
    geometric = length > 0.0f ? geometric / length : side.fallback();
    place.front = side.sees_front(geometric);
    place.geometric = place.front ? geometric : -geometric;
    place.offset = offset_scale * rounding_bound(instance, p0, e1, e2, place.position, geometric);
    place.normal = place.geometric;
    const std::vector<glm::vec3>& normals = instance.vertex_normals();
    if (normals.empty()) return;
    const glm::vec3 n = instance.normals * interpolate(normals, t, u, v);
    const float n_length = glm::length(n);
    if (!(n_length > 0.0f && std::isfinite(n_length))) return;
    const glm::vec3 shading_normal = (place.front ? n : -n) / n_length;
    // With an interpolated normal on the other side of the surface, light would leak through it.
    if (glm::dot(shading_normal, place.geometric) > 0.0f) place.normal = shading_normal;
}

void add_texture_coordinates(const HitTriangle& triangle, SurfacePoint& point) {
    const auto& [instance, t, u, v, p0, e1, e2] = triangle;
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

template <class Side>
SurfacePoint make_point(const ShadingScene& shading, const Hit& hit, const Side& side) {
    const HitTriangle triangle = find_triangle(shading, hit);
    const PosedInstance& instance = triangle.instance;
    SurfacePoint point;
    point.material = instance.material;
    set_place(triangle, side, point);
    move_off_edges(triangle, point);
    add_texture_coordinates(triangle, point);
    if (!instance.mesh->colors.empty()) {
        point.color = interpolate(instance.mesh->colors, triangle.t, triangle.u, triangle.v);
    }
    return point;
}

}  // namespace

SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction) {
    return make_point(shading, hit, SeenAlong{direction});
}

SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, bool front) {
    return make_point(shading, hit, SeenFrom{front});
}

SurfacePlace make_surface_place(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction) {
    SurfacePlace place;
    set_place(find_triangle(shading, hit), SeenAlong{direction}, place);
    return place;
}

}  // namespace aleph
