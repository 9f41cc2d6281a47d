#pragma once
// Indirect light at times while the shutter of a frame is open.

#include "render/frame/sequence_state.h"

namespace aleph {

/// Finds how far the light of the shutter's centre, or of lighting keyframes, differs from that of other times. Without
/// keyframes it computes light at as many times as nearly all of it needs. Moves `shutter`.
/// @param prepared  with the limits that samples are taken to
/// @param carried  there is light of lighting keyframes
/// @param options  gets `spans` and `from_center`
FrameCounts find_shutter_light(SequenceState& s, std::int64_t frame, const PreparedFrame& prepared,
                               const FrameRequest& request, bool carried, SampleOptions& options);

}  // namespace aleph
