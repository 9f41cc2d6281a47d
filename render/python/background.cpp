#include "render/python/background.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"

namespace aleph::python {

namespace py = pybind11;

namespace {

constexpr std::chrono::milliseconds between_signals{50};

struct Stopped {};

struct Report {
    double fraction = 0.0;
    std::string stage;
    bool is_new = false, is_last = false;
};

/// Threads that wait for work. They are kept: Embree keeps memory for every thread that it has met. They end with the
/// process.
class Workers {
  public:
    void start(std::function<void()> job) {
        const std::lock_guard lock(mutex_);
        if (jobs_.size() >= idle_) std::thread([this] { work(); }).detach();
        jobs_.push_back(std::move(job));
        wake_.notify_one();
    }

  private:
    void work() {
        std::unique_lock lock(mutex_);
        while (true) {
            ++idle_;
            wake_.wait(lock, [this] { return !jobs_.empty(); });
            --idle_;
            const std::function<void()> job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            job();
            lock.lock();
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> jobs_;
    std::size_t idle_ = 0;
};

/// The threads of this process: a child that was forked has none of its parent's threads.
Workers& find_workers() {
    static Workers* workers = nullptr;
    static pid_t process = 0;
    if (process != getpid()) {
        workers = new Workers();
        process = getpid();
    }
    return *workers;
}

class Background {
  public:
    /// @param work  lasts until this ends
    explicit Background(const Work& work) {
        find_workers().start([state = state_, &work] { run(*state, work); });
    }
    ~Background() {
        stop();
        while (!wait().is_last) continue;
    }

    void stop() { state_->stops = true; }

    /// Waits for the next report, but no longer than signals may wait. The lock is free meanwhile: the work may need
    /// it.
    Report wait() {
        const py::gil_scoped_release release;
        std::unique_lock lock(state_->mutex);
        state_->changed.wait_for(lock, between_signals,
                                 [&] { return state_->report.is_new || state_->report.is_last; });
        Report report = state_->report;
        state_->report.is_new = false;
        return report;
    }

    /// The exception that ended the work; null if it did not.
    std::exception_ptr failure() const { return std::exchange(state_->failure, nullptr); }

  private:
    struct State {
        std::mutex mutex;
        std::condition_variable changed;
        Report report;
        std::atomic<bool> stops = false;
        std::exception_ptr failure;
    };

    static void run(State& state, const Work& work) {
        try {
            work([&](double fraction, const char* stage) {
                if (state.stops) throw Stopped();
                const std::lock_guard lock(state.mutex);
                state.report = {fraction, stage, true, false};
                state.changed.notify_one();
            });
        } catch (...) {
            state.failure = std::current_exception();
        }
        const std::lock_guard lock(state.mutex);
        state.report.is_last = true;
        state.changed.notify_one();
    }

    std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace

void run_in_background(int threads, const py::object& on_progress, const Work& work) {
    constexpr int most_threads = 4096;
    if (threads < 0 || threads > most_threads)
        throw InputError("", "threads", std::to_string(threads) + ": expected 0 (all processors) to 4096");
    const Work limited = [&](const FrameProgress& progress) {
        const ThreadLimit limit(threads);
        work(progress);
    };
    std::exception_ptr raised, failure;
    {
        Background background(limited);
        for (Report report; !report.is_last;) {
            report = background.wait();
            if (raised) continue;
            try {
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                if (report.is_new && !on_progress.is_none()) on_progress(report.fraction, report.stage);
            } catch (...) {
                raised = std::current_exception();
                background.stop();
            }
        }
        failure = background.failure();
    }
    if (raised) std::rethrow_exception(raised);
    if (failure) std::rethrow_exception(failure);
}

}  // namespace aleph::python
