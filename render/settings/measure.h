#pragma once
// Measurements of a frame: time of each stage, memory, brightness.

#include <chrono>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// Adds the seconds since the last call, or since it was constructed, to a stage.
class StageClock {
  public:
    void add_to(double& stage) {
        const auto now = std::chrono::steady_clock::now();
        stage += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Peak resident memory of this process so far, MiB.
double peak_memory_mib();

/// Median luminance in cd/m2, of every 16th pixel: exact enough to notice a wrong unit.
double median_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing);

}  // namespace aleph
