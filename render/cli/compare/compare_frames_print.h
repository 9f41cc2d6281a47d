#pragma once
// The comparison of two sequences as text and as JSON.

#include "render/cli/compare/compare_options.h"
#include "render/compare/compare_sequence.h"

namespace aleph {

/// One line per frame, and a summary.
void print_sequence(const CompareOptions& options, const std::vector<FrameComparison>& frames,
                    const SequenceSummary& summary);

void print_sequence_json(const std::vector<FrameComparison>& frames, const SequenceSummary& summary);

}  // namespace aleph
