#include "render/python/track_values.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "engine/scene_file/fields.h"
#include "render/python/bindings.h"

namespace aleph::python {

namespace {

KeyedTrack make_track(const std::vector<double>& times, const py::array_t<double>& values, const std::string& word) {
    const auto found = std::ranges::find(interpolation_words, word);
    if (found == interpolation_words.end())
        throw InputError("", "Track", "interpolation is one of step, linear, nearest and cubic");
    if (values.ndim() == 0 || values.shape(0) != static_cast<py::ssize_t>(times.size()) || times.empty())
        throw InputError("", "Track", fmt::format("{} times need as many values along the first axis", times.size()));
    KeyedTrack track;
    track.sampling.kind = TimeSampling::Kind::acyclic;
    track.sampling.times = times;
    track.interpolation = static_cast<Interpolation>(found - interpolation_words.begin());
    if (times.size() > 1) validate(track.sampling, times.size(), "", "Track");
    track.values = py::array_t<double>(values.attr("copy")());
    track.values.attr("flags").attr("writeable") = false;
    return track;
}

py::array_t<double> list_times(const KeyedTrack& track) {
    py::array_t<double> times(track.values.shape(0));
    for (py::ssize_t i = 0; i < track.values.shape(0); ++i)
        times.mutable_at(i) = sample_time(track.sampling, static_cast<std::size_t>(i));
    return times;
}

}  // namespace

namespace track_parts {

py::array_t<double, py::array::c_style> to_doubles(const py::handle& object, const std::vector<py::ssize_t>& axes,
                                                   const std::string& place) {
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
    const auto array = Doubles::ensure(object);
    if (!array) {
        PyErr_Clear();
        throw InputError("", place, "expected numbers, or a Track");
    }
    if (!std::equal(axes.begin(), axes.end(), array.shape(), array.shape() + array.ndim())) {
        throw InputError("", place,
                         fmt::format("expected {}, found an array {}",
                                     axes.empty() ? "a number"
                                                  : fmt::format("an array {}",
                                                                py::str(py::tuple(py::cast(axes))).cast<std::string>()),
                                     py::str(py::tuple(array.attr("shape"))).cast<std::string>()));
    }
    return array;
}

}  // namespace track_parts

void bind_tracks(py::module_& module) {
    py::class_<KeyedTrack>(module, "Track",
                           R"(A property's keys. It does not change: assign another one to the property.

times: seconds, ascending; scene.seconds(frames) turns frames into seconds.
values: an array whose first axis has one element for each key: (keys,) for numbers, (keys, 3) for vectors and
colours, (keys, 4) for quaternions x, y, z, w, (keys, 4, 4) for matrices that act on column vectors.
interpolation: "linear" (quaternions: slerp), "step", "nearest", or "cubic" with values (keys, 3, ...): in-tangent,
value and out-tangent, per second, as in glTF.)")
        .def(py::init(&make_track), py::arg("times"), py::arg("values"), py::arg("interpolation") = "linear")
        .def_property_readonly("times", &list_times, "Seconds of the keys, (keys,).")
        .def_property_readonly(
            "values", [](const KeyedTrack& track) { return track.values; }, "Values of the keys.")
        .def_property_readonly(
            "interpolation",
            [](const KeyedTrack& track) { return interpolation_words[static_cast<std::size_t>(track.interpolation)]; },
            "\"step\", \"linear\", \"nearest\" or \"cubic\".")
        .def("__len__", [](const KeyedTrack& track) { return track.values.shape(0); })
        .def("__repr__", [](const KeyedTrack& track) {
            return fmt::format("<aleph.Track of {} keys, {}>", track.values.shape(0),
                               interpolation_words[static_cast<std::size_t>(track.interpolation)]);
        });
}

}  // namespace aleph::python
