#pragma once
// Parallel loops over chunks that are the same for any number of threads; so are results combined in chunk order.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <vector>

#include "engine/base/flush_denormals.h"

namespace aleph {

/// Limits the number of threads of parallel_for during its lifetime. 0: all that the machine has.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);

  private:
    std::shared_ptr<const void> control_;
};

/// Number of threads that parallel_for may use now.
int thread_count();

/// Calls work(i) for each i below count, in any order, on any thread.
/// The first exception thrown by a call reaches the caller.
void run_parallel(std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls body(begin, end) for the ranges [0, grain), [grain, 2 grain), ... of [0, count), as run_parallel does.
template <class Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
    const std::size_t step = std::max<std::size_t>(1, grain);
    const auto run_chunk = [&](std::size_t chunk) {
        const FlushDenormals flush;
        body(chunk * step, std::min(count, (chunk + 1) * step));
    };
    run_parallel((count + step - 1) / step, std::cref(run_chunk));
}

/// Calls visit(i) for each i below count, on any thread, `grain` of them in a row.
template <class Visit>
void parallel_each(std::size_t count, std::size_t grain, const Visit& visit) {
    parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) visit(i);
    });
}

/// Calls visit(i) for each i below count, on any thread. The exception of the lowest i reaches the caller.
template <class Visit>
void parallel_in_order(std::size_t count, const Visit& visit) {
    std::vector<std::exception_ptr> errors(count);
    parallel_each(count, 1, [&](std::size_t i) {
        try {
            visit(i);
        } catch (...) {
            errors[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
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
