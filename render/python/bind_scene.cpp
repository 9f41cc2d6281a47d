// Loading, saving, and what belongs to the whole scene.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "engine/scene_file/scene_text.h"
#include "render/python/bindings.h"
#include "render/python/elements.h"

namespace aleph::python {

std::filesystem::path to_path(const py::object& path) {
    return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

py::object from_json(const std::string& text) {
    return py::module_::import("json").attr("loads")(text);
}

namespace {

/// json.dumps, which takes numbers and arrays of numpy too.
/// @return why the value cannot be JSON; nothing where `text` is set to it
std::optional<std::string> dump_json(const py::handle& value, std::string& text) {
    const auto plain = [](const py::object& part) -> py::object {
        const py::module_ numpy = py::module_::import("numpy");
        if (py::isinstance(part, numpy.attr("ndarray")) || py::isinstance(part, numpy.attr("generic")))
            return part.attr("tolist")();
        throw py::type_error(fmt::format("{} is no value of a scene", std::string(py::repr(part))));
    };
    const py::object dumps = py::module_::import("json").attr("dumps");
    try {
        text = dumps(value, py::arg("default") = py::cpp_function(plain), py::arg("allow_nan") = false)
                   .cast<std::string>();
        return std::nullopt;
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
        if (PyFloat_Check(value.ptr()) != 0)
            return fmt::format("expected a finite number, found {}", value.cast<double>());
        return std::string(py::str(error.value()));
    }
}

}  // namespace

std::string to_json(const py::object& object) {
    std::string text;
    std::optional<std::string> fault = dump_json(object, text);
    if (!fault) return text;
    constexpr int deepest = 64;  // a list may hold itself
    nlohmann::json::json_pointer place;
    py::object inner = object;
    for (int depth = 0; !inner.is_none() && depth < deepest; ++depth) {
        py::object value = std::exchange(inner, py::none());
        if (py::hasattr(value, "tolist")) value = value.attr("tolist")();
        if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value))
            value = py::module_::import("builtins").attr("enumerate")(value);
        else if (!py::isinstance<py::dict>(value))
            break;
        for (const auto& [key, part] : py::dict(value)) {
            const std::optional<std::string> found = dump_json(part, text);
            if (!found) continue;
            fault = found;
            place /= std::string(py::str(key));
            inner = py::reinterpret_borrow<py::object>(part);
            break;
        }
    }
    throw InputError("", place.to_string(), *fault);
}

void warn(const std::string& text) {
    if (PyErr_WarnFormat(PyExc_UserWarning, 1, "%s", text.c_str()) != 0) throw py::error_already_set();
}

std::shared_ptr<Scene> load(const py::object& source, const py::object& folder) {
    if (source.is_none())
        throw InputError("", "scene", "expected the path of a scene file, such as 'scene.json', or a dict as in one");
    const bool is_dict = py::isinstance<py::dict>(source);
    const std::string text = is_dict ? to_json(source) : "";
    const std::filesystem::path path = to_path(is_dict ? folder : source);
    std::shared_ptr<Scene> scene;
    {
        const py::gil_scoped_release release;
        scene = std::make_shared<Scene>(is_dict ? load_scene_text(text, path) : load_scene(path));
    }
    for (const std::string& warning : scene->source.warnings) warn(warning);
    return scene;
}

namespace {

/// A number, "30000/1001" or a Fraction.
void set_frame_rate(Scene& scene, const py::object& value) {
    FrameRate rate{0, 1};
    try {
        const py::object fraction =
            py::module_::import("fractions").attr("Fraction")(value).attr("limit_denominator")(1000000);
        rate = {fraction.attr("numerator").cast<std::int64_t>(), fraction.attr("denominator").cast<std::int64_t>()};
    } catch (const std::exception&) {  // no number: refused below
    }
    if (!(rate.numerator > 0 && rate.numerator <= 1000000))
        throw InputError("", "fps", "expected frames per second, such as 30 or '30000/1001'");
    change_frame_rate(scene.film, rate);
}

py::dict list_settings(const Scene& scene) {
    py::dict settings;
    for (const auto& [key, value] : scene.source.settings)
        settings[py::str(key)] = std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
    return settings;
}

/// (nodes, 4, 4)
py::array_t<double> world_matrices(const Scene& scene, double frame) {
    const FrameRate& rate = scene.film.frame_rate;
    const ScenePose posed =
        pose(scene, frame * static_cast<double>(rate.denominator) / static_cast<double>(rate.numerator));
    py::array_t<double> out({static_cast<py::ssize_t>(posed.world.size()), py::ssize_t{4}, py::ssize_t{4}});
    for (std::size_t i = 0; i < posed.world.size(); ++i) track_parts::put(posed.world[i], out.mutable_data() + 16 * i);
    return out;
}

py::object world_matrix(const std::shared_ptr<Scene>& scene, const std::string& name, double frame) {
    const std::size_t index = find_element(Elements<Node>{scene, &Scene::nodes, "node"}, name);
    return world_matrices(*scene, frame)[py::int_(index)];
}

template <class E>
auto elements(ElementList<E> list, const char* kind) {
    return [=](const std::shared_ptr<Scene>& scene) { return Elements<E>{scene, list, kind}; };
}

using SceneClass = py::class_<Scene, std::shared_ptr<Scene>>;

void bind_film(SceneClass& scene) {
    scene
        .def_property(
            "fps", [](const Scene& s) { return s.film.frame_rate.per_second(); }, &set_frame_rate,
            "Frames per second: a number, a fractions.Fraction or text such as '30000/1001'.")
        .def_property(
            "frames",
            [](const Scene& s) {
                const FrameRange range = frame_range(s);
                return std::pair(range.first, range.last);
            },
            [](Scene& s, std::pair<std::int64_t, std::int64_t> frames) {
                if (frames.second < frames.first) throw InputError("", "frames", "the last frame is before the first");
                s.film.range = FrameRange{frames.first, frames.second};
            },
            "First and last frame.")
        .def_property(
            "camera", [](const Scene& s) { return s.film.camera; },
            [](Scene& s, const std::string& name) {
                CameraNames(s).find(name);
                s.film.camera = name;
            },
            "Name of the camera or of its node that looks; '': the first.")
        .def_property(
            "exposure", [](const Scene& s) { return s.film.exposure; },
            [](Scene& s, std::optional<double> value) {
                if (value && !(*value > 0.0 && std::isfinite(*value)))
                    throw InputError("", "exposure", "expected a number above 0, or None");
                s.film.exposure = value;
            },
            "Factor on radiance; None: found from the first frame.");
}

}  // namespace

void bind_scene(py::module_& module) {
    SceneClass scene(module, "Scene", R"(An animated scene (aleph.load).

Elements are read and changed in place: scene.nodes["ball"].translation = aleph.Track(scene.seconds([0, 30]),
[[0, 0, 0], [1, 0, 0]]). What is added is written as a scene file: aleph.load of a dict. Right-handed, y up, metres,
degrees, linear Rec.709.)");
    scene.def_property_readonly("nodes", elements(&Scene::nodes, "node"), "Nodes, parents before children.")
        .def_property_readonly("materials", elements(&Scene::materials, "material"), "Materials.")
        .def_property_readonly("meshes", elements(&Scene::meshes, "mesh"), "Meshes.")
        .def_property_readonly("lights", elements(&Scene::lights, "light"), "Lights, but for emissive meshes.")
        .def_property_readonly("cameras", elements(&Scene::cameras, "camera"), "Cameras.")
        .def_property_readonly(
            "name", [](const Scene& s) { return s.source.name; }, "Its name.")
        .def_property_readonly(
            "warnings", [](const Scene& s) { return s.source.warnings; },
            "What was read and has no effect, and other notes of loading.")
        .def_property_readonly("settings", &list_settings,
                               "Render settings of the file; arguments of render override them.")
        .def(
            "seconds",
            [](const Scene& s, const py::object& frames) {
                return py::module_::import("numpy").attr("asarray")(frames, "float64") *
                       py::float_(static_cast<double>(s.film.frame_rate.denominator)) /
                       py::float_(static_cast<double>(s.film.frame_rate.numerator));
            },
            py::arg("frames"), "Seconds of a frame number or an array of them.")
        .def("world", &world_matrix, py::arg("node"), py::arg("frame"),
             "From the space of a node, by name, to the world at a frame: (4, 4) for column vectors.")
        .def("worlds", &world_matrices, py::arg("frame"), "The same of all nodes, (nodes, 4, 4).")
        .def(
            "save",
            [](const Scene& s, const py::object& to) {
                const std::filesystem::path path = to_path(to);
                require_format(scene_formats(), FormatUse::save, path, path.string(), "");
                try_output(path);
                return save_scene(s, path);
            },
            py::arg("path"),
            "Writes a scene file (.json) or binary glTF (.glb). Makes missing folders. Returns what the file cannot "
            "hold, a list of "
            "sentences.")
        .def(
            "to_dict", [](const Scene& s) { return from_json(write_scene_text(without_includes(s, ""), "")); },
            "The scene as the dict of a scene file, without what its includes hold.")
        .def(
            "copy", [](const Scene& s) { return std::make_shared<Scene>(s); }, "A scene of its own.");
    bind_film(scene);
    module.def("load", &load, py::arg("source") = py::none(), py::arg("folder") = ".",
               R"(Loads a scene.

source: path of a .json, .gltf, .glb or .abc file, or a dict as in a scene file.
folder: of a dict's textures and includes.
What is read and has no effect gives a UserWarning (Scene.warnings has all of them). Raises InputError with file and place.)");
}

}  // namespace aleph::python
