#pragma once
// A chart of the elevations of the three models of vision over velocity.

#include <string>

#include "engine/base/frame_rate.h"
#include "perception/perception_settings.h"

namespace aleph {

/// f of the library's double functions at a retinal velocity and what the eye follows, both deg/s.
double model_elevation(Vision vision, double rho, double retinal, double tracked, double luminance, double persistence,
                       const FrameRate& frame_rate);

/// The chart as a program for gnuplot (draw_with_gnuplot): f at 16, 4 and 1 cycles per degree over image velocity,
/// which the eye follows with an efficiency of .82; castle at 100 cd/m2, on a display that holds its frames, 30 per
/// second.
std::string elevation_chart_program();

}  // namespace aleph
