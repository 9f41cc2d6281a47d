#pragma once
// Simulation over time. Velocities change at fixed sub-steps (friction) and at impacts. Impact times between sub-steps
// are solved exactly and processed in order of time, then of index: the result is a pure function of the arguments, and
// balls never overlap.

#include <vector>

#include "scenes/pool/impact.h"

namespace aleph {

struct PoolRun {
    double samples_per_second = 0.0;
    std::vector<std::vector<PoolBall>> samples;  ///< [time][ball]; the first sample is the start
};

/// @param duration  s; the samples are at i / samples_per_second up to this time
/// @param balls  apart from each other, between the cushions, with horizontal velocities
PoolRun simulate_pool(std::vector<PoolBall> balls, const PoolSettings& settings, double duration,
                      double samples_per_second);

}  // namespace aleph
