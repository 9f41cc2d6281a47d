#pragma once
// Pictures as arrays: their maps, and their differences.

#include <pybind11/pybind11.h>

namespace aleph::python {

void bind_pictures(pybind11::module_& module);

}  // namespace aleph::python
