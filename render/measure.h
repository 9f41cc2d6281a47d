#pragma once
// What the stages of a frame say about themselves: time, memory, brightness.

#include <chrono>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// Adds the time since its last call (or since it was made) to a stage.
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

/// The most that this process has held so far.
double peak_memory_mib();

/// cd/m2, of every 16th pixel: enough to tell a wrong unit from a right one.
double median_luminance(const Image<Rgb>& estimate, const ViewingConditions& viewing);

}  // namespace aleph
