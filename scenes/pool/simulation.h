#pragma once
// A game's physics over time. Velocities change at fixed sub-steps (friction) and at impacts, whose times are solved
// exactly in between, in order of time and then of index: the result is a pure function of its arguments, and balls
// never overlap.

#include <vector>

#include "scenes/pool/impact.h"

namespace aleph {

/// One collision, with what the balls in it carried before and after.
struct PoolEvent {
    double seconds = 0.0;
    bool cushion = false;
    std::vector<int> balls;                                ///< one at a cushion, else those that touch
    glm::dvec3 momentum_before{0.0}, momentum_after{0.0};  ///< kg m/s
    double energy_before = 0.0, energy_after = 0.0;        ///< J, translation and rotation
};

struct PoolRun {
    double samples_per_second = 0.0;
    std::vector<std::vector<PoolBall>> samples;  ///< [time][ball]; the first is the start
    std::vector<PoolEvent> events;               ///< in order of time
};

/// @param duration  s; samples lie at i / samples_per_second up to it
/// @throws InputError where a setting or a ball is not finite, balls overlap, or one stands outside the cushions
PoolRun simulate_pool(std::vector<PoolBall> balls, const PoolSettings& settings, double duration,
                      double samples_per_second);

}  // namespace aleph
