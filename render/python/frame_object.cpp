#include "render/python/bindings.h"

#include <pybind11/stl.h>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/scene/place.h"
#include "render/output/frame_files.h"
#include "render/python/arrays.h"

namespace aleph::python {

std::shared_ptr<const FrameOrigin> describe_origin(const Scene& scene, const RenderSettings& settings,
                                                   double exposure) {
    auto origin = std::make_shared<FrameOrigin>(FrameOrigin{{}, settings, exposure});
    Scene& out = origin->scene;
    out.source.name = scene.source.name;
    out.source.settings = scene.source.settings;
    out.film = scene.film;
    for (const Node& node : scene.nodes) {
        Node& named = out.nodes.emplace_back();
        named.name = node.name;
        named.parent = node.parent;
        named.meshes = node.meshes;
    }
    for (const Mesh& mesh : scene.meshes) out.meshes.emplace_back().name = mesh.name;
    return origin;
}

ChannelImage frame_channels(const Frame& frame) {
    const FrameOrigin& origin = *frame.origin;
    return make_frame_image(frame.output, true, origin.scene, origin.settings, origin.exposure);
}

namespace {

/// A property whose array shares the frame's memory; None where the frame has no such map.
/// @param path  of members, from the frame to the map
template <class Number, auto... path>
void add_map(py::class_<Frame, std::shared_ptr<Frame>>& frame, const char* name, const char* doc) {
    const auto share = [](const py::object& self) {
        return share_image<Number>(at<path...>(self.cast<const Frame&>().output), self);
    };
    frame.def_property_readonly(name, share, doc);
}

void add_pictures(py::class_<Frame, std::shared_ptr<Frame>>& frame) {
    add_map<float, &FrameOutput::shaded, &ShadedFrame::color>(frame, "color", "Linear RGB with exposure, (h, w, 3).");
    add_map<float, &FrameOutput::estimate>(frame, "estimate",
                                           "The quick estimate that the model of vision sees, (h, w, 3).");
    add_map<float, &FrameOutput::shaded, &ShadedFrame::samples>(frame, "samples", "Number of samples of each pixel.");
    add_map<float, &FrameOutput::shaded, &ShadedFrame::errors, &ErrorMaps::total>(
        frame, "error", "Estimated standard error, in visible thresholds.");
    add_map<float, &FrameOutput::shaded, &ShadedFrame::variance>(
        frame, "variance",
        "Variance of a pixel's luminance (that of the mean of its samples), with exposure; by `integrator=\"path\"`.");
    add_map<float, &FrameOutput::surface, &SurfaceMaps::depth>(frame, "depth", "Planar, metres; 1e30 for background.");
    add_map<float, &FrameOutput::surface, &SurfaceMaps::normal>(frame, "normal",
                                                                "World space, towards the viewer, (h, w, 3).");
    add_map<float, &FrameOutput::surface, &SurfaceMaps::albedo>(
        frame, "albedo", "Share of light that the surface scatters, (h, w, 3), 0 to 1; 0 for background.");
}

void add_motion(py::class_<Frame, std::shared_ptr<Frame>>& frame) {
    add_map<double, &FrameOutput::motion, &MotionField::displacement>(
        frame, "motion",
        "Displacement to the next frame, pixels, x right, y down, (h, w, 2). In the shot's last frame and after an "
        "edit "
        "that from the frame before to this one.");
    add_map<std::int8_t, &FrameOutput::motion, &MotionField::validity>(
        frame, "motion_valid",
        "Codes: 1: valid; 0: background; -1: behind the camera; -2: leaves the picture; -3: no counterpart; -4: hidden "
        "there.");
    add_map<double, &FrameOutput::backward, &MotionField::displacement>(frame, "backward",
                                                                        "Displacement to the frame before, as "
                                                                        "`motion`; None after an edit.");
    add_map<std::int8_t, &FrameOutput::backward, &MotionField::validity>(frame, "backward_valid", "As `motion_valid`.");
    add_map<float, &FrameOutput::velocity>(frame, "velocity", "Image velocity, degrees per second.");
}

void add_perception(py::class_<Frame, std::shared_ptr<Frame>>& frame) {
    add_map<float, &FrameOutput::perception, &PerceptionMaps::aleph>(
        frame, "aleph",
        "The Aleph map: threshold elevation, the factor by which the least visible contrast is raised; 1 to 250.");
    add_map<float, &FrameOutput::limits, &ErrorLimits::threshold>(
        frame, "threshold", "Least visible luminance difference that lasts, cd/m2.");
    add_map<float, &FrameOutput::limits, &ErrorLimits::threshold_noise>(
        frame, "threshold_noise", "Standard deviation of noise of single pixels that goes unseen, cd/m2.");
    add_map<float, &FrameOutput::limits, &ErrorLimits::alpha>(
        frame, "accuracy", "Ambient accuracy of cached light: its relative error, 0 to 1; smaller takes longer.");
    add_map<float, &FrameOutput::perception, &PerceptionMaps::saliency>(frame, "saliency",
                                                                        "Where viewers look, 0 to 1.");
    add_map<float, &FrameOutput::perception, &PerceptionMaps::retinal_velocity>(frame, "retinal_velocity",
                                                                                "Degrees per second.");
}

void save(const Frame& frame, const py::object& to) {
    const std::filesystem::path path = to_path(to);
    const bool is_exr = path.extension() == ".exr";
    if (!is_exr && path.extension() != ".png")
        throw InputError(path.string(), "save", "the name has to end in .exr or .png");
    const Image<Rgb>& color = frame.output.shaded.color;
    if (!is_exr && color.empty())
        throw InputError(path.string(), "save", "the frame has maps only, and no picture: write .exr");
    try_output(path);
    if (is_exr) return write_exr(path, frame_channels(frame));
    write_png(path, color);
}

}  // namespace

void bind_frames(py::module_& module) {
    py::class_<Frame, std::shared_ptr<Frame>> frame(
        module, "Frame",
        "A frame and its maps, as read-only arrays of shape (height, width, ...) that share its memory; row 0 is at "
        "the top. What was not computed is None.");
    add_pictures(frame);
    add_motion(frame);
    add_perception(frame);
    frame
        .def_property_readonly(
            "number", [](const Frame& f) { return f.output.statistics.frame; }, "Frame number.")
        .def_property_readonly(
            "exposure", [](const Frame& f) { return f.origin->exposure; }, "Factor on radiance that is in the colours.")
        .def_property_readonly(
            "statistics", [](const Frame& f) { return from_json(format_frame_statistics(f.output.statistics)); },
            "Counts and times, a dict; `aleph render --stats` writes the same.")
        .def_property_readonly(
            "plan", [](const py::object& self) -> py::object { return self.attr("statistics")["plan"]; },
            "The effects plan: for each effect its decision, reason and bound.")
        .def("save", &save, py::arg("path"),
             "Writes the picture as .png (sRGB), or the picture and all maps as .exr (`aleph maps --help` has the "
             "channels). Makes missing folders.")
        .def("__repr__",
             [](const Frame& f) { return "<aleph.Frame " + std::to_string(f.output.statistics.frame) + ">"; });
}

}  // namespace aleph::python
