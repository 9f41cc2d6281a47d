#pragma once
// Coefficients of the cost model from frames that were measured whole.

#include <string>
#include <vector>

#include "render/budget/cost_model.h"

namespace aleph {

/// One frame at several errors, of which the largest is first.
struct MeasuredFrame {
    std::string name;
    PilotSeconds pilot;            ///< its parts are of the same errors
    double pilot_took = 0.0;       ///< s
    std::vector<CostParts> whole;  ///< by error
};

/// Means of what each frame and error tells, weighted by the share of the frame's seconds that it explains.
CostCoefficients fit_coefficients(const std::vector<MeasuredFrame>& frames);

}  // namespace aleph
