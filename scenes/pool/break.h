#pragma once
// The start of the break shot: fifteen balls in a rack, and the cue ball as it leaves the cue.

#include <vector>

#include "scenes/pool/simulation.h"

namespace aleph {

inline constexpr int cue_ball = 0;  ///< index; balls 1 to 15 have their number as index

/// Speed that the cue gives to the cue ball, m/s.
inline constexpr double break_speed = 6.8;

/// Ball i is at index i. The apex of the rack is on the foot spot (x > 0). The gaps between the balls are some
/// hundredths of a millimetre and differ, as in a real rack. The numbers face roughly up and towards the foot end.
/// Deterministic.
std::vector<PoolBall> make_rack(const PoolSettings& settings);

}  // namespace aleph
