// The Python module: what it exports, and how errors reach Python.

#include <pybind11/pybind11.h>

#include "engine/base/errors.h"
#include "render/python/bindings.h"
#include "render/settings/setting_table.h"

namespace aleph::python {

namespace {

/// aleph.InputError: a ValueError with file, place and reason. aleph.OutputError: an OSError.
void bind_errors(py::module_& module) {
    static const py::exception<InputError> input_error(module, "InputError", PyExc_ValueError);
    static const py::exception<OutputError> output_error(module, "OutputError", PyExc_OSError);
    input_error.attr("__doc__") = "Bad input: a scene, a picture, a setting. `file`, `place` and `reason` are texts.";
    output_error.attr("__doc__") = "A file could not be written.";
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const InputError& thrown_error) {
            // The scene of a dict has a folder in place of a file.
            const bool in_dict = thrown_error.file().ends_with('/') && !thrown_error.place().empty();
            const InputError error(in_dict ? "" : thrown_error.file(), thrown_error.place(), thrown_error.reason());
            const py::object raised = static_cast<const py::object&>(input_error)(error.what());
            raised.attr("file") = error.file();
            raised.attr("place") = error.place();
            raised.attr("reason") = error.reason();
            PyErr_SetObject(input_error.ptr(), raised.ptr());
        } catch (const OutputError& error) {
            PyErr_SetString(output_error.ptr(), error.what());
        }
    });
}

/// The model lasts as long as the program: settings may name it.
void add_python_vision(const std::string& name, const py::function& elevation, const py::object& threshold) {
    std::unique_ptr<VisionModel> model = make_vision(name, elevation, threshold);
    add_vision(*model);
    model.release();
}

}  // namespace

}  // namespace aleph::python

PYBIND11_MODULE(_aleph, module) {
    using namespace aleph::python;
    module.attr("__version__") = ALEPH_VERSION;
    bind_errors(module);
    bind_tracks(module);
    bind_materials(module);
    bind_lights_and_cameras(module);
    bind_nodes_and_meshes(module);
    bind_scene(module);
    bind_frames(module);
    bind_sequences(module);
    bind_pictures(module);
    bind_study(module);
    module.def("add_vision", &add_python_vision, py::arg("name"), py::arg("elevation"),
               py::arg("threshold") = py::none(),
               R"(Adds a model of vision, which settings and studies then name: vision="NAME".

elevation(frequency, retinal, tracked, luminance): threshold elevation, the factor by which the least visible contrast
is raised, 1 to 250, for arrays of pixels; frequency in cycles per degree, velocities on the retina and of what the eye follows in degrees
per second, luminance in cd/m2.
threshold(luminance): the least visible difference, cd/m2; None: the thesis's.
A model of the same name that was added before is replaced. Results that a study keeps are found by the name: give
another name, or another folder, when the function changes.)");
}
