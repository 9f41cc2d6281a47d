#pragma once
// Cost of frames at an error that is asked for, predicted from measurements of some of them (the pilot; README.md).
// Parts are of pictures in full size, because a small picture asks for other samples: more of its pixels show several
// things, and its contrasts have other sizes. Their light is without lighting keyframes.

#include <vector>

namespace aleph {

/// A part of the pixels at one error; s.
struct PartSeconds {
    double error = 0.0;  ///< thresholds, above 0
    double fill = 0.0;   ///< irradiance values for these pixels alone
    double shade = 0.0;  ///< their samples
};

/// Light in a small picture, at the largest error; s.
struct LightSeconds {
    double pixels = 1.0;     ///< of the full picture, over those of this one
    double fill = 0.0;       ///< irradiance values of frames
    double keyframes = 0.0;  ///< of lighting keyframes
};

/// Measurements of some frames; sums over them.
struct PilotSeconds {
    double start = 0.0;      ///< s, to make the sequence, once
    double before = 0.0;     ///< s, of the stages before light and samples
    double share = 1.0;      ///< of the pixels: those of the parts
    double keyframes = 0.0;  ///< lighting keyframes that were computed, by frame; 0: light is computed for each frame
    std::vector<PartSeconds> parts;   ///< at least one, of different errors
    std::vector<LightSeconds> light;  ///< none, one or two pictures
};

/// Numbers of the frames to be rendered, relative to those of the pilot.
struct CostRatios {
    double frames = 1.0;     ///< number of frames that are rendered, not copied
    double keyframes = 1.0;  ///< number of lighting keyframes
};

/// Coefficients that `build/study_cost` fits.
struct CostCoefficients {
    double shade = 1.0;    ///< seconds of samples beside light of their own, over those that read lighting keyframes
    double overlap = 1.0;  ///< light for a part alone, over its share of the picture's: blocks do not share it
    /// Growth of a frame's own light beside lighting keyframes, over what the part's says (by share).
    double fill = 0.0;
    double keyframes = 0.0;       ///< the same for each lighting keyframe
    double shade_exponent = 0.0;  ///< below the least error measured, seconds of samples grow as error^-exponent
    double light_exponent = 0.0;  ///< the same for light
};

CostCoefficients fitted_coefficients();

/// Predicted seconds by what takes them.
struct CostParts {
    double start = 0.0, before = 0.0, fill = 0.0, keyframes = 0.0, shade = 0.0;
    double sum() const { return start + before + fill + keyframes + shade; }
};

/// Predicted seconds at an error. No part falls where the error does. Above the largest error of the pilot nothing
/// falls.
/// @param error  above 0
CostParts predict_seconds(const PilotSeconds& pilot, const CostRatios& ratios, const CostCoefficients& coefficients,
                          double error);

/// The errors that a budget chooses among: .1 to 10 in two digits.
inline constexpr double least_budget_error = 0.1, most_budget_error = 10.0;

/// The smallest of these errors that is predicted to take at most so many seconds; if none is, the largest.
/// It is the double that its decimal text is read as.
double choose_error(const PilotSeconds& pilot, const CostRatios& ratios, const CostCoefficients& coefficients,
                    double seconds);

}  // namespace aleph
