#pragma once
// Python functions on arrays as parts of the guide: a model of vision, an adapter, a stopping rule. They are called
// from any thread, one at a time, with the interpreter's lock.

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "perception/vision/vision_model.h"
#include "render/guide/accuracy_map.h"
#include "render/guide/stopping_rule.h"

namespace aleph::python {

namespace py = pybind11;

/// elevation(frequency, retinal, tracked, luminance) gives f for arrays of pixels; threshold(luminance) the least
/// visible difference, both cd/m2; None: the thesis's.
std::unique_ptr<VisionModel> make_vision(const std::string& name, const py::function& elevation,
                                         const py::object& threshold);

/// adapter(aleph, accuracy) gives the accuracy of each pixel.
std::unique_ptr<AccuracyAdapter> make_adapter(const py::function& adapter);

/// rule(x, y, samples, error, deviation, tolerance) gives True where a pixel has enough samples.
std::unique_ptr<StoppingRule> make_stopping_rule(const py::function& rule);

}  // namespace aleph::python
