#pragma once
// Long work that Python waits for, without the interpreter's lock.

#include <pybind11/pybind11.h>

#include <functional>

#include "render/pixels/shaded_frame.h"

namespace aleph::python {

/// Work that reports its progress, and ends with what the report throws.
using Work = std::function<void(const FrameProgress&)>;

/// Does the work with so many threads; 0: one for each processor. Holds the lock at the call, at the return and while
/// the work reports: then it looks for signals and calls `on_progress(fraction, stage)` unless it is None.
/// @throws what the work throws, what `on_progress` raises, KeyboardInterrupt, InputError for a number of threads
/// outside 0 to 4096
void run_without_lock(int threads, const pybind11::object& on_progress, const Work& work);

}  // namespace aleph::python
