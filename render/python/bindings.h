#pragma once
// The parts of the module, and what several of them use.

#include <pybind11/pybind11.h>

#include <filesystem>
#include <functional>
#include <memory>

#include "engine/scene/scene.h"
#include "render/pixels/shaded_frame.h"

namespace aleph::python {

namespace py = pybind11;

// Each adds its classes and functions; classes that others name come first.
void bind_tracks(py::module_& module);
void bind_materials(py::module_& module);
void bind_lights_and_cameras(py::module_& module);
void bind_nodes_and_meshes(py::module_& module);
void bind_scene(py::module_& module);
void bind_frames(py::module_& module);
void bind_sequences(py::module_& module);
void bind_pictures(py::module_& module);
void bind_study(py::module_& module);

/// Text of a str or an os.PathLike.
std::filesystem::path to_path(const py::object& path);

/// json.loads of the text.
py::object from_json(const std::string& text);

/// json.dumps of the object.
std::string to_json(const py::object& object);

/// aleph.load
/// @param folder  of the files that a dict names
std::shared_ptr<Scene> load(const py::object& source, const py::object& folder);

/// Work that reports its progress, and ends with what the report throws.
using Work = std::function<void(const FrameProgress&)>;

/// Does the work with so many threads; 0: one for each processor. Holds the lock at the call, at the return and while
/// the work reports: then it looks for signals and calls `on_progress(fraction, stage)` unless it is None.
/// @throws what the work throws, what `on_progress` raises, KeyboardInterrupt, InputError for a number of threads
/// outside 0 to 4096
void run_without_lock(int threads, const py::object& on_progress, const Work& work);

}  // namespace aleph::python
