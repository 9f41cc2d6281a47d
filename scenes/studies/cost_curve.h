#pragma once
// What a share of pixels beyond the threshold costs: measured points, and costs between them.

#include <optional>
#include <vector>

namespace aleph {

/// One run.
struct CostPoint {
    double percent = 0.0;  ///< of the pixels beyond their threshold
    double rays = 0.0, seconds = 0.0;
};

struct Cost {
    double rays = 0.0, seconds = 0.0;
};

/// Where the curve through the points, in order of their rays, falls to a percentage and stays there: linear in the
/// logarithms. Nothing if the dearest point is above it, or if none is: then a looser run is needed.
/// @param least_percent  of one pixel or less: stands for a percentage of 0, whose logarithm is infinite
std::optional<Cost> cost_at(std::vector<CostPoint> points, double percent, double least_percent);

}  // namespace aleph
