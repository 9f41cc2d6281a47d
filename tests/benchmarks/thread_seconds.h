#pragma once

#include <ctime>

namespace aleph {

/// By this clock; without one, the processor time of this thread.
inline double seconds_now(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
    timespec time;
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace aleph
