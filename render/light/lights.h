#pragma once
// All lights of a posed scene: emissive instances, point, spot and directional lights, the environment.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "render/light/emitter.h"
#include "render/light/light_tree.h"
#include "render/light/sky_openings.h"

namespace aleph {

struct PunctualLight {
    int index = no_index;  ///< into ScenePose::lights
    Light::Kind kind = Light::Kind::point;
    glm::vec3 position{0.0f};   ///< m, relative to the anchor
    glm::vec3 direction{0.0f};  ///< unit, in which light travels
    Rgb intensity{0.0f};        ///< candela or lux
    float range = 0.0f;         ///< m; 0: unlimited
    /// Spot: 1 - cosine of the half-angles at which full intensity ends and at which light ends.
    float inner_versine = 0.0f, outer_versine = 0.0f;
};

/// Bounds of what each light brings to a point, rough and quick: for choosing among lights (bound_illuminance). One
/// array for each value, so that several lights are looked at together.
struct LightBounds {
    static constexpr std::size_t step = 8;  ///< lights without strength fill the arrays up to a multiple of it

    /// m, the centre of a sphere around a near light; unit vector towards a directional one; 0 for light from all
    /// around.
    std::vector<float> x, y, z;
    std::vector<float> nearby;                  ///< 1 for near lights, 0 for others
    std::vector<float> radius;                  ///< near: of that sphere, m; 0: directional; 1: from all around
    std::vector<float> axis_x, axis_y, axis_z;  ///< unit normal of flat lights that shine on one side
    std::vector<float> one_sided;               ///< 1 for those lights, 0 for others
    std::vector<float> strength;  ///< near: luminous intensity along the axis; else illuminance of a facing surface
    std::vector<float> inside;    ///< illuminance within the sphere
};

struct LightSet {
    std::vector<Emitter> emitters;
    std::vector<PunctualLight> punctual;
    bool has_environment = false;          ///< one that is not black
    std::vector<int> emitter_of_instance;  ///< per ScenePose instance: its emitter or no_index
    LightBounds bounds;                    ///< per light
    LightTree tree;                        ///< over all lights
    KeptTexels kept;                       ///< of the lamps with textures or alpha

    /// Lights are numbered: emitters, then punctual lights, then the environment.
    int count() const { return static_cast<int>(emitters.size() + punctual.size()) + (has_environment ? 1 : 0); }
};

/// @param before  of this scene at another time: saves work and changes nothing
LightSet make_light_set(const ShadingScene& shading, LightSet before = {});

/// In LightSet::emitter_of_instance, of an emitter that is no light: rays that meet it find all of its emission.
inline constexpr int left_out_emitter = -2;

/// No light, whatever shines.
void remove_all_lights(LightSet& lights);

/// Leaves lights out, the others keep their order.
/// @param instances, punctual  into ShadingScene::instances and ScenePose::lights
void remove_lights(const ShadingScene& shading, const std::vector<int>& instances, const std::vector<int>& punctual,
                   LightSet& lights);

struct LightSample {
    glm::vec3 direction{0.0f};  ///< unit, towards the light
    float distance = 0.0f;      ///< m, to just before the light; infinite for directional light and environment
    Rgb incoming{0.0f};  ///< radiance / pdf (area light, environment), or irradiance on a facing surface (punctual)
    float pdf = 0.0f;    ///< per solid angle; 0 for punctual lights, which no ray can hit
};

/// Density per steradian of sample_light for the environment.
float pdf_environment(const ShadingScene& shading, const Receiver& receiver, const glm::vec3& direction);

/// A sample of the environment; sample_light of its number. Most of them go towards the receiver's openings.
LightSample sample_surroundings(const ShadingScene& shading, const Receiver& receiver, glm::vec2 u);

/// A sample of one light as a point sees it, u in [0,1)^2. `incoming` is 0 if the light cannot reach the point even
/// without obstacles (behind an emitter, zero area, out of range, outside a spot's cone). A constant environment is
/// sampled by cosine around the receiver's normal, a picture by its luminance.
/// @param share  of an area light's samples that this one represents: its texture is averaged over its part of the
///               area. 0: the texture is read at the sampled point
LightSample sample_light(const ShadingScene& shading, const LightSet& lights, int light, const Receiver& receiver,
                         const glm::vec2& u, float share = 0.0f);

/// Density per solid angle of sample_light. Emitters of few triangles are sampled by solid angle if they are near, all
/// others by area, of those sides that may face the receiver; those with cells by these, and near ones half by solid
/// angle.
/// @param position  of the receiver
/// @param hit       of the emitter
/// @param cosine    of its normal there with the ray from the receiver
/// @param distance  m, from the receiver
float pdf_emitter(const Emitter& emitter, const glm::vec3& position, const Hit& hit, float cosine, float distance);

/// Solid angle of a triangle with corners at these offsets from the eye, sr (Van Oosterom and Strackee 1983). Accurate
/// for small triangles; 0 if the triangle is seen edge-on or a corner lies at the eye.
float solid_angle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Sampling by solid angle (Arvo 1995, "Stratified Sampling of Spherical Triangles") has much less noise near a light
/// than sampling by area. A unit direction into the triangle of this solid angle, uniform in solid angle; u in [0,1)^2.
/// It must be at least about 1e-3 sr: for smaller ones, float angles are too coarse.
glm::vec3 sample_spherical_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float solid_angle,
                                    const glm::vec2& u);

/// Emitters of at most this many triangles are sampled by solid angle if they are near.
inline constexpr std::size_t max_spherical_triangles = 4;

/// The solid angle of each triangle of an emitter as seen from a point, sr; 0 from the side that does not emit.
struct SolidAngles {
    std::array<float, max_spherical_triangles> of{};
    float total = 0.0f;  ///< 0: too many triangles or too far away, sample by area
};

/// The sides of an emitter that may face a point.
struct FacingSides {
    std::uint32_t which = 0;  ///< a bit for each of EmitterShape::sides
    float share = 1.0f;       ///< of the emitter's samples
};

struct SeenLight {
    int light = no_index;
    SolidAngles angles;  ///< of an emitter
    FacingSides facing;  ///< of one that is sampled by area
};

/// @param position  where the shadow rays start (Receiver)
SeenLight see_light(const LightSet& lights, int light, const glm::vec3& position);

/// sample_light of a light that this receiver sees.
LightSample sample_seen_light(const ShadingScene& shading, const LightSet& lights, const SeenLight& seen,
                              const Receiver& receiver, const glm::vec2& u, float share = 0.0f);

/// LightSet::bounds.
LightBounds make_light_bounds(const ShadingScene& shading, const LightSet& lights);

/// The lights as leaves of a tree. Textures are taken to be as bright as Emitter::brightest all over.
std::vector<LightNode> make_light_nodes(const ShadingScene& shading, const LightSet& lights);

/// About the illuminance that each of the first lights brings to a point without obstacles. Above 0 wherever the light
/// can bring any.
/// @param weights  set; a multiple of LightBounds::step of them, as far as the lights' arrays reach
void bound_illuminances(const LightBounds& lights, const Receiver& receiver, std::span<float> weights);

}  // namespace aleph
