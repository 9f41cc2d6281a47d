#pragma once
// Error against time as a PNG, drawn by gnuplot where that is installed.

#include <filesystem>
#include <string>

#include "render/study/run_study.h"

namespace aleph {

/// The chart as a program for gnuplot: a point per variant, coloured by the values of the last axis of the sweep, with
/// error bars where repeats tell them, and the variants on the front joined by a line. Both axes are logarithmic; an
/// error of 0 stands at the lower edge.
std::string plot_program(const PreparedStudy& prepared, const StudyResults& results);

/// Runs gnuplot.
/// @param program  whose output is "plot.png"
/// @return false if gnuplot is not installed, or failed
/// @throws OutputError
bool draw_with_gnuplot(const std::filesystem::path& png, const std::string& program);

}  // namespace aleph
