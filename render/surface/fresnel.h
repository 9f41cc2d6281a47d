#pragma once
// Reflectance of interfaces.

#include <algorithm>
#include <cmath>

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

}  // namespace aleph
