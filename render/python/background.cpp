#include "render/python/background.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
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

class Background {
  public:
    explicit Background(const Work& work) : thread_([this, &work] { run(work); }) {}
    ~Background() {
        stop();
        const py::gil_scoped_release release;  // the work may wait for the lock
        thread_.join();
    }

    void stop() { stops_ = true; }

    /// Waits for the next report, but no longer than signals may wait.
    Report wait() {
        const py::gil_scoped_release release;
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, between_signals, [&] { return report_.is_new || report_.is_last; });
        Report report = report_;
        report_.is_new = false;
        return report;
    }

    /// What the work threw; null if it did not.
    std::exception_ptr failure() const { return failure_; }

  private:
    void run(const Work& work) {
        try {
            work([this](double fraction, const char* stage) {
                if (stops_) throw Stopped();
                const std::lock_guard lock(mutex_);
                report_ = {fraction, stage, true, false};
                changed_.notify_one();
            });
        } catch (...) {
            failure_ = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        report_.is_last = true;
        changed_.notify_one();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    Report report_;
    std::atomic<bool> stops_ = false;
    std::exception_ptr failure_;
    std::thread thread_;  ///< after what it uses
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
