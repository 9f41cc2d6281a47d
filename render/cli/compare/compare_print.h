#pragma once
// The results of a comparison as text, as JSON and as pictures.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render/cli/compare/compare_options.h"
#include "render/compare/compare_sequence.h"

namespace aleph {

/// Prints one picture's table.
void print_comparison(const CompareOptions& options, const CompareResult& result,
                      const std::optional<VisibleShares>& visible);
nlohmann::ordered_json shares_json(const std::optional<VisibleShares>& shares);
nlohmann::ordered_json comparison_json(const CompareResult& result);

/// One line per frame, and a summary.
void print_sequence(const CompareOptions& options, const std::vector<FrameComparison>& frames,
                    const SequenceSummary& summary);

void print_sequence_json(const std::vector<FrameComparison>& frames, const SequenceSummary& summary);

/// The options whose limits are exceeded, such as "--max-rms"; the share's has a row of its own.
std::string exceeded_options(const CompareResult& result);

/// Writes seen, flicker and lasting in just visible differences: as the channels seen.Y, flicker.Y and lasting.Y if the
/// path ends in .exr, else as three panels with a colour scale from .1 to 10.
/// @throws OutputError naming the file
void write_seen(const std::filesystem::path& path, const VisibleMaps& maps);

}  // namespace aleph
