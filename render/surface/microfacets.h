#pragma once
// Reflectance of interfaces, and the GGX distribution of microfacets (Walter et al. 2007), anisotropic, with
// height-correlated Smith masking (Heitz 2014) and visible-normal sampling (Heitz 2018). All directions are unit, in
// the shading frame: z is the normal.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace aleph {

/// (1 - cosine)^5 of Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
inline float schlick_power(float cosine) {
    const float m = std::clamp(1.0f - cosine, 0.0f, 1.0f);
    return (m * m) * (m * m) * m;
}

/// Unpolarized reflectance of a smooth dielectric interface (Fresnel's equations); 1 at total reflection, exactly 0 for
/// a ratio of 1 at any cosine.
/// @param cosine  of the ray with the normal on its side, 0 to 1
/// @param ratio   index of refraction of the far side over that of the near side; 0 and infinity reflect everything
/// An argument that is no number reflects everything too; a negative ratio counts as its magnitude.
inline float dielectric_reflectance(float cosine, float ratio) {
    const float c = std::clamp(cosine, 0.0f, 1.0f), c2 = c * c, r2 = ratio * ratio;
    const float step = (ratio - 1.0f) * (ratio + 1.0f);
    if (step == 0.0f) return 0.0f;
    const float g2 = step + c2;  // (ratio times the cosine of the refracted ray) squared
    if (!(g2 > 0.0f)) return 1.0f;
    const float g = std::sqrt(g2);
    // g - c and r2 c - g would cancel near a ratio of 1; both hold the factor r2 - 1.
    const float across = step / ((g + c) * (g + c));
    const float along = step * (r2 * c2 + c2 - 1.0f) / ((r2 * c + g) * (r2 * c + g));
    return std::min(1.0f, 0.5f * (across * across + along * along));
}

/// A narrower lobe is a mirror: single precision could not resolve it.
inline constexpr float min_ggx_alpha = 1e-3f;

/// Walter et al. 2007, eq. 33, per steradian, for the half vector h. sin^2 comes from |h x n|^2: 1 - cos^2 would cancel
/// for narrow lobes.
/// @param alpha  widths along x and y
inline float ggx_d(const glm::vec2& alpha, const glm::vec3& h) {
    const float a2 = alpha.x * alpha.y;
    const glm::vec3 v(alpha.y * h.x, alpha.x * h.y, a2 * h.z);
    const float w = a2 / glm::dot(v, v);
    return a2 * w * w / std::numbers::pi_v<float>;
}

inline float smith_lambda(const glm::vec2& alpha, const glm::vec3& v) {
    const float x = alpha.x * v.x, y = alpha.y * v.y;
    return 0.5f * (std::sqrt(1.0f + (x * x + y * y) / (v.z * v.z)) - 1.0f);
}

/// Share of the microfacets that both directions see.
inline float smith_g2(const glm::vec2& alpha, const glm::vec3& v, const glm::vec3& l) {
    return 1.0f / (1.0f + smith_lambda(alpha, v) + smith_lambda(alpha, l));
}
inline float smith_g1(const glm::vec2& alpha, const glm::vec3& v) {
    return 1.0f / (1.0f + smith_lambda(alpha, v));
}

/// A half vector that `view` sees, for u in [0,1)^2.
inline glm::vec3 sample_visible_normal(const glm::vec2& alpha, const glm::vec3& view, const glm::vec2& u) {
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha.x * view.x, alpha.y * view.y, view.z));
    const float planar = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::vec3 t1 =
        planar > 0.0f ? glm::vec3(-stretched.y, stretched.x, 0.0f) / std::sqrt(planar) : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 t2 = glm::cross(stretched, t1);
    const float r = std::sqrt(u.x), phi = 2.0f * std::numbers::pi_v<float> * u.y;
    const float p1 = r * std::cos(phi);
    const float s = 0.5f * (1.0f + stretched.z);
    const float p2 = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p1 * p1)) + s * r * std::sin(phi);
    const glm::vec3 n = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(0.0f, 1.0f - p1 * p1 - p2 * p2));
    return glm::normalize(glm::vec3(alpha.x * n.x, alpha.y * n.y, std::max(1e-6f, n.z)));
}

/// Density of the direction that a visible normal h reflects `view` to, per steradian.
inline float pdf_reflected(const glm::vec2& alpha, const glm::vec3& view, const glm::vec3& h) {
    return smith_g1(alpha, view) * ggx_d(alpha, h) / (4.0f * view.z);
}

}  // namespace aleph
