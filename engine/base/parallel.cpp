#include "engine/base/parallel.h"

#include <atomic>
#include <thread>

#if !defined(ALEPH_STD_THREADS)
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

namespace aleph {

#if defined(ALEPH_STD_THREADS)

namespace {
std::atomic<int> thread_limit{0};
int hardware_threads() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}
}  // namespace

struct ThreadLimit::State {
    int previous;
};

ThreadLimit::ThreadLimit(int threads) : state_(new State{thread_limit.exchange(threads)}) {}
ThreadLimit::~ThreadLimit() {
    thread_limit = state_->previous;
}

int thread_count() {
    return thread_limit > 0 ? thread_limit.load() : hardware_threads();
}

#else

struct ThreadLimit::State {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
    if (threads > 0) {
        state_.reset(new State{
            tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads))});
    }
}
ThreadLimit::~ThreadLimit() = default;

int thread_count() {
    return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

#endif

}  // namespace aleph
