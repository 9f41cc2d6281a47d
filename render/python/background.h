#pragma once
// Long work that Python waits for: it runs in a thread of its own, without the interpreter's lock.

#include <pybind11/pybind11.h>

#include <functional>

#include "render/pixels/shaded_frame.h"

namespace aleph::python {

/// Work that reports its progress, and ends with what the report throws.
using Work = std::function<void(const FrameProgress&)>;

/// Runs the work with so many threads; 0: one for each processor. Meanwhile this thread, which holds the lock at the
/// call and at the return, calls `on_progress(fraction, stage)` unless it is None, and looks for signals: Ctrl-C, and
/// what `on_progress` raises, end the work at its next report.
/// @throws what the work throws, what `on_progress` raises, KeyboardInterrupt, InputError for a number of threads
/// outside 0 to 4096
void run_in_background(int threads, const pybind11::object& on_progress, const Work& work);

}  // namespace aleph::python
