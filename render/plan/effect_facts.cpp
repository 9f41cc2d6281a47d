#include "render/plan/effect_facts.h"

#include <algorithm>

#include "engine/base/parallel.h"
#include "engine/scene/transforms.h"
#include "render/plan/effect_bounds.h"
#include "render/surface/microfacets.h"

namespace aleph {

namespace {

constexpr double margin = 2.0;  // pixels around the picture that its filter may reach

/// The largest value of each channel that a use of the texture reads; 1 without a texture.
glm::vec3 largest_texel(const TextureSet& set, const TextureUse& use) {
    return use.texture == no_index ? glm::vec3(1.0f) : set.textures[use.texture].largest;
}

float smallest_green(const TextureSet& set, const TextureUse& use) {
    return use.texture == no_index ? 1.0f : set.textures[use.texture].smallest.y;
}

/// @param has_base  some of it is neither metal nor glass
void add_layers(const MaterialValues& values, const MaterialTextures& textures, const TextureSet& set, bool has_base,
                MaterialFacts& facts) {
    const auto add_lobe = [&](float reflectance, float least, float most) {
        facts.reflectance = std::max(facts.reflectance, std::min(reflectance, 1.0f));
        if (least * least < min_ggx_alpha) facts.mirror = true;
        if (most * most < min_ggx_alpha) return;
        facts.glossy = true;
        facts.least_width = std::min(facts.least_width, std::max(least * least, min_ggx_alpha));
    };
    const TextureUse& gloss = textures[TextureSlot::metallic_roughness];
    const bool stretched = values.layers.anisotropy > 0.0f;
    const float roughest = stretched ? 1.0f : values.gloss.roughness * largest_texel(set, gloss).y;
    const float metallic = values.gloss.metallic * largest_texel(set, gloss).z;
    const float dielectric = has_base ? values.gloss.specular : 0.0f;
    if (metallic > 0.0f || dielectric > 0.0f) {
        add_lobe(std::max(metallic, dielectric), values.gloss.roughness * smallest_green(set, gloss), roughest);
    }
    if (values.layers.clearcoat > 0.0f) {
        const TextureUse& coat = textures[TextureSlot::clearcoat_roughness];
        const float roughness = values.layers.clearcoat_roughness;
        add_lobe(values.layers.clearcoat, roughness * smallest_green(set, coat),
                 roughness * largest_texel(set, coat).y);
    }
    if (values.layers.sheen_color != Rgb(0.0f)) add_lobe(largest_channel(values.layers.sheen_color), 1.0f, 1.0f);
    facts.glass = values.glass.transmission > 0.0f && values.gloss.metallic < 1.0f;
    facts.volume = facts.glass && values.glass.thickness > 0.0f;
    facts.rough_glass = facts.glass && roughest * roughest >= min_ggx_alpha;
}

bool has_texture(const MaterialTextures& textures) {
    return std::ranges::any_of(material_textures, [&](const MaterialTexture& texture) {
        return !is_normal_map(texture.slot) && textures[texture.slot].texture != no_index;
    });
}

/// @param color  largest vertex colour
MaterialFacts find_material_facts(const Material* material, const MaterialValues& values,
                                  const MaterialTextures& textures, const TextureSet& set, float color) {
    MaterialFacts facts;
    facts.textured = has_texture(textures);
    facts.maps_normals = textures.maps_normals;
    const float base =
        largest_channel(values.base_color * largest_texel(set, textures[TextureSlot::base_color])) * color;
    if (material != nullptr) {
        facts.alpha = material->opacity.mode != Opacity::Mode::opaque;
        facts.unlit = material->unlit;
        if (facts.unlit) {
            facts.radiance = base;
            return facts;
        }
        facts.radiance = largest_channel(
            values.emission * glm::max(largest_texel(set, textures[TextureSlot::emission]), glm::vec3(0.0f)));
    }
    const bool pure_metal =
        values.gloss.metallic >= 1.0f && textures[TextureSlot::metallic_roughness].texture == no_index;
    const bool pure_glass =
        values.glass.transmission >= 1.0f && textures[TextureSlot::transmission].texture == no_index;
    const bool has_base = !pure_metal && !pure_glass;
    if (has_base) facts.diffuse = base;
    add_layers(values, textures, set, has_base, facts);
    return facts;
}

MeshFacts find_mesh_facts(const Mesh& mesh) {
    MeshFacts facts;
    for (const glm::vec3& p : mesh.positions) facts.bounds.add(glm::dvec3(p));
    for (const glm::vec4& c : mesh.colors) facts.color = std::max(facts.color, largest_channel(glm::vec3(c)));
    facts.shape = find_convex(mesh);
    return facts;
}

/// True if a box may be in the picture.
bool is_in_view(const CameraView& view, const Bounds& box) {
    // Planes through the camera, and that of the camera: outside if all corners are beyond one of them.
    int left = 0, right = 0, above = 0, below = 0, behind = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p = to_camera(view, box.corner(i));
        const double depth = view.orthographic ? 1.0 : -p.z;
        const glm::dvec2 first = unproject_pixel(view, -margin, -margin) * depth;
        const glm::dvec2 last = unproject_pixel(view, view.width + margin, view.height + margin) * depth;
        left += p.x < first.x ? 1 : 0;
        right += p.x > last.x ? 1 : 0;
        above += p.y > first.y ? 1 : 0;
        below += p.y < last.y ? 1 : 0;
        behind += p.z > 0.0 ? 1 : 0;
    }
    return std::max({left, right, above, below, behind}) < 8;
}

/// True if a ray of the camera may start in a box: all start at one place, or on a plane as wide as the picture.
bool may_start_inside(const CameraView& view, const Bounds& box) {
    if (!view.orthographic) return distance_to(box, view.position) == 0.0;
    int behind = 0;
    for (int i = 0; i < 8; ++i) behind += to_camera(view, box.corner(i)).z > 0.0 ? 1 : 0;
    return behind > 0 && behind < 8 && is_in_view(view, box);
}

Bounds find_world_bounds(const MeshFacts& mesh, const PosedMesh& posed, const glm::dmat4& world) {
    Bounds own = mesh.bounds;
    if (!posed.positions.empty()) {
        own = {};
        for (const glm::dvec3& p : posed.positions) own.add(p);
    }
    Bounds bounds;
    own.add_corners_to(bounds, world);
    return bounds;
}

void add_lights(const Scene& scene, const ShotFacts& shot, const ScenePose& pose, FrameFacts& facts) {
    for (std::size_t i = 0; i < facts.objects.size(); ++i) {
        const ObjectFacts& object = facts.objects[i];
        if (!(object.material.radiance > 0.0f) || object.material.unlit) continue;
        const glm::dvec3 center = 0.5 * (object.bounds.low + object.bounds.high);
        facts.lights.push_back({LightFacts::Kind::surface, static_cast<int>(i), object.instance, center,
                                glm::length(object.bounds.high - center), glm::dvec3(0.0), object.material.radiance});
    }
    for (std::size_t i = 0; i < pose.lights.size(); ++i) {
        const LightValues& light = pose.lights[i];
        if (light.intensity == Rgb(0.0f)) continue;
        const bool far = light.kind == Light::Kind::directional;
        facts.lights.push_back({far ? LightFacts::Kind::directional : LightFacts::Kind::point, no_index,
                                static_cast<int>(i), light.position, 0.0, light.direction,
                                largest_channel(light.intensity), light.range});
    }
    const float radiance = scene.environment.radiance ? largest_channel(pose.environment) * shot.environment : 0.0f;
    if (radiance > 0.0f) {
        facts.lights.push_back(
            {LightFacts::Kind::surroundings, no_index, 0, glm::dvec3(0.0), 0.0, glm::dvec3(0.0), radiance});
    }
}

}  // namespace

ShotFacts find_shot_facts(const Scene& scene, const TextureSet& textures, const PosePlan& plan) {
    ShotFacts facts;
    facts.meshes.resize(scene.meshes.size());
    parallel_for(scene.meshes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) facts.meshes[i] = find_mesh_facts(scene.meshes[i]);
    });
    for (const Deformer& deformer : plan.deformers) facts.meshes[deformer.mesh].deforms = deformer.changes;
    facts.environment = 1.0f;
    if (textures.environment.empty()) return facts;
    facts.environment = 0.0f;
    for (const Rgb& texel : textures.environment.texels.pixels) {
        facts.environment = std::max(facts.environment, largest_channel(texel));
    }
    return facts;
}

FrameFacts find_frame_facts(const Scene& scene, const ShotFacts& shot, const TextureSet& textures,
                            const ScenePose& pose, const CameraView& view, bool all_in_view) {
    FrameFacts facts;
    for (std::size_t i = 0; i < pose.instances.size(); ++i) {
        if (pose.shown[i] == 0) continue;
        const auto [node, m] = pose.instances[i];
        const Mesh& mesh = scene.meshes[m];
        const MeshFacts& known = shot.meshes[m];
        ObjectFacts object;
        object.instance = static_cast<int>(i);
        object.mesh = m;
        object.deforms = known.deforms;
        object.bounds = find_world_bounds(known, pose.meshes[m], pose.world[node]);
        if (object.bounds.empty()) continue;
        const bool named = mesh.material != no_index;
        object.material = find_material_facts(
            named ? &scene.materials[mesh.material] : nullptr, named ? pose.materials[mesh.material] : MaterialValues(),
            named ? textures.materials[mesh.material] : textures.materials.back(), textures, known.color);
        object.in_view = all_in_view || is_in_view(view, object.bounds);
        if (pose.meshes[m].positions.empty()) {
            // Seen from inside, a closed body sees itself.
            const ConvexMesh& shape = known.shape;
            object.convex = shape.flat || (shape.convex && !all_in_view && !may_start_inside(view, object.bounds));
            object.flat = shape.flat;
            object.point = glm::dvec3(pose.world[node] * glm::dvec4(shape.point, 1.0));
            object.normal =
                shape.flat ? glm::normalize(normal_matrix(pose.world[node]) * shape.normal) : glm::dvec3(0.0);
        }
        facts.sees_all = facts.sees_all || (object.in_view && object.material.has_specular());
        facts.objects.push_back(object);
    }
    add_lights(scene, shot, pose, facts);
    bound_direct_light(facts);
    return facts;
}

}  // namespace aleph
