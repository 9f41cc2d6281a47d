#pragma once
// Sensitivity of the eye to achromatic contrast, as measured on present displays: castleCSF (Ashraf, Mantiuk, Chapiro
// and Wuerger 2024, "castleCSF: a contrast sensitivity function of color, area, spatiotemporal frequency, luminance and
// eccentricity", Journal of Vision 24(4):5), at the fovea. It is the sum of a sustained and a transient channel. One
// value at a time, in double.
//
// Every input gives a finite result that is not negative. A frequency that is NaN or negative counts as 0, above 1e30
// as 1e30; luminance is clamped to the fit's range of 1e-3 to 1e4 cd/m2, NaN counts as 1e-3; an area that is NaN or
// negative counts as 0, where sensitivity is 0.

namespace aleph {

inline constexpr double castle_min_luminance = 1e-3, castle_max_luminance = 1e4;  ///< cd/m2

/// Sensitivity, 1 / threshold contrast, to a pattern of `rho` cycles per degree that changes at `omega` Hz. What moves
/// over the retina at v deg/s changes at omega = rho v.
/// @param luminance  that the eye is adapted to, cd/m2
/// @param area       of the pattern, square degrees; infinity is allowed
double castle_sensitivity(double rho, double omega, double luminance, double area = 1.0);

/// The two channels of castle_sensitivity without their temporal responses.
double castle_sustained(double rho, double luminance, double area = 1.0);
double castle_transient(double rho, double luminance, double area = 1.0);

/// Constants of the temporal responses (values of the authors' program, version 0.2.4).
inline constexpr double castle_sustained_power = 1.3314, castle_sustained_scale = 10.5795;
inline constexpr double castle_transient_power = 0.1898, castle_transient_scale = 0.0844836;
inline constexpr double castle_transient_slope = 2.41482,
                        castle_transient_offset = 4.7036;  ///< of the peak over log10 L

/// Temporal responses of the two channels, [0,1]: to `omega` Hz. The transient one peaks at castle_transient_peak.
double castle_sustained_response(double omega);
double castle_transient_response(double omega, double luminance);
/// Hz: 9.5 at 100 cd/m2; 0 below .0113 cd/m2, where the fit has none.
double castle_transient_peak(double luminance);

/// Sensitivity to the chromatic mechanisms, 1 / threshold contrast: red-green is L - 2.3112 M, yellow-violet is
/// 50.9875 S - (L + M), each over L + M of what the eye is adapted to (cones of CIE 2006). Thresholds of all three
/// mechanisms combine as the root of the sum of squares. Arguments as in castle_sensitivity.
double castle_red_green(double rho, double omega, double luminance, double area = 1.0);
double castle_yellow_violet(double rho, double omega, double luminance, double area = 1.0);

/// The highest sensitivity to a pattern at rest, over all frequencies: 134.3 at 100 cd/m2, at most 153. Of the
/// sustained channel: at rest the transient one adds less than 0.1 % from .02 cd/m2 up, and is not fitted in the dark.
double castle_peak(double luminance);

}  // namespace aleph
