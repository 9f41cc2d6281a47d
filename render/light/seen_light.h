#pragma once
// A light as one surface point sees it: what all samples of it from there have in common.

#include <array>

#include "render/light/lights.h"

namespace aleph {

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

struct SeenLight {
    int light = no_index;
    SolidAngles angles;  ///< of an emitter
};

/// @param position  where the shadow rays start (Receiver)
SeenLight see_light(const LightSet& lights, int light, const glm::vec3& position);

/// sample_light of a light that this receiver sees.
LightSample sample_seen_light(const ShadingScene& shading, const LightSet& lights, const SeenLight& seen,
                              const Receiver& receiver, const glm::vec2& u, float share = 0.0f);

/// The lights that one receiver has seen last.
class SeenLights {
  public:
    SeenLights(const LightSet& lights, const Receiver& receiver) : lights_(lights), position_(receiver.position) {}

    const SeenLight& at(int light) {
        SeenLight& place = seen_[static_cast<std::size_t>(light) % seen_.size()];
        if (place.light != light) place = see_light(lights_, light, position_);
        return place;
    }

  private:
    const LightSet& lights_;
    glm::vec3 position_;
    std::array<SeenLight, 16> seen_;
};

}  // namespace aleph
