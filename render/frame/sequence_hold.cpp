// Frames of a hold: rendered once, then copied.

#include "render/frame/sequence.h"
#include "render/frame/sequence_state.h"

namespace aleph {

FrameOutput Sequence::render(std::int64_t frame, const FrameRequest& request) {
    SequenceState& s = state();
    // The first frame after an edit has a motion that no other frame has.
    const bool is_edited = s.before_edit.has_value();
    const std::int64_t first = is_edited ? frame : s.holds.find_first(frame);
    std::optional<FrameOutput> out = s.held.copy(first, request);
    if (!out) {
        s.held.drop();
        out = s.render(first, request);
        const bool is_needed = !is_edited && (frame > first || s.holds.find_first(frame + 1) == first);
        if (is_needed) s.held.keep(first, request, *out);
    }
    out->statistics.frame = frame;
    if (first != frame) out->statistics.copy_of = first;
    return std::move(*out);
}

}  // namespace aleph
