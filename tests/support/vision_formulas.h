#pragma once
// The elevations of the three models of vision, and TVI, as their papers print them, written a second time: what the
// vision model of the renderer is compared with. Single values of the renderer's own at the end.

#include "perception/perception_settings.h"
#include "perception/vision/vision_model.h"

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
/// Where they peak (5.10), cycles per degree.
double written_thesis_peak(double v);
double written_laird_peak(double v);
/// castleCSF, achromatic, 1 square degree, at the fovea (Ashraf et al. 2024): to `rho` cycles per degree at `omega` Hz.
double written_castle_sensitivity(double rho, double omega, double luminance);
/// Its highest sensitivity at rest: where the derivative of the sustained channel over log frequency is 0.
double written_castle_peak(double luminance);

/// f of a frequency, (5.9), or for castle its peak at rest over the sensitivity and the display's blur.
double written_elevation(const VisionModel* vision, double rho, const EyeMotion& motion);

/// Threshold versus intensity (Ward-Larson, Rushmeier and Piatko 1997), cd/m2 to cd/m2.
double written_tvi(double luminance);

/// f of castle from the renderer's castle_sensitivity, castle_peak and hold_transfer, in double.
double castle_elevation(double rho, double retinal, double tracked, double luminance, double persistence,
                        const FrameRate& frame_rate);

/// f as the rows of a model give it to a single pixel.
double row_elevation(const VisionModel& vision, const Stimulus& stimulus, const Presentation& shown = {});
inline double thesis_elevation(double rho, double v) {
    return row_elevation(thesis_vision(), {.frequency = rho, .retinal = v});
}

}  // namespace aleph
