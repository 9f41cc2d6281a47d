#pragma once
// Blur of motion that the eye follows on a display that holds its frames: while a frame stands still, the eye moves on.

#include "engine/base/frame_rate.h"

namespace aleph {

/// Widths of the two blurs by persistence, deg: p v / fps by the display, p (slope v + offset) by the eye (Denes,
/// Jindal, Mikhailiuk and Mantiuk 2020, "A perceptual model of motion quality for rendering with adaptive refresh-rate
/// and resolution"; Jindal et al. 2021).
inline constexpr double eye_blur_slope = 0.001648;   ///< s
inline constexpr double eye_blur_offset = 0.079818;  ///< deg

/// Share of its contrast that a pattern of `rho` cycles per degree keeps when the eye follows it at `tracked` deg/s,
/// relative to the same pattern at rest, which is how contrast sensitivity is measured: (0,1]. A blur of width b passes
/// w^2 / (w^2 + 4 rho^2), w = pi / (2 b): the envelope of |sinc(b rho)|, without its zeros.
/// @param tracked      deg/s; NaN and negative values count as 0, above 1e30 as 1e30; so does `rho`
/// @param persistence  share of a frame's time for which it is shown; clamped to [0,1], NaN counts as 0. At 0 nothing
/// blurs
double hold_transfer(double rho, double tracked, double persistence, const FrameRate& frame_rate);

}  // namespace aleph
