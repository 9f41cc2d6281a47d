// Rendering: single frames, and sequences.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <mutex>
#include <optional>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/frame/sequence.h"
#include "render/python/bindings.h"
#include "render/settings/frame_list.h"

namespace aleph::python {

void run_without_lock(int threads, const py::object& on_progress, const Work& work) {
    constexpr int most_threads = 4096;
    if (threads < 0 || threads > most_threads)
        throw InputError("", "threads", fmt::format("{}: expected 0 (all processors) to {}", threads, most_threads));
    const FrameProgress report = [&](double fraction, const char* stage) {
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (!on_progress.is_none()) on_progress(fraction, stage);
    };
    const py::gil_scoped_release release;
    const ThreadLimit limit(threads);
    work(report);
}

namespace {

/// A turn at a sequence that Python threads share.
class Turn {
  public:
    /// @param busy  of the sequence, while its turn lasts
    /// @throws InputError where this thread has not ended its turn: in the report of a frame, or in an edit
    Turn(std::recursive_mutex& mutex, bool& busy) : lock_(mutex), busy_(busy) {
        if (busy_) throw InputError("", "Sequence", "on_progress and change cannot use the sequence that calls them");
        busy_ = true;
    }
    ~Turn() { busy_ = false; }

  private:
    std::unique_lock<std::recursive_mutex> lock_;
    bool& busy_;
};

class PythonSequence {
  public:
    PythonSequence(const py::object& source, const std::string& camera, int threads, const py::dict& arguments)
        : threads_(threads) {
        Scene scene = py::isinstance<Scene>(source) ? source.cast<const Scene&>() : *load(source, py::str("."));
        given_ = read_settings(scene, arguments, true);
        run_without_lock(threads_, py::none(), [&](const FrameProgress&) {
            sequence_ = std::make_unique<Sequence>(std::move(scene), given_.settings, camera);
        });
    }

    std::shared_ptr<Frame> render(std::int64_t number, bool maps, bool picture, const py::object& on_progress) {
        warn_of_frame_outside(number);
        auto frame = std::make_shared<Frame>();
        run_without_lock(threads_, on_progress, [&](const FrameProgress& progress) {
            const Turn turn(mutex_, busy_);
            FrameRequest request;
            request.frame = picture;
            request.maps = maps;
            request.progress = progress;
            frame->output = sequence_->render(number, request);
            if (!origin_) origin_ = describe_origin(sequence_->scene(), given_.settings, sequence_->exposure());
            frame->origin = origin_;
        });
        return frame;
    }

    void edit(const py::function& change) {
        std::optional<Turn> turn;
        {
            const py::gil_scoped_release release;  // the frame that is made may need it
            turn.emplace(mutex_, busy_);
        }
        sequence_->edit([&](Scene& scene) {
            const auto edited = std::make_shared<Scene>(std::move(scene));
            try {
                change(edited);
            } catch (...) {
                scene = std::move(*edited);
                throw;
            }
            scene = *edited;  // Python may keep elements of it
        });
        origin_.reset();
        edited_ = true;
    }

    std::pair<std::int64_t, std::int64_t> frames() const {
        const FrameRange range = sequence_->range();
        return {range.first, range.last};
    }
    double exposure() const { return sequence_->exposure(); }

  private:
    /// As the command line does. A simulation that edits the scene step by step chooses its own numbers.
    void warn_of_frame_outside(std::int64_t number) const {
        if (edited_) return;
        if (const auto fault = describe_frame_outside(number, sequence_->range())) warn(*fault);
    }

    std::recursive_mutex mutex_;
    bool busy_ = false, edited_ = false;
    int threads_;
    GivenSettings given_;
    std::unique_ptr<Sequence> sequence_;  ///< after what its settings point to
    std::shared_ptr<const FrameOrigin> origin_;
};

std::shared_ptr<Frame> render(const py::object& scene, std::optional<std::int64_t> frame, bool maps,
                              const std::string& camera, int threads, const py::object& on_progress,
                              const py::kwargs& settings) {
    PythonSequence sequence(scene, camera, threads, settings);
    return sequence.render(frame.value_or(sequence.frames().first), maps, true, on_progress);
}

}  // namespace

void bind_sequences(py::module_& module) {
    py::class_<PythonSequence>(module, "Sequence", R"(Renders frames of one scene, and keeps what they share.

scene: an aleph.Scene, which is copied, or what aleph.load takes.
camera: name of a camera or of its node; "": the scene's choice.
threads: 0: one for each processor.
settings: as of aleph.render.)")
        .def(py::init([](const py::object& scene, const std::string& camera, int threads, const py::kwargs& settings) {
                 return std::make_unique<PythonSequence>(scene, camera, threads, settings);
             }),
             py::arg("scene") = py::none(), py::kw_only(), py::arg("camera") = "", py::arg("threads") = 0)
        .def("render", &PythonSequence::render, py::arg("frame"), py::kw_only(), py::arg("maps") = true,
             py::arg("picture") = true, py::arg("on_progress") = py::none(),
             "Renders a frame; does not depend on the frames before. picture=False: its maps alone. "
             "on_progress(fraction, stage) is called as it goes on; what it raises, and Ctrl-C, end the frame.")
        .def("edit", &PythonSequence::edit, py::arg("change"),
             "Calls change(scene) between frames; the next frame's motion leads from the frame rendered last.")
        .def_property_readonly("frames", &PythonSequence::frames, "First and last frame.")
        .def_property_readonly("exposure", &PythonSequence::exposure, "Factor on radiance.");
    module.def("render", &render, py::arg("scene") = py::none(), py::arg("frame") = py::none(), py::kw_only(),
               py::arg("maps") = true, py::arg("camera") = "", py::arg("threads") = 0,
               py::arg("on_progress") = py::none(), R"(Renders a frame.

scene: an aleph.Scene, or what aleph.load takes.
frame: its number; None: the first.
maps: False: the picture alone, without maps that nothing else needs.
on_progress(fraction, stage): called as it goes on; what it raises, and Ctrl-C, end the frame.
settings: by the names of `aleph render --help`, with _ for -, such as error=1, size=(320, 240), guide="none"; they
override those of the scene. Without one that chooses the work, error=1. Functions on arrays may stand for
  vision(frequency, retinal, tracked, luminance) -> elevations of pixels, 1 to 250;
  adapter(aleph, accuracy) -> ambient accuracies, (h, w), 0 to 1;
  sampling(x, y, samples, error, deviation, tolerance) -> True where a pixel has enough.
Returns a Frame. Raises InputError for a scene or a setting that is wrong.)");
}

}  // namespace aleph::python
