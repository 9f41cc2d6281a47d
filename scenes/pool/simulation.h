#pragma once
// Simulation over time. Velocities change at fixed sub-steps (friction) and at impacts. Impact times between sub-steps
// are solved exactly and processed in order of time, then of index: the result is a pure function of the arguments, and
// balls never overlap.

#include <vector>

#include "scenes/pool/impact.h"

namespace aleph {

/// One collision, with momentum and energy of its balls before and after.
struct PoolEvent {
    double seconds = 0.0;
    bool cushion = false;
    std::vector<int> balls;                                ///< one ball for a cushion, else all that touch
    glm::dvec3 momentum_before{0.0}, momentum_after{0.0};  ///< kg m/s
    double energy_before = 0.0, energy_after = 0.0;        ///< J, translation and rotation
};

struct PoolRun {
    double samples_per_second = 0.0;
    std::vector<std::vector<PoolBall>> samples;  ///< [time][ball]; the first sample is the start
    std::vector<PoolEvent> events;               ///< in order of time
};

/// @param duration  s; the samples are at i / samples_per_second up to this time
/// @throws InputError if a setting or a ball is not finite, balls overlap, or a ball is outside the cushions
PoolRun simulate_pool(std::vector<PoolBall> balls, const PoolSettings& settings, double duration,
                      double samples_per_second);

}  // namespace aleph
