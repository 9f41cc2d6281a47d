#pragma once
// A tree over the lights of a scene. A group of lights stands for all of them where it brings little; so light is
// sampled in a time that grows with the logarithm of their number (Conty Estevez and Kulla 2018, "Importance Sampling
// of Many Lights with Adaptive Tree Splitting"; Walter et al. 2005, "Lightcuts"). All that is said of light is
// luminance.

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace aleph {

struct LitSurface;
struct SeenOpenings;
struct SkyOpenings;

/// One light, or several.
struct LightNode {
    /// m, a sphere around the lights; of directional ones, around the unit vectors towards them. The environment has
    /// the unit sphere.
    glm::vec3 center{0.0f};
    float radius = 0.0f;
    bool nearby = true;  ///< light falls off with distance
    /// True if the directions of light are limited: to what is within `emission` of any direction within `cone` of the
    /// axis. The cone holds the normals of surfaces, or the axes of spots.
    bool directed = false;
    glm::vec3 axis{0.0f};
    float cos_cone = 1.0f;
    float cos_emission = 0.0f;  ///< 0 for surfaces
    bool by_cosine = true;      ///< light around the directions in the cone falls off at least with the cosine
    float strength = 0.0f;      ///< sum of intensities along the axes; of what is not nearby, illuminance
    float most = 0.0f;          ///< sum of the largest illuminances; infinite where there are point lights
};

/// The point that a light illuminates.
struct Receiver {
    /// m, where the shadow ray starts (SurfacePoint::ray_origin). If it were the surface point itself, the offset ray
    /// could reach the light within LightSample::distance.
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit
    bool behind = false;     ///< light from behind the surface counts as well
    /// The surface if it has gloss alone: a light counts by what the lobe shows of it. Null: by its illuminance.
    const LitSurface* gloss = nullptr;
    const SkyOpenings* openings = nullptr;  ///< of the sky, as far as they are known; null: light comes from anywhere
    const SeenOpenings* seen = nullptr;  ///< of the openings, where lights are chosen as well as sampled; may be null
};

/// Illuminance that eight nodes can bring to a surface without shadows.
struct LightReaches {
    /// Never less than what they bring.
    std::array<float, 8> bounds;
    /// About what they bring; above 0 wherever they can bring any.
    std::array<float, 8> estimates;
};

/// Eight nodes of the tree, below one node; one array for each value, so that all are looked at together. Places that
/// are not used have no strength.
struct LightGroup {
    static constexpr int size = 8;
    using Values = std::array<float, size>;
    struct Vectors {
        Values x{}, y{}, z{};
        void set(std::size_t i, const glm::vec3& v) { x[i] = v.x, y[i] = v.y, z[i] = v.z; }
    };
    Vectors center{};
    Values radius{}, nearby{}, directed{};
    Vectors axis{};
    Values cos_cone{}, sin_cone{};
    Values cos_emission{}, by_cosine{};
    Values strength{}, most{};
    std::array<int, size> children{};  ///< see LightTree
    int used = 0;
};

LightReaches reach_of(const LightGroup& group, const Receiver& receiver);

/// Children are numbered: lights from 0; groups from the number of lights.
struct LightTree {
    std::vector<LightGroup> groups;  ///< the first one is the root
    int lights = 0;

    bool is_light(int child) const { return child < lights; }
    const LightGroup& group(int child) const { return groups[static_cast<std::size_t>(child - lights)]; }
};

LightTree make_light_tree(const std::vector<LightNode>& lights);

}  // namespace aleph
