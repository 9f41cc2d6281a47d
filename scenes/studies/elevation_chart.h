#pragma once
// A chart of the elevations of the three models of vision over velocity.

#include <string>

namespace aleph {

/// The chart as a program for gnuplot (draw_with_gnuplot): f at 16, 4 and 1 cycles per degree over image velocity,
/// which the eye follows with an efficiency of .82; castle at 100 cd/m2, on a display that holds its frames, 30 per
/// second.
std::string elevation_chart_program();

}  // namespace aleph
