#include "render/python/settings_object.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/errors.h"

namespace aleph::python {

SettingValue to_setting(const std::string& key, const py::handle& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::sequence>(value)) {
        std::vector<std::string> parts;
        for (const py::handle part : value) parts.push_back(py::str(part));
        return fmt::format("{}", fmt::join(parts, key == "size" ? "x" : ","));
    }
    if (PyNumber_Check(value.ptr()) != 0) {
        try {
            return py::float_(py::reinterpret_borrow<py::object>(value)).cast<double>();
        } catch (const py::error_already_set&) {
        }
    }
    throw InputError("", key, "expected a number, text, True or False");
}

GivenSettings read_settings(Scene& scene, const py::dict& arguments, bool keeps_to_error) {
    GivenSettings given;
    SettingMap map;
    for (const auto& [name, value] : arguments) {
        const auto key = name.cast<std::string>();
        const auto function =
            py::isinstance<py::function>(value) ? py::reinterpret_borrow<py::function>(value) : py::function();
        if (!function) {
            if (!value.is_none()) map[key] = to_setting(key, value);
        } else if (key == "vision") {
            given.vision = make_vision("own", function, py::none());
        } else if (key == "adapter") {
            given.adapter = make_adapter(function);
        } else if (key == "sampling") {
            given.rule = make_stopping_rule(function);
            map[key] = std::string("variance");
        } else {
            throw InputError("", key, "a function can be the vision, the adapter or the sampling");
        }
    }
    if (keeps_to_error) add_default_error(scene.source.settings, map);
    apply_settings(given.settings, scene.source.settings, scene.source.file);
    set_scene_numbers(scene, map, "");
    apply_settings(given.settings, map, "");
    if (given.vision) given.settings.perception.vision = given.vision.get();
    given.settings.guide.own_adapter = given.adapter.get();
    given.settings.sampling.own_rule = given.rule.get();
    return given;
}

}  // namespace aleph::python
