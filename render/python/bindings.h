#pragma once
// The parts of the module. Each adds its classes and functions; classes that others name come first.

#include <pybind11/pybind11.h>

namespace aleph::python {

void bind_tracks(pybind11::module_& module);
void bind_materials(pybind11::module_& module);
void bind_lights_and_cameras(pybind11::module_& module);
void bind_nodes_and_meshes(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_frames(pybind11::module_& module);
void bind_sequences(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_study(pybind11::module_& module);

}  // namespace aleph::python
