#include "engine/base/parallel.h"

// ALEPH_STD_THREADS replaces oneTBB by std::thread for ThreadSanitizer, which reports false races in oneTBB.
#if defined(ALEPH_STD_THREADS)
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#else
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#endif

namespace aleph {

#if defined(ALEPH_STD_THREADS)

namespace {

std::atomic<int> thread_limit{0};

void run_on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto take_turns = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(failure_mutex);
                if (!failure) failure = std::current_exception();
                next = count;
            }
        }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < thread_count(); ++i) threads.emplace_back(take_turns);
    take_turns();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace

ThreadLimit::ThreadLimit(int threads)
    : control_(nullptr, [previous = thread_limit.exchange(threads)](std::nullptr_t) { thread_limit = previous; }) {}

int thread_count() {
    const int limit = thread_limit;
    return limit > 0 ? limit : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

#else

using Control = tbb::global_control;

ThreadLimit::ThreadLimit(int threads) {
    if (threads > 0)
        control_ = std::make_shared<Control>(Control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}

int thread_count() {
    return static_cast<int>(Control::active_value(Control::max_allowed_parallelism));
}

#endif

void run_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
    if (count <= 1 || thread_count() <= 1) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
#if defined(ALEPH_STD_THREADS)
    run_on_threads(count, work);
#else
    tbb::parallel_for(std::size_t{0}, count, work);
#endif
}

}  // namespace aleph
