#pragma once
// Counts what a piece of work allocates, by all threads: the same numbers on every machine, whatever else it does. A
// program that counts has allocations.cpp among its sources.

#include <cstddef>
#include <functional>

namespace aleph {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool allocations_count = false;  // the sanitizer has an allocator of its own
#else
inline constexpr bool allocations_count = true;
#endif

struct Allocations {
    std::size_t calls = 0;
    std::size_t bytes = 0;  ///< of all calls
    std::size_t peak = 0;   ///< bytes at one time, beyond those held before the work

    double peak_mebibytes() const { return static_cast<double>(peak) / (1 << 20); }
};

/// The allocations of `work`; zeros under a sanitizer. An exception passes through.
Allocations count_allocations(const std::function<void()>& work);

}  // namespace aleph
