#pragma once
// Render settings from the arguments of a Python function.

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "engine/scene/scene.h"
#include "perception/vision/vision_model.h"
#include "render/guide/accuracy_map.h"
#include "render/guide/stopping_rule.h"
#include "render/settings/settings.h"

namespace aleph::python {

namespace py = pybind11;

/// elevation(frequency, retinal, tracked, luminance) gives f for arrays of pixels; threshold(luminance) the least
/// visible difference, both cd/m2; None: the thesis's. They are called from any thread, one at a time, with the
/// interpreter's lock; so are the functions of GivenSettings.
std::unique_ptr<VisionModel> make_vision(const std::string& name, const py::function& elevation,
                                         const py::object& threshold);

/// Settings, and the functions that they point to.
struct GivenSettings {
    RenderSettings settings;
    std::unique_ptr<VisionModel> vision;
    std::unique_ptr<AccuracyAdapter> adapter;
    std::unique_ptr<StoppingRule> rule;
};

/// The scene's settings with the arguments in their places. Numbers of the scene (exposure) go there. Functions may be
/// `vision`; `adapter`(aleph, accuracy), which gives the accuracy of each pixel; and `sampling`(x, y, samples, error,
/// deviation, tolerance), True where a pixel has enough samples.
/// @param keeps_to_error  without a setting that chooses the work, an error of 1 is asked for
/// @throws InputError
GivenSettings read_settings(Scene& scene, const py::dict& arguments, bool keeps_to_error);

}  // namespace aleph::python
