#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <limits>

namespace aleph {

/// By this clock; without one, the processor time of this thread.
inline double seconds_now(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
    timespec time;
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

inline double seconds_of(const std::function<void()>& run, clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
    const double start = seconds_now(clock);
    run();
    return seconds_now(clock) - start;
}

/// The least time of several runs, s: other programs may run on the machine.
class Best {
  public:
    explicit Best(clockid_t clock = CLOCK_MONOTONIC) : clock_(clock) {}
    void time(const std::function<void()>& run, double per = 1.0) {
        least = std::min(least, seconds_of(run, clock_) / per);
    }
    double least = std::numeric_limits<double>::infinity();

  private:
    clockid_t clock_;
};

}  // namespace aleph
