#include "render/python/long_work.h"

#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"

namespace aleph::python {

namespace py = pybind11;

void run_without_lock(int threads, const py::object& on_progress, const Work& work) {
    constexpr int most_threads = 4096;
    if (threads < 0 || threads > most_threads)
        throw InputError("", "threads", fmt::format("{}: expected 0 (all processors) to {}", threads, most_threads));
    const FrameProgress report = [&](double fraction, const char* stage) {
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!on_progress.is_none()) on_progress(fraction, stage);
    };
    const py::gil_scoped_release release;
    const ThreadLimit limit(threads);
    work(report);
}

}  // namespace aleph::python
