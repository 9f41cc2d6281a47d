#pragma once
// Studies from Python.

#include <pybind11/pybind11.h>

namespace aleph::python {

void bind_study(pybind11::module_& module);

}  // namespace aleph::python
