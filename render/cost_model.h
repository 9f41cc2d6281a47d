#pragma once
// What frames will cost at an error that is asked for, predicted from small renderings of some of them (the pilot).

#include <string>
#include <vector>

namespace aleph {

/// Seconds by how they grow with the number of pixels and with the error, or a number for each of these.
struct CostParts {
    double constant = 0.0;  ///< pose, update of ray structures: neither pixels nor error
    double pixels = 0.0;    ///< first hits, estimate, motion, perception: pixels alone
    double fill = 0.0;      ///< irradiance records of frames
    double moments = 0.0;   ///< irradiance records of key moments
    double shade = 0.0;     ///< samples

    double sum() const { return constant + pixels + fill + moments + shade; }
};

/// A pilot at one error.
struct PilotRun {
    double error = 0.0;  ///< thresholds, above 0
    CostParts seconds;   ///< of all its frames
    double start = 0.0;  ///< seconds to make the sequence, once
};

/// What the frames to be rendered are, relative to those of the pilot.
struct CostRatios {
    double pixels = 1.0;   ///< of a frame
    double frames = 1.0;   ///< number of frames that are rendered, not copied
    double moments = 1.0;  ///< number of key moments
};

/// Seconds are in proportion to pixels^size, and to error^-error where no pilot has measured how they follow it.
struct CostCoefficients {
    CostParts size, error;
};

/// Those that `build/study_cost` fits.
CostCoefficients fitted_coefficients();

/// Predicted seconds at an error. Between the errors of the pilot every part is linear in the logarithms; below the
/// least of them it grows by the power law; above the largest it is constant. It never falls where the error does.
/// @param runs  at least one, in any order, of different errors
/// @param error  above 0
/// @throws std::invalid_argument for no run, and for an error or a time that is not finite or out of range
double predict_seconds(const std::vector<PilotRun>& runs, const CostRatios& ratios,
                       const CostCoefficients& coefficients, double error);

/// The errors that a budget chooses among: .1 to 10 in two digits. From 10 on the accuracy of cached light is 1, the
/// loosest.
inline constexpr double least_budget_error = 0.1, most_budget_error = 10.0;

/// The smallest of these errors that is predicted to take at most so many seconds; if none is, the largest.
/// It is the double that its decimal text is read as.
double choose_error(const std::vector<PilotRun>& runs, const CostRatios& ratios, const CostCoefficients& coefficients,
                    double seconds);

}  // namespace aleph
