#pragma once
// A tree over the lights of a scene. A group of lights stands for all of them where it brings little; so light is
// sampled in a time that grows with the logarithm of their number (Conty Estevez and Kulla 2018, "Importance Sampling
// of Many Lights with Adaptive Tree Splitting"; Walter et al. 2005, "Lightcuts").

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace aleph {

/// One light, or a group. All that is said of light is luminance.
struct LightNode {
    static constexpr int none = -1;

    /// m, a sphere around the lights; of directional ones, around the unit vectors towards them.
    glm::vec3 center{0.0f};
    float radius = 0.0f;
    bool nearby = true;  ///< light falls off with distance
    /// Whether the directions of light are limited. They are within `cone` and then `emission` of the axis: the cone
    /// holds the normals of surfaces, or the axes of spots; the emission is what leaves around these.
    bool directed = false;
    glm::vec3 axis{0.0f};
    float cos_cone = 1.0f;
    float cos_emission = 0.0f;        ///< 0 for surfaces
    bool by_cosine = true;            ///< light around the axes falls off at least with the cosine
    float strength = 0.0f;            ///< sum of intensities along the axes; of what is not nearby, illuminance
    float most = 0.0f;                ///< sum of the largest illuminances; infinite where there are point lights
    int first = none, second = none;  ///< nodes; none: a light
};

/// What a node can bring to a surface without shadows, as illuminance.
struct LightReach {
    float bound = 0.0f;     ///< never less than what it brings
    float estimate = 0.0f;  ///< about what it brings; above 0 wherever it can bring any
};

/// @param normal  unit, of the surface
/// @param behind  1 where light from behind the surface counts as well, else 0
LightReach reach_of(const LightNode& node, const glm::vec3& position, const glm::vec3& normal, float behind);

struct LightTree {
    std::vector<LightNode> nodes;  ///< first those of the lights, in their order
    std::vector<int> roots;        ///< of near lights, of directional ones, the environment
    int lights = 0;

    bool is_light(int node) const { return node < lights; }
};

/// A tree over these lights. Groups are halves along the longest side of the box around their centres.
LightTree make_light_tree(std::vector<LightNode> lights);

}  // namespace aleph
