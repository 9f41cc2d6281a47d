#pragma once
// Scenes as Python sees them.

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>

#include "engine/scene/scene.h"

namespace aleph::python {

namespace py = pybind11;

/// Text of a str or an os.PathLike.
std::filesystem::path to_path(const py::object& path);

/// json.loads of the text.
py::object from_json(const std::string& text);

/// json.dumps of the object.
std::string to_json(const py::object& object);

/// aleph.load
/// @param folder  of the files that a dict names
std::shared_ptr<Scene> load(const py::object& source, const py::object& folder);

}  // namespace aleph::python
