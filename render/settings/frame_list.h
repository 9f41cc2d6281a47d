#pragma once
// Lists of frames: "1-10,20-40x2".

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Frames of a comma list of N, A-B and A-BxS (every S-th from A), in the order given, without repeats. Frames may be
/// negative: "-3-5", "-5--1". ':' is refused, because programs differ in its meaning (a step, or a stagger).
/// @throws InputError (place "--frames") on anything else, on more than 10 million frames, on frames beyond 32 bits
std::vector<int> parse_frame_list(std::string_view text);

/// "1-10,12" for these frames, in their order.
std::string format_frame_list(const std::vector<int>& frames);

/// Nothing, or "frame 9 lies outside the shot, which has the frames 0 to 4". Every value is then that of its first or
/// last key, so that nothing moves.
std::optional<std::string> describe_frame_outside(std::int64_t frame, const FrameRange& range);

}  // namespace aleph
