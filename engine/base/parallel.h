#pragma once
// Parallel loops over chunks that are the same for any number of threads; so are results combined in chunk order.
// ALEPH_STD_THREADS replaces oneTBB by std::thread for ThreadSanitizer, which reports false races in oneTBB.

#include <algorithm>
#include <cstddef>

#include "engine/base/flush_denormals.h"

#if defined(ALEPH_STD_THREADS)
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <optional>
#endif

namespace aleph {

/// Limits the number of threads of parallel_for during its lifetime. 0: all that the machine has.
class ThreadLimit {
  public:
#if defined(ALEPH_STD_THREADS)
    explicit ThreadLimit(int threads) : previous_(now.exchange(threads)) {}
    ~ThreadLimit() {
        now = previous_;
    }
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

    static inline std::atomic<int> now{0};

  private:
    int previous_;
#else
    explicit ThreadLimit(int threads) {
        if (threads > 0)
            control_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }

  private:
    std::optional<tbb::global_control> control_;
#endif
};

/// Number of threads that parallel_for may use now.
inline int thread_count() {
#if defined(ALEPH_STD_THREADS)
    const int limit = ThreadLimit::now;
    return limit > 0 ? limit : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
#else
    return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
#endif
}

/// Calls body(begin, end) for the ranges [0, grain), [grain, 2 grain), ... of [0, count), in any order, on any thread.
/// The first exception thrown by a body reaches the caller.
template <class Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t step = std::max<std::size_t>(1, grain);
    const std::size_t chunks = (count + step - 1) / step;
    const auto run_chunk = [&](std::size_t chunk) {
        const FlushDenormals flush;
        body(chunk * step, std::min(count, (chunk + 1) * step));
    };
    if (chunks <= 1 || thread_count() <= 1) {
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) run_chunk(chunk);
        return;
    }
#if defined(ALEPH_STD_THREADS)
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto work = [&] {
        for (std::size_t chunk = next++; chunk < chunks; chunk = next++) {
            try {
                run_chunk(chunk);
            } catch (...) {
                const std::lock_guard lock(failure_mutex);
                if (!failure) failure = std::current_exception();
                next = chunks;
            }
        }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < thread_count(); ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
#else
    tbb::parallel_for(std::size_t{0}, chunks, run_chunk);
#endif
}

/// Calls visit(i) for each i below count, on any thread, `grain` of them in a row.
template <class Visit>
void parallel_each(std::size_t count, std::size_t grain, const Visit& visit) {
    parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) visit(i);
    });
}

/// Rows that one thread takes at a time where a row is quick work.
inline constexpr int rows_per_band = 32;

/// parallel_for over the rows of an image: body(begin, end) takes rows as int.
/// @param rows_per_chunk  at least 1
template <class Body>
void parallel_rows(int rows, int rows_per_chunk, const Body& body) {
    parallel_for(static_cast<std::size_t>(std::max(0, rows)), static_cast<std::size_t>(rows_per_chunk),
                 [&](std::size_t begin, std::size_t end) { body(static_cast<int>(begin), static_cast<int>(end)); });
}

}  // namespace aleph
