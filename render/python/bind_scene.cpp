// Loading, saving, and what belongs to the whole scene.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

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

std::string to_json(const py::object& object) {
    const auto plain = [](const py::object& value) -> py::object {
        const py::module_ numpy = py::module_::import("numpy");
        if (py::isinstance(value, numpy.attr("ndarray")) || py::isinstance(value, numpy.attr("generic")))
            return value.attr("tolist")();
        throw py::type_error(fmt::format("{} is no value of a scene", std::string(py::repr(value))));
    };
    const py::object dumps = py::module_::import("json").attr("dumps");
    return dumps(object, py::arg("default") = py::cpp_function(plain)).cast<std::string>();
}

std::shared_ptr<Scene> load(const py::object& source, const py::object& folder) {
    if (py::isinstance<py::dict>(source)) {
        const std::string text = to_json(source);
        const std::filesystem::path place = to_path(folder);
        const py::gil_scoped_release release;
        return std::make_shared<Scene>(load_scene_text(text, place));
    }
    const std::filesystem::path path = to_path(source);
    const py::gil_scoped_release release;
    return std::make_shared<Scene>(load_scene(path));
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
            "save", [](const Scene& s, const py::object& path) { return save_scene(s, to_path(path)); },
            py::arg("path"),
            "Writes a scene file (.json) or binary glTF (.glb). Returns what the file cannot hold, a list of "
            "sentences.")
        .def(
            "to_dict", [](const Scene& s) { return from_json(write_scene_text(without_includes(s, ""), "")); },
            "The scene as the dict of a scene file, without what its includes hold.")
        .def(
            "copy", [](const Scene& s) { return std::make_shared<Scene>(s); }, "A scene of its own.");
    bind_film(scene);
    module.def("load", &load, py::arg("source"), py::arg("folder") = ".",
               R"(Loads a scene.

source: path of a .json, .gltf, .glb or .abc file, or a dict as in a scene file.
folder: of a dict's textures and includes.
Raises InputError with file and place.)");
}

}  // namespace aleph::python
