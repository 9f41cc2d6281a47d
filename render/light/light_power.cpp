#include "render/light/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "render/surface/environment_map.h"

namespace aleph {

namespace {

/// A light that is not a number is chosen as any other: what it lights is dropped and counted, not hidden.
float finite_strength(float strength) {
    return std::isfinite(strength) ? strength : 1.0f;
}

/// @param axis  of a flat light that shines on one side
void add_light(LightBounds& bounds, const LightNode& light, const std::optional<glm::vec3>& axis = {}) {
    bounds.x.push_back(light.center.x);
    bounds.y.push_back(light.center.y);
    bounds.z.push_back(light.center.z);
    bounds.nearby.push_back(light.nearby ? 1.0f : 0.0f);
    bounds.radius.push_back(light.radius);
    const glm::vec3 normal = axis.value_or(glm::vec3(0.0f));
    bounds.axis_x.push_back(normal.x);
    bounds.axis_y.push_back(normal.y);
    bounds.axis_z.push_back(normal.z);
    bounds.one_sided.push_back(axis ? 1.0f : 0.0f);
    bounds.strength.push_back(light.strength);
    bounds.inside.push_back(light.radius > 0.0f ? light.strength / (light.radius * light.radius) : 0.0f);
}

/// The normal of a flat light that shines on one side; else nothing.
std::optional<glm::vec3> find_axis(const Emitter& emitter) {
    if (emitter.double_sided || !(emitter.shape->cos_cone > 0.9999f)) return {};
    return emitter.triangle(0).normal;
}

LightNode make_node(const Emitter& emitter) {
    LightNode node;
    node.center = emitter.center;
    node.radius = emitter.radius;
    const float radiance = luminance(emitter.brightest);
    node.strength = finite_strength(radiance * emitter.shape->mean_of_brightest * emitter.area);
    node.most = finite_strength(std::numbers::pi_v<float> * radiance);
    if (emitter.double_sided) return node;
    node.axis = emitter.triangle(0).normal;
    node.cos_cone = emitter.shape->cos_cone;
    node.directed = node.cos_cone > -0.99f;
    return node;
}

LightNode make_node(const PunctualLight& light) {
    LightNode node;
    node.strength = finite_strength(luminance(light.intensity));
    node.nearby = light.kind != Light::Kind::directional;
    node.center = node.nearby ? light.position : -light.direction;
    node.most = node.nearby ? std::numeric_limits<float>::infinity() : node.strength;
    if (light.kind == Light::Kind::spot) {
        node.directed = true;
        node.axis = light.direction;
        node.cos_emission = 1.0f - light.outer_versine;
        node.by_cosine = false;
    }
    return node;
}

/// The environment.
/// @param share  of all its light that a surface can meet
LightNode make_node(const ShadingEnvironment& environment, double share) {
    LightNode node;
    node.nearby = false;
    node.radius = 1.0f;
    const double mean = environment.map != nullptr ? environment.map->mean_luminance : 1.0;
    node.strength =
        finite_strength(static_cast<float>(std::numbers::pi * share * mean * luminance(environment.radiance)));
    node.most = node.strength;
    return node;
}

}  // namespace

LightBounds make_light_bounds(const ShadingScene& shading, const LightSet& lights) {
    LightBounds bounds;
    for (const Emitter& emitter : lights.emitters) add_light(bounds, make_node(emitter), find_axis(emitter));
    for (const PunctualLight& light : lights.punctual) add_light(bounds, make_node(light));
    if (lights.has_environment) add_light(bounds, make_node(shading.environment, 1.0));
    while (bounds.strength.size() % LightBounds::step != 0) add_light(bounds, {.nearby = false});
    return bounds;
}

std::vector<LightNode> make_light_nodes(const ShadingScene& shading, const LightSet& lights) {
    std::vector<LightNode> nodes;
    for (const Emitter& emitter : lights.emitters) nodes.push_back(make_node(emitter));
    for (const PunctualLight& light : lights.punctual) nodes.push_back(make_node(light));
    // All light of a picture may come from where the surface faces; of a constant environment, a quarter arrives.
    if (lights.has_environment)
        nodes.push_back(make_node(shading.environment, shading.environment.map != nullptr ? 4.0 : 1.0));
    return nodes;
}

}  // namespace aleph
