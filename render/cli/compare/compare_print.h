#pragma once
// The results of a comparison as text and as JSON.

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

nlohmann::ordered_json difference_json(const Difference& difference);
nlohmann::ordered_json figures_json(const ThresholdFigures& figures);

/// Prints the share beyond with the reference's noise taken into account. Nothing without its variance.
/// @param what  such as "beyond, less noise"
void print_less_noise(const std::string& what, const ThresholdFigures& figures);
/// Prints how large the reference's noise is.
void print_noise(const ThresholdFigures& figures);

/// The options whose limits are exceeded, such as "--max-rms"; the share's has a row of its own.
std::string exceeded_options(const CompareResult& result);

}  // namespace aleph
