#pragma once
// Render settings from the arguments of a Python function.

#include <pybind11/pybind11.h>

#include <memory>

#include "engine/scene/scene.h"
#include "render/python/hooks.h"
#include "render/settings/settings.h"

namespace aleph::python {

/// Settings, and the functions that they point to.
struct GivenSettings {
    RenderSettings settings;
    std::unique_ptr<VisionModel> vision;
    std::unique_ptr<AccuracyAdapter> adapter;
    std::unique_ptr<StoppingRule> rule;
};

/// A setting's value: a bool, a number, text, or a sequence (a size, or a list of names).
/// @throws InputError naming the key
SettingValue to_setting(const std::string& key, const py::handle& value);

/// The scene's settings with the arguments in their places. Numbers of the scene (exposure) go there. `vision`,
/// `adapter` and `sampling` may be functions.
/// @param keeps_to_error  without a setting that chooses the work, an error of 1 is asked for
/// @throws InputError
GivenSettings read_settings(Scene& scene, const py::dict& arguments, bool keeps_to_error);

}  // namespace aleph::python
