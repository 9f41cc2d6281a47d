#pragma once
// The elevations of the three models of vision as their papers print them, written a second time: what the vision model
// of the renderer is compared with. Nothing here calls it.

#include "perception/perception_settings.h"

namespace aleph {

/// Conditions that an elevation depends on besides frequency, on a display that holds each of 30 frames a second.
struct EyeMotion {
    double retinal = 0.15;     ///< v_R, deg/s
    double tracked = 0.0;      ///< what the eye follows, deg/s
    double luminance = 100.0;  ///< that the eye is adapted to, cd/m2
};

/// (5.5): of image velocity `v`, deg/s, when the eye follows it with efficiency `s`.
double written_retinal_velocity(double v, double s);
double written_tracked_velocity(double v, double s);

/// Sensitivity to `rho` cycles per degree moving at `v` deg/s: Kelly 1979 with Daly's constants (Yee 2000, 5.6 to 5.8).
double written_thesis_sensitivity(double rho, double v);
/// The same as Laird et al. 2006 print it, with one more factor c1.
double written_laird_sensitivity(double rho, double v);
/// castleCSF, achromatic, 1 square degree, at the fovea (Ashraf et al. 2024): to `rho` cycles per degree at `omega` Hz.
double written_castle_sensitivity(double rho, double omega, double luminance);
/// Its highest sensitivity at rest: where the derivative of the sustained channel over log frequency is 0.
double written_castle_peak(double luminance);

/// f of a frequency, (5.9), or for castle its peak at rest over the sensitivity and the display's blur.
double written_elevation(const VisionModel* vision, double rho, const EyeMotion& motion);

}  // namespace aleph
