#pragma once
// Motion over the retina of an eye that follows what moves (Yee 2000, eq. 5.5), for rows of pixels.

namespace aleph {

inline constexpr double drift_velocity = 0.15;       ///< deg/s, v_Min (Kelly 1979)
inline constexpr double pursuit_limit = 80.0;        ///< deg/s, v_Max (Daly 1998)
inline constexpr double tracking_efficiency = 0.82;  ///< S where nothing, or everything, stands out (3.1; section 7.2)

/// (5.5), deg/s, at least the drift: image velocity less what the eye follows. Velocities that are NaN or negative
/// count as 0, above 1e30 as 1e30.
/// @param velocity  v_I, deg/s, `count` values
/// @param saliency  S, the efficiency, [0,1], `count` values
void retinal_velocity_row(const float* velocity, const float* saliency, int count, float* out);

/// The part of it that the eye follows, deg/s: S v_I, at most pursuit_limit. Arguments as above.
void tracked_velocity_row(const float* velocity, const float* saliency, int count, float* out);

}  // namespace aleph
