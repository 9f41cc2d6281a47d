#pragma once
// The break that the scene shows: fifteen balls in a rack, and the cue ball as the cue leaves it.

#include <vector>

#include "scenes/pool/simulation.h"

namespace aleph {

inline constexpr int cue_ball = 0;  ///< index; balls 1 to 15 carry their number

/// m/s, that the cue gives the cue ball: a firm break.
inline constexpr double break_speed = 6.8;

/// Ball i at index i. The rack's apex stands on the foot spot (x > 0), its balls apart by hundredths of a millimetre
/// that differ as they do in a real rack; the numbers look roughly up and towards the foot end. Always the same.
std::vector<PoolBall> make_rack(const PoolSettings& settings);

}  // namespace aleph
