#pragma once
// Nodes, materials, lights, cameras and meshes of a scene as Python sees them: a place in the scene, not a copy.

#include <fmt/format.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"
#include "engine/scene/place.h"
#include "engine/scene/scene.h"
#include "render/python/track_values.h"

namespace aleph::python {

template <class E>
using ElementList = std::vector<E> Scene::*;

/// One element. It keeps its scene.
template <class E>
struct Element {
    std::shared_ptr<Scene> scene;
    ElementList<E> list;
    std::size_t index = 0;

    E& get() const { return (scene.get()->*list).at(index); }
    bool operator==(const Element& other) const { return scene == other.scene && index == other.index; }
};

/// All elements of a kind.
template <class E>
struct Elements {
    std::shared_ptr<Scene> scene;
    ElementList<E> list;
    const char* kind;

    std::size_t size() const { return (scene.get()->*list).size(); }
    Element<E> at(std::size_t index) const { return {scene, list, index}; }
};

/// The element at an index, or None.
template <class E>
py::object element_or_none(const std::shared_ptr<Scene>& scene, ElementList<E> list, int index) {
    if (index == no_index) return py::none();
    return py::cast(Element<E>{scene, list, static_cast<std::size_t>(index)});
}

template <class E>
std::size_t find_element(const Elements<E>& all, const std::string& name) {
    const std::vector<E>& list = all.scene.get()->*all.list;
    const auto found = std::ranges::find(list, name, &E::name);
    if (found == list.end()) {
        std::vector<std::string> known;
        for (const E& element : list) known.push_back(element.name);
        throw py::key_error(fmt::format("there is no {} '{}'{}", all.kind, name, suggestion(name, known)));
    }
    return static_cast<std::size_t>(found - list.begin());
}

/// Binds the class of an element and that of its list. @return the class, for its properties
template <class E>
py::class_<Element<E>> bind_elements(py::module_& module, const char* name, const std::string& list_name,
                                     const char* doc) {
    py::class_<Element<E>> element(module, name, doc);
    element
        .def_property_readonly(
            "name", [](const Element<E>& e) { return e.get().name; }, "Its name.")
        .def_property_readonly(
            "index", [](const Element<E>& e) { return e.index; }, "Its place in the scene's list.")
        .def("__eq__", [](const Element<E>& a,
                          const py::object& b) { return py::isinstance<Element<E>>(b) && a == b.cast<Element<E>>(); })
        .def("__hash__", [](const Element<E>& e) { return e.index; })
        .def("__repr__", [name](const Element<E>& e) { return fmt::format("<aleph.{} '{}'>", name, e.get().name); });
    const std::string list_doc = fmt::format("Every {} of a scene, by index or by name.", name);
    py::class_<Elements<E>>(module, list_name.c_str(), list_doc.c_str())
        .def("__len__", &Elements<E>::size)
        .def("__getitem__",
             [](const Elements<E>& all, py::ssize_t index) {
                 const auto size = static_cast<py::ssize_t>(all.size());
                 if (index < -size || index >= size)
                     throw py::index_error(fmt::format("there is no {} {}; the scene has {}", all.kind, index, size));
                 return all.at(static_cast<std::size_t>(index < 0 ? index + size : index));
             })
        .def("__getitem__",
             [](const Elements<E>& all, const std::string& wanted) { return all.at(find_element(all, wanted)); })
        .def("__contains__", [](const Elements<E>& all, const std::string& wanted) {
            const std::vector<E>& list = all.scene.get()->*all.list;
            return std::ranges::find(list, wanted, &E::name) != list.end();
        });
    return element;
}

/// Adds a track as a property. @param path  of members, from the element to the track
template <auto... path, class E>
void add_track(py::class_<Element<E>>& element, const char* name, const char* doc, double unit = 1.0) {
    using Value = std::remove_cvref_t<decltype(at<path...>(std::declval<E&>()).values.front())>;
    const std::string kind = py::str(element.attr("__name__"));
    element.def_property(
        name, [unit](const Element<E>& e) { return track_to_python(at<path...>(e.get()), unit); },
        [unit, kind, property = std::string(name)](const Element<E>& e, const py::object& value) {
            const std::string place = fmt::format("{} '{}': {}", kind, e.get().name, property);
            at<path...>(e.get()) = track_from_python<Value>(value, place, unit);
            if constexpr ((std::is_same_v<decltype(path), LocalTransform Node::*> || ...))
                e.get().transform.operations.reset();
        },
        doc);
}

/// Adds a plain field as a property.
template <class E, class Value>
void add_field(py::class_<Element<E>>& element, const char* name, const char* doc, Value E::*field) {
    element.def_property(
        name, [field](const Element<E>& e) { return e.get().*field; },
        [field](const Element<E>& e, const Value& value) { e.get().*field = value; }, doc);
}

}  // namespace aleph::python
