#pragma once
// Everything that shines, as a list of lights: emissive instances, point, spot and directional lights, the environment.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "render/shading_scene.h"

namespace aleph {

/// One emissive instance: all its triangles together are one light.
struct Emitter {
    struct Triangle {
        glm::vec3 corner, edge1, edge2;  ///< m, relative to the anchor
        glm::vec3 normal;                ///< unit, the side that shines
        int primitive;
    };
    int instance = no_index;
    bool double_sided = false;
    bool textured = false;
    Rgb radiance{0.0f};      ///< without texture
    float area = 0.0f;       ///< m2, of all triangles
    glm::vec3 center{0.0f};  ///< m, of a sphere about all triangles
    float radius = 0.0f;     ///< m
    std::vector<Triangle> triangles;
    std::vector<float> cumulative_area;  ///< share of the area up to and with each triangle
};

struct PunctualLight {
    Light::Kind kind = Light::Kind::point;
    glm::vec3 position{0.0f};   ///< m, relative to the anchor
    glm::vec3 direction{0.0f};  ///< unit, the way light travels
    Rgb intensity{0.0f};        ///< candela or lux
    float range = 0.0f;         ///< m; 0: unlimited
    /// Spot: 1 - cosine of the half-angles where full intensity ends and where all light ends.
    float inner_versine = 0.0f, outer_versine = 0.0f;
};

struct LightSet {
    std::vector<Emitter> emitters;
    std::vector<PunctualLight> punctual;
    Rgb environment{0.0f};
    bool has_environment = false;
    std::vector<int> emitter_of_instance;  ///< per ScenePose instance: its emitter or no_index

    /// Lights are numbered: emitters, then punctual lights, then the environment.
    int count() const { return static_cast<int>(emitters.size() + punctual.size()) + (has_environment ? 1 : 0); }
};

LightSet make_light_set(const ShadingScene& shading);

struct LightSample {
    glm::vec3 direction{0.0f};  ///< unit, towards the light
    float distance = 0.0f;      ///< m, to just before the light; infinite for directional light and environment
    Rgb incoming{0.0f};  ///< radiance / pdf (area light, environment), or irradiance on a facing surface (punctual)
    float pdf = 0.0f;    ///< per solid angle; 0 for punctual lights, which no direction can find
};

/// A sample of one light as a point sees it, u in [0,1)^2. `position` is where the shadow ray starts
/// (SurfacePoint::ray_origin): from the surface itself, `distance` would let an offset ray run into the light.
/// `incoming` is 0 where the light cannot be seen from there whatever stands between (behind it, zero area, out of
/// range, outside a spot's cone). The environment is sampled by cosine about `normal`.
/// @param share  of an area light that the sample stands for: its texture is averaged over so much of it; 0: read at
///               the sampled point itself
LightSample sample_light(const ShadingScene& shading, const LightSet& lights, int light, const glm::vec3& position,
                         const glm::vec3& normal, const glm::vec2& u, float share = 0.0f);

/// Density per solid angle with which sample_light, at `position`, finds an emitter's point at `distance` that faces
/// back with this cosine. Emitters of few triangles are sampled by solid angle where they are near, else by area.
float pdf_emitter(const Emitter& emitter, const glm::vec3& position, float cos_at_light, float distance);

}  // namespace aleph
