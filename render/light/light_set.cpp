// The lights of a posed scene, gathered from its surfaces, its lamps and what surrounds it.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

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

/// @param shape  its triangles are in the order of their sides
void add_sides(EmitterShape& shape) {
    int last = no_index;
    for (std::size_t i = 0; i < shape.triangles.size(); ++i) {
        const Emitter::Triangle& t = shape.triangles[i];
        const glm::vec4 plane(t.normal, glm::dot(t.normal, t.corner - shape.center));
        const float begin = i == 0 ? 0.0f : shape.cumulative[i - 1];
        if (const int side = find_side(t); side != last) {
            shape.sides.push_back({plane, plane, begin});
            last = side;
        }
        Emitter::Side& side = shape.sides.back();
        side.low = glm::min(side.low, plane);
        side.high = glm::max(side.high, plane);
        side.end = shape.cumulative[i];
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
bool place_triangles(const PosedInstance& instance, EmitterShape& shape) {
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
    const bool has_sides = !shape.origin.double_sided && placed.size() > max_spherical_triangles;
    if (!has_sides) {
        shape.triangles = std::move(placed);
        return false;
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    shape.triangles.resize(placed.size());
    for (const Emitter::Triangle& triangle : placed) shape.triangles[ends[find_side(triangle)]++] = triangle;
    return true;
}

/// Cells of all lamps together.
constexpr std::size_t most_cells = 1 << 16;

/// The even scale of an instance that is turned, scaled and placed; 0 if its transform does more than that, or scales
/// so much that areas may not be numbers in one of the two coordinates.
float find_even_scale(const PosedInstance& instance) {
    constexpr float rounding = 2e-6f;
    const glm::mat3 squares = glm::transpose(instance.linear) * instance.linear;
    const float square = squares[0][0];
    float most = 0.0f;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(squares[i][k] - (i == k ? square : 0.0f)));
    const bool keeps_sides = glm::dot(instance.linear[0], instance.normals[0]) > 0.0f;
    const bool is_moderate = square > 1e-12f && square < 1e12f;
    return most <= rounding * square && is_moderate && keeps_sides ? std::sqrt(square) : 0.0f;
}

/// @param most_cells  of a lamp with a texture or alpha
EmitterOrigin find_origin(const ShadingScene& shading, const PosedInstance& instance, const Emitter& emitter,
                          std::size_t most_cells) {
    EmitterOrigin origin;
    origin.mesh = instance.deformed == nullptr ? instance.mesh : nullptr;
    origin.double_sided = emitter.double_sided;
    if (emitter.textured || emitter.has_alpha) {
        origin.material = instance.material;
        origin.emission = emitter.radiance;
        origin.alpha = shading.materials[instance.material].values.alpha;
        origin.most_cells = most_cells;
    }
    if (emitter.turn == glm::mat3(1.0f)) {
        origin.linear = instance.linear;
        origin.normals = instance.normals;
    }
    return origin;
}

EmitterShape make_shape(const ShadingScene& shading, const PosedInstance& instance, const EmitterOrigin& origin,
                        const Emitter& emitter, KeptTexels& kept) {
    EmitterShape shape;
    shape.origin = origin;
    PosedInstance own = instance;
    own.linear = origin.linear;
    own.normals = origin.normals;
    own.translation = glm::vec3(0.0f);
    const bool has_sides = place_triangles(own, shape);
    measure(shape);
    if (origin.material != no_index && !shape.triangles.empty()) divide_by_emission(shading, emitter, kept, shape);
    if (has_sides) add_sides(shape);
    return shape;
}

/// An emitter in its place, without a shape.
Emitter place_emitter(const ShadingScene& shading, int index) {
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
    emitter.translation = instance.translation;
    if (const float scale = find_even_scale(instance); scale > 0.0f) {
        emitter.scale = scale;
        emitter.turn = instance.linear;
    }
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

void measure(EmitterShape& shape) {
    double area = 0.0, end = 0.0;
    for (const Emitter::Triangle& t : shape.triangles) {
        area += area_of(t);
        shape.center += (t.corner + (t.edge1 + t.edge2) / 3.0f) / static_cast<float>(shape.triangles.size());
        shape.cos_cone = std::min(shape.cos_cone, glm::dot(t.normal, shape.triangles.front().normal));
    }
    shape.area = static_cast<float>(area);
    shape.cumulative.reserve(shape.triangles.size());
    for (const Emitter::Triangle& t : shape.triangles) {
        shape.cumulative.push_back(static_cast<float>((end += area_of(t)) / area));
        for (const glm::vec3& corner : {t.corner, t.corner + t.edge1, t.corner + t.edge2})
            shape.radius = std::max(shape.radius, glm::length(corner - shape.center));
    }
}

void set_shape(std::shared_ptr<const EmitterShape> shape, Emitter& emitter) {
    emitter.area = shape->area * emitter.scale * emitter.scale;
    emitter.center = emitter.turn * shape->center + emitter.translation;
    emitter.radius = shape->radius * emitter.scale;
    emitter.shape = std::move(shape);
}

LightSet make_light_set(const ShadingScene& shading, LightSet before) {
    LightSet lights;
    lights.kept = std::move(before.kept);
    before.emitter_of_instance.resize(shading.instances.size(), no_index);
    lights.emitter_of_instance.assign(shading.instances.size(), no_index);
    const auto divided = std::ranges::count_if(shading.emitting, [&](int i) {
        const ShadingMaterial& material = shading.materials[shading.instances[i].material];
        return is_textured(material) || has_alpha(material);
    });
    const std::size_t cells = most_cells / static_cast<std::size_t>(std::max<std::ptrdiff_t>(divided, 1));
    std::unordered_map<const Mesh*, std::shared_ptr<const EmitterShape>> shapes;
    for (const int i : shading.emitting) {
        const PosedInstance& instance = shading.instances[i];
        if (!instance.visible || !shading.materials[instance.material].emits) continue;
        Emitter emitter = place_emitter(shading, i);
        const EmitterOrigin origin = find_origin(shading, instance, emitter, cells);
        const int known = before.emitter_of_instance[i];
        std::shared_ptr<const EmitterShape> shape = known >= 0 ? before.emitters[known].shape : shapes[origin.mesh];
        if (shape == nullptr || origin.mesh == nullptr || !(shape->origin == origin))
            shape = std::make_shared<EmitterShape>(make_shape(shading, instance, origin, emitter, lights.kept));
        if (origin.linear == glm::mat3(1.0f)) shapes[origin.mesh] = shape;
        if (shape->triangles.empty()) continue;
        set_shape(std::move(shape), emitter);
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
