#pragma once
// Places on a scale of velocities: 0, then evenly spaced in the logarithm.

#include <cmath>

#include "perception/vision/luminance_curve.h"

namespace aleph {

class VelocityScale {
  public:
    /// @param highest  deg/s
    VelocityScale(int nodes, double highest)
        : intervals_(nodes - 1),
          ratio_(highest / lowest),
          per_octave_(static_cast<float>(nodes - 2) / static_cast<float>(std::log2(ratio_))) {}

    /// deg/s
    double velocity(int node) const {
        return node == 0 ? 0.0 : lowest * std::pow(ratio_, (node - 1) / static_cast<double>(intervals_ - 1));
    }
    /// @param velocity  deg/s; NaN and below 0 count as 0
    LuminanceGrid::Place place(float velocity) const {
        constexpr auto least = static_cast<float>(lowest);
        if (!(velocity > least)) return {0, velocity > 0.0f ? velocity / least : 0.0f};
        return LuminanceGrid::place_at(1.0f + fast_log2(velocity / least) * per_octave_, intervals_);
    }

  private:
    static constexpr double lowest = 0.1;  // deg/s

    int intervals_;
    double ratio_;
    float per_octave_;
};

}  // namespace aleph
