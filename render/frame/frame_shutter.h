#pragma once
// Indirect light at times while the shutter of a frame is open.

#include "render/frame/sequence_state.h"

namespace aleph {

/// Computes light at as many times as nearly all of it needs. Moves `shutter`.
/// @param prepared  with the limits that samples are taken to
/// @param counts    of the records
/// @return none: light of the shutter's centre does, or that of samples' own paths
std::vector<ShutterSpan> find_shutter_spans(SequenceState& s, std::int64_t frame, const PreparedFrame& prepared,
                                            const SampleOptions& options, const FrameRequest& request,
                                            FrameCounts& counts);

}  // namespace aleph
