#pragma once
// The parts of the module, and what several of them use.

#include <pybind11/pybind11.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "perception/vision/vision_model.h"
#include "render/frame/frame_output.h"
#include "render/guide/accuracy_map.h"
#include "render/guide/stopping_rule.h"
#include "render/settings/settings.h"

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

/// json.dumps of the object, which may hold numbers and arrays of numpy.
/// @throws InputError with the JSON pointer of a part that cannot be JSON
std::string to_json(const py::object& object);

/// Python's warnings.warn. @throws where a filter makes the warning an error
void warn(const std::string& text);

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

/// The parts of a scene that the file of its frame names: film, names and materials of objects.
struct FrameOrigin {
    Scene scene;  ///< without geometry
    RenderSettings settings;
    double exposure = 1.0;
};

/// The scene without its geometry and pictures.
std::shared_ptr<const FrameOrigin> describe_origin(const Scene& scene, const RenderSettings& settings, double exposure);

struct Frame {
    FrameOutput output;
    std::shared_ptr<const FrameOrigin> origin;
};

/// The channels of the frame's file with all of its maps.
ChannelImage frame_channels(const Frame& frame);

/// elevation(frequency, retinal, tracked, luminance) gives f for arrays of pixels; threshold(luminance) the least
/// visible difference, both cd/m2; None: the thesis's. They are called from any thread, one at a time, with the
/// interpreter's lock; so are the functions of GivenSettings.
std::unique_ptr<VisionModel> make_vision(const std::string& name, const py::function& elevation,
                                         const py::object& threshold);

/// Settings, and the functions that they point to.
struct GivenSettings {
    RenderSettings settings;
    std::unique_ptr<VisionModel> vision;
    std::unique_ptr<AccuracyAdapter> adapter;
    std::unique_ptr<StoppingRule> rule;
};

/// The scene's settings with the arguments in their places. Numbers of the scene (exposure) go there. Functions may be
/// `vision`; `adapter`(aleph, accuracy), which gives the accuracy of each pixel; and `sampling`(x, y, samples, error,
/// deviation, tolerance), True where a pixel has enough samples.
/// @param of_scene  without a setting that chooses the work, an error of 1 is asked for; false: of pictures, and
/// settings that need a scene are refused
/// @throws InputError
GivenSettings read_settings(Scene& scene, const py::dict& arguments, bool of_scene);

}  // namespace aleph::python
