#include "render/surface/shading_scene.h"

#include <algorithm>

#include "engine/scene/transforms.h"
#include "render/surface/environment_map.h"
#include "render/surface/texture.h"

namespace aleph {

namespace {

/// An upper bound of how much longer a transform makes a vector; exact where its columns are orthogonal.
float find_scale(const glm::mat3& linear) {
    const glm::mat3 squares = glm::transpose(linear) * linear;
    float most = 0.0f;
    for (int i = 0; i < 3; ++i) most = std::max(most, glm::dot(glm::abs(squares[i]), glm::vec3(1.0f)));
    return std::sqrt(most);
}

/// What stands still is looked at once, vertex by vertex.
void add(BoundingBox& box, const PosedInstance& instance) {
    if (!instance.visible) return;
    if (instance.flat) {
        for (std::uint32_t v = 0; v < instance.mesh->positions.size(); ++v) box.add(instance.place(v));
    } else if (const BoundingBox own = find_bounds(instance).box; !own.empty()) {
        box.add(own.low);
        box.add(own.high);
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
    posed.bounds = &rays.bounds(instance.mesh);
    posed.flat = rays.is_flat(i);
    if (posed.flat) posed.flat_origin = glm::vec3(rays.flat_origin() - shading.anchor);
    const PosedMesh& deformed = pose.meshes[instance.mesh];
    if (!deformed.positions.empty()) posed.deformed = &deformed;
    posed.normals = glm::mat3(normal_matrix(world)) * (deformed.mirrored ? -1.0f : 1.0f);
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
    for (int i = 0; i <= std::ssize(scene.materials); ++i) shading.materials.push_back(make_material(shading, i));
    shading.instances.reserve(pose.instances.size());
    for (int i = 0; i < std::ssize(pose.instances); ++i) {
        shading.instances.push_back(make_instance(shading, rays, i));
        const PosedInstance& instance = shading.instances.back();
        const Material* material = shading.materials[instance.material].material;
        if (material != nullptr && can_emit(*material)) shading.emitting.push_back(i);
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
        BoundingBox still;
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

MeshBounds find_bounds(const PosedInstance& instance) {
    if (instance.deformed != nullptr) {
        std::vector<glm::vec3> places;
        places.reserve(instance.mesh->positions.size());
        for (std::uint32_t v = 0; v < instance.mesh->positions.size(); ++v) places.push_back(instance.place(v));
        return find_bounds(places, instance.mesh->triangles);
    }
    MeshBounds bounds;
    const MeshBounds& own = *instance.bounds;
    const float scale = find_scale(instance.linear);
    bounds.sphere = {instance.linear * own.sphere.center + instance.translation, scale * own.sphere.radius};
    if (own.box.empty()) return bounds;
    for (int k = 0; k < 8; ++k) bounds.box.add(instance.linear * own.box.corner(k) + instance.translation);
    bounds.box.low = glm::max(bounds.box.low, bounds.sphere.center - bounds.sphere.radius);
    bounds.box.high = glm::min(bounds.box.high, bounds.sphere.center + bounds.sphere.radius);
    // A triangle grows by two of the three scales: by no less than all of them over the largest.
    if (scale > 0.0f) bounds.area = own.area * std::abs(glm::determinant(instance.linear)) / scale;
    return bounds;
}

Rgb environment_radiance(const ShadingScene& shading, const glm::vec3& direction) {
    if (shading.environment.map == nullptr) return shading.environment.radiance;
    // Transposed: its inverse, since it is a rotation.
    return shading.environment.radiance * look_up(*shading.environment.map, direction * shading.environment.rotation);
}

}  // namespace aleph
