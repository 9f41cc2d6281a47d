#pragma once
// Seconds of processor time: less disturbed by other programs than the time of a clock.

#include <ctime>

namespace aleph {

/// That the program has used so far, in all its threads.
inline double processor_seconds() {
    timespec used{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace aleph
