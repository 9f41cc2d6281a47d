#pragma once
// The results of a comparison as text and as JSON.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render/cli/compare_options.h"
#include "render/compare_sequence.h"

namespace aleph {

/// Prints one picture's table.
void print_comparison(const CompareOptions& options, const CompareResult& result);
nlohmann::ordered_json comparison_json(const CompareResult& result);

nlohmann::ordered_json difference_json(const Difference& difference);
nlohmann::ordered_json figures_json(const ThresholdFigures& figures);

/// "12.3 %" of the pixels certainly beyond, the share by noise alone, and how large the noise is. Several lines.
void print_noise(const ThresholdFigures& figures);

/// The options whose limits are exceeded, such as "--max-rms"; the share's has a row of its own.
std::string exceeded_options(const CompareResult& result);

}  // namespace aleph
