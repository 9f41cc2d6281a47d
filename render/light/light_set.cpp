// The lights of a posed scene, gathered from its surfaces, its lamps and what surrounds it.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "render/light/lights.h"
#include "render/surface/environment_map.h"
#include "render/surface/texture.h"

namespace aleph {

namespace {

float versine(double angle) {
    const double s = std::sin(0.5 * angle);
    return static_cast<float>(2.0 * s * s);
}

constexpr std::size_t sides_of_lamp = 24;

/// One of sides_of_lamp: the normal's longest component, and the signs of all.
int find_side(const Emitter::Triangle& triangle) {
    const glm::vec3 n = triangle.normal, size = glm::abs(n);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return axis * 8 + (n.x < 0.0f ? 4 : 0) + (n.y < 0.0f ? 2 : 0) + (n.z < 0.0f ? 1 : 0);
}

/// @param emitter  its triangles are in the order of their sides
void add_sides(Emitter& emitter) {
    int last = no_index;
    for (std::size_t i = 0; i < emitter.triangles.size(); ++i) {
        const Emitter::Triangle& t = emitter.triangles[i];
        const glm::vec4 plane(t.normal, glm::dot(t.normal, t.corner - emitter.center));
        const float begin = i == 0 ? 0.0f : emitter.cumulative[i - 1];
        if (const int side = find_side(t); side != last) {
            emitter.sides.push_back({plane, plane, begin});
            last = side;
        }
        Emitter::Side& side = emitter.sides.back();
        side.low = glm::min(side.low, plane);
        side.high = glm::max(side.high, plane);
        side.end = emitter.cumulative[i];
    }
}

bool is_textured(const ShadingMaterial& material) {
    return material.material != nullptr && material.material->textures[TextureSlot::emission].image != no_index;
}

bool has_alpha(const ShadingMaterial& material) {
    return material.material != nullptr && material.material->opacity.mode != Opacity::Mode::opaque;
}

/// Places the triangles that have an area. Of a lamp with one side and more than a few triangles, they are in the order
/// of the sides that they face.
/// @return whether they are
bool place_triangles(const PosedInstance& instance, Emitter& emitter) {
    const std::size_t count = instance.mesh->triangles.size();
    std::vector<Emitter::Triangle> placed;
    placed.reserve(count);
    std::array<std::size_t, sides_of_lamp + 1> ends{};
    for (std::size_t i = 0; i < count; ++i) {
        const Emitter::Triangle triangle = place_triangle(instance, static_cast<int>(i));
        if (!(area_of(triangle) > 0.0) || !std::isfinite(triangle.normal.x)) continue;
        placed.push_back(triangle);
        ++ends[find_side(triangle) + 1];
    }
    const bool has_sides = !emitter.double_sided && placed.size() > max_spherical_triangles;
    if (!has_sides) {
        emitter.triangles = std::move(placed);
        return false;
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    emitter.triangles.resize(placed.size());
    for (const Emitter::Triangle& triangle : placed) emitter.triangles[ends[find_side(triangle)]++] = triangle;
    return true;
}

/// Cells of all lamps together.
constexpr std::size_t most_cells = 1 << 16;

/// @param cells, kept  divide_by_emission
Emitter make_emitter(const ShadingScene& shading, int index, std::size_t cells, KeptTexels& kept) {
    const PosedInstance& instance = shading.instances[index];
    const ShadingMaterial& material = shading.materials[instance.material];
    Emitter emitter;
    emitter.instance = index;
    emitter.double_sided = material.double_sided;
    emitter.textured = is_textured(material);
    emitter.has_alpha = has_alpha(material);
    emitter.radiance = emitter.brightest = material.values.emission;
    if (const int texture = shading.textures->materials[instance.material][TextureSlot::emission].texture;
        texture != no_index) {
        emitter.brightest *= glm::max(shading.textures->textures[texture].largest, 1.0f);
    }
    const bool has_sides = place_triangles(instance, emitter);
    double area = 0.0, end = 0.0;
    for (const Emitter::Triangle& triangle : emitter.triangles) area += area_of(triangle);
    emitter.area = static_cast<float>(area);
    set_sphere(emitter);
    emitter.cumulative.reserve(emitter.triangles.size());
    for (const Emitter::Triangle& triangle : emitter.triangles)
        emitter.cumulative.push_back(static_cast<float>((end += area_of(triangle)) / area));
    if ((emitter.textured || emitter.has_alpha) && !emitter.triangles.empty())
        divide_by_emission(shading, cells, kept, emitter);
    if (has_sides) add_sides(emitter);
    return emitter;
}

/// @param i  into ScenePose::lights
void add_punctual(const ShadingScene& shading, std::size_t i, LightSet& lights) {
    const LightValues& light = shading.pose->lights[i];
    if (light.intensity == Rgb(0.0f)) return;
    lights.punctual.push_back({static_cast<int>(i), light.kind, glm::vec3(light.position - shading.anchor),
                               glm::vec3(light.direction), light.intensity, static_cast<float>(light.range),
                               versine(light.inner_cone), versine(light.outer_cone)});
}

/// Computes what depends on all lights.
void finish(const ShadingScene& shading, LightSet& lights) {
    lights.bounds = make_light_bounds(shading, lights);
    lights.tree = make_light_tree(make_light_nodes(shading, lights));
}

}  // namespace

Emitter::Triangle place_triangle(const PosedInstance& instance, int primitive) {
    const glm::uvec3 t = instance.mesh->triangles[static_cast<std::size_t>(primitive)];
    const glm::vec3 p0 = instance.corner(t.x), e1 = instance.corner(t.y) - p0, e2 = instance.corner(t.z) - p0;
    const glm::vec3 normal = instance.normals * glm::cross(e1, e2);
    return {instance.linear * p0 + instance.translation, instance.linear * e1, instance.linear * e2,
            normal / glm::length(normal), primitive};
}

double area_of(const Emitter::Triangle& triangle) {
    return 0.5 * glm::length(glm::dvec3(glm::cross(triangle.edge1, triangle.edge2)));
}

void set_sphere(Emitter& emitter) {
    for (const Emitter::Triangle& t : emitter.triangles) {
        emitter.center += (t.corner + (t.edge1 + t.edge2) / 3.0f) / static_cast<float>(emitter.triangles.size());
    }
    for (const Emitter::Triangle& t : emitter.triangles) {
        for (const glm::vec3& corner : {t.corner, t.corner + t.edge1, t.corner + t.edge2}) {
            emitter.radius = std::max(emitter.radius, glm::length(corner - emitter.center));
        }
    }
}

LightSet make_light_set(const ShadingScene& shading, KeptTexels kept) {
    LightSet lights;
    lights.kept = std::move(kept);
    lights.emitter_of_instance.assign(shading.instances.size(), no_index);
    const auto divided = std::ranges::count_if(shading.emitting, [&](int i) {
        const ShadingMaterial& material = shading.materials[shading.instances[i].material];
        return is_textured(material) || has_alpha(material);
    });
    const std::size_t cells = most_cells / static_cast<std::size_t>(std::max<std::ptrdiff_t>(divided, 1));
    for (const int i : shading.emitting) {
        const PosedInstance& instance = shading.instances[i];
        const ShadingMaterial& material = shading.materials[instance.material];
        if (!instance.visible || !material.emits) continue;
        Emitter emitter = make_emitter(shading, i, cells, lights.kept);
        if (emitter.triangles.empty()) continue;
        lights.emitter_of_instance[i] = static_cast<int>(lights.emitters.size());
        lights.emitters.push_back(std::move(emitter));
    }
    for (std::size_t i = 0; i < shading.pose->lights.size(); ++i) add_punctual(shading, i, lights);
    lights.has_environment = shading.environment.radiance != Rgb(0.0f) &&
                             (shading.environment.map == nullptr || !shading.environment.map->black);
    finish(shading, lights);
    return lights;
}

void remove_all_lights(LightSet& lights) {
    LightSet none;
    none.emitter_of_instance.assign(lights.emitter_of_instance.size(), no_index);
    none.kept = std::move(lights.kept);
    lights = std::move(none);
}

void remove_lights(const ShadingScene& shading, const std::vector<int>& instances, const std::vector<int>& punctual,
                   LightSet& lights) {
    for (const int instance : instances) lights.emitter_of_instance[instance] = left_out_emitter;
    const auto is_left = [&](int i) { return lights.emitter_of_instance[i] == left_out_emitter; };
    std::erase_if(lights.emitters, [&](const Emitter& emitter) { return is_left(emitter.instance); });
    for (std::size_t i = 0; i < lights.emitters.size(); ++i) {
        lights.emitter_of_instance[lights.emitters[i].instance] = static_cast<int>(i);
    }
    lights.punctual.clear();
    for (std::size_t i = 0; i < shading.pose->lights.size(); ++i) {
        if (std::ranges::find(punctual, static_cast<int>(i)) == punctual.end()) add_punctual(shading, i, lights);
    }
    finish(shading, lights);
}

}  // namespace aleph
