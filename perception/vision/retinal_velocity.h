#pragma once
// Motion over the retina of an eye that follows what moves (Yee 2000, eq. 5.5): one value at a time, in double, and for
// rows of pixels, in float.

namespace aleph {

inline constexpr double drift_velocity = 0.15;       ///< deg/s, v_Min (Kelly 1979)
inline constexpr double pursuit_limit = 80.0;        ///< deg/s, v_Max (Daly 1998)
inline constexpr double tracking_efficiency = 0.82;  ///< S where nothing, or everything, stands out (3.1; section 7.2)

/// (5.5), deg/s, at least the drift: image velocity `v_i` less what the eye follows with efficiency `s`.
/// `v_i` below 0 or NaN is 0, above 1e30 is 1e30; `s` is clamped to [0,1], NaN is tracking_efficiency.
double retinal_velocity(double v_i, double s);

/// The part of it that the eye follows, deg/s: s v_i, at most pursuit_limit. Arguments as above.
double tracked_velocity(double v_i, double s);

/// retinal_velocity() of a row. Velocities that are NaN or negative count as 0, above 1e30 as 1e30.
/// @param velocity  v_I, deg/s, `count` values
/// @param saliency  S, [0,1], `count` values
void retinal_velocity_row(const float* velocity, const float* saliency, int count, float* out);

/// tracked_velocity() of a row. Arguments as above.
void tracked_velocity_row(const float* velocity, const float* saliency, int count, float* out);

}  // namespace aleph
