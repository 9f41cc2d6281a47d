// Maps of pictures, and comparisons.

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>

#include "engine/base/errors.h"
#include "render/compare/compare_sequence.h"
#include "render/images/image_sequence.h"
#include "render/output/frame_files.h"
#include "render/python/arrays.h"
#include "render/python/bindings.h"
#include "render/settings/frame_list.h"
#include "render/settings/motion_source.h"

namespace aleph::python {

namespace {

/// Displacements in pixels, y down; NaN: no counterpart.
MotionField take_motion(const py::object& object, const std::string& what) {
    const Image<glm::dvec2> steps = take_vectors(object, what);
    MotionField motion = make_motion_field(steps.width, steps.height, MotionValidity::valid);
    const double diagonal = std::hypot(steps.width, steps.height);
    for (std::size_t i = 0; i < motion.displacement.size(); ++i) {
        const glm::dvec2 step = steps.pixels[i];
        const double length = glm::length(step);
        if (!std::isfinite(length) || length > diagonal) {
            motion.validity.pixels[i] = MotionValidity::no_counterpart;
            continue;
        }
        motion.displacement.pixels[i] = step;
        motion.path_length.pixels[i] = length;
    }
    return motion;
}

/// @throws InputError
py::sequence take_list(const py::object& object, const char* what) {
    if (!py::isinstance<py::sequence>(object))
        throw InputError("", what, "expected a list with one item for each frame, as in aleph.maps(images, fps=24)");
    return object;
}

/// Frames that begin a new shot.
/// @throws InputError
std::vector<std::int64_t> take_cuts(const py::object& object) {
    try {
        return object.cast<std::vector<std::int64_t>>();
    } catch (const py::cast_error&) {
        throw InputError("", "cuts", "expected a list of frame numbers, such as [24, 48]");
    }
}

std::vector<std::shared_ptr<Frame>> make_maps(const py::object& image_list, const py::object& fps,
                                              const py::object& motion, const py::object& cuts, int threads,
                                              const py::object& on_progress, const py::kwargs& settings) {
    const py::sequence images = take_list(image_list, "images");
    const auto shot_object = std::make_shared<Scene>();
    py::cast(shot_object).attr("fps") = fps;
    Scene& shot = *shot_object;
    shot.film.cuts = take_cuts(cuts);
    if (images.size() == 0) throw InputError("", "images", "there are none");
    for (const std::int64_t cut : shot.film.cuts) {
        const FrameRange range{0, static_cast<std::int64_t>(images.size()) - 1};
        if (const auto fault = describe_frame_outside(cut, range)) warn("cuts: " + *fault);
    }
    if (!motion.is_none() && take_list(motion, "motion").size() != images.size())
        throw InputError("", "motion", fmt::format("{} arrays for {} images", py::len(motion), images.size()));
    std::map<std::int64_t, PictureFrame> pictures;
    for (std::size_t i = 0; i < images.size(); ++i) {
        PictureFrame& picture = pictures[static_cast<std::int64_t>(i)];
        picture.color = take_color(images[i], fmt::format("images[{}]", i));
        if (motion.is_none()) continue;
        picture.motion = take_motion(motion[py::int_(i)], fmt::format("motion[{}]", i));
        if (!same_size(picture.motion->displacement, picture.color))
            throw InputError("", fmt::format("motion[{}]", i), "it has another size than its image");
    }
    GivenSettings given = read_settings(shot, settings, false);
    given.settings.guide.motion = source_for_pictures(given.settings.guide.motion);
    std::vector<std::shared_ptr<Frame>> frames;
    const auto origin = describe_origin(shot, given.settings, 1.0);
    run_without_lock(threads, on_progress, [&](const FrameProgress& progress) {
        const auto count = static_cast<std::int64_t>(pictures.size());
        ImageSequence sequence(shot, std::move(pictures), given.settings);
        for (std::int64_t i = 0; i < count; ++i) {
            progress(static_cast<double>(i) / static_cast<double>(count), "maps");
            frames.push_back(std::make_shared<Frame>(Frame{sequence.compute_maps(i), origin}));
        }
    });
    return frames;
}

/// A picture: an array, or a frame.
ChannelImage take_picture(const py::object& object, const std::string& what) {
    if (!py::isinstance<Frame>(object)) return make_color_image(take_color(object, what));
    const Image<Rgb>& color = object.cast<const Frame&>().output.shaded.color;
    if (color.empty()) throw InputError("", what, "the frame has maps only, and no picture");
    return make_color_image(color);
}

py::dict compare(const py::object& a, const py::object& b, const py::object& threshold, double display_white,
                 double tolerance) {
    if (!(tolerance >= 0.0)) throw InputError("", "tolerance", "must not be negative");
    if (!(display_white > 0.0)) throw InputError("", "display_white", "must be above 0");
    const ChannelImage first = take_picture(a, "a"), second = take_picture(b, "b");
    std::optional<ChannelImage> map;
    if (py::isinstance<Frame>(threshold)) {
        map = frame_channels(threshold.cast<const Frame&>());
    } else if (!threshold.is_none()) {
        map.emplace();
        map->channels.push_back({"threshold.Y", take_numbers(threshold, "threshold")});
        map->metadata["whiteLuminance"] = display_white;
    }
    CompareSettings settings;
    settings.tolerance = tolerance;
    const CompareResult result = compare_images(first, second, settings, map ? &*map : nullptr);
    py::dict out;
    out["same"] = result.same();
    out["max"] = result.all.max_abs;
    out["rms"] = result.all.rms;
    out["relative_mse"] = result.all.relative_mse;
    out["beyond"] = result.percent(result.beyond);
    out["not_finite"] = result.a.nan + result.a.inf + result.b.nan + result.b.inf;
    if (result.threshold) {
        out["thresholds_max"] = result.threshold->worst;
        out["thresholds_beyond"] = result.threshold->percent_beyond();
    }
    return out;
}

py::dict find_seen(const py::object& pictures, const py::object& reference, const py::object& reference_maps,
                   const py::object& cuts) {
    const py::sequence a = take_list(pictures, "a"), b = take_list(reference, "b"),
                       maps = take_list(reference_maps, "maps");
    if (a.size() != b.size() || a.size() != maps.size() || a.size() == 0)
        throw InputError(
            "", "seen",
            fmt::format("{}, {} and {} frames: expected three lists of one length", a.size(), b.size(), maps.size()));
    SequenceComparison comparison({}, take_cuts(cuts));
    std::optional<std::int64_t> before;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const py::object map = maps[i];
        if (!py::isinstance<Frame>(map))
            throw InputError("", fmt::format("maps[{}]", i), "expected a Frame of the reference, with its maps");
        const auto number = map.attr("number").cast<std::int64_t>();
        if (before && number <= *before)
            throw InputError("", fmt::format("maps[{}]", i),
                             fmt::format("frame {} does not come after frame {}", number, *before));
        before = number;
        const ChannelImage channels = frame_channels(map.cast<const Frame&>());
        comparison.add(number, take_picture(a[i], fmt::format("a[{}]", i)), take_picture(b[i], fmt::format("b[{}]", i)),
                       {.threshold = nullptr, .visible = &channels});
    }
    comparison.finish();
    const VisibleShares shares = comparison.summary().visible.value();
    py::dict out;
    out["seen"] = shares.seen;
    out["flicker"] = shares.flicker;
    out["lasting"] = shares.lasting;
    out["noticed"] = shares.noticed;
    return out;
}

}  // namespace

void bind_pictures(py::module_& module) {
    module.def("maps", &make_maps, py::arg("images") = py::none(), py::kw_only(), py::arg("fps") = py::none(),
               py::arg("motion") = py::none(), py::arg("cuts") = py::list(), py::arg("threads") = 0,
               py::arg("on_progress") = py::none(), R"(Maps of pictures that other programs made.

images: a sequence of arrays (h, w, 3), linear floats with exposure (white = 1) or sRGB bytes.
fps: frames per second, as Scene.fps.
motion: None: found by comparing pictures, by optical flow where this was built with it; else an array (h, w, 2) for
each image: pixels to the next one, x right, y down, NaN where there is no counterpart.
cuts: indices of images that begin a new shot.
settings: as of aleph.render, such as vision="castle".
Returns a list of Frames without a picture.)");
    module.def("compare", &compare, py::arg("a") = py::none(), py::arg("b") = py::none(),
               py::arg("threshold") = py::none(), py::kw_only(), py::arg("display_white") = 100.0,
               py::arg("tolerance") = 0.0,
               R"(Differences of a picture from a reference.

a, b: arrays (h, w, 3) of linear floats or sRGB bytes, or Frames.
threshold: a Frame of the reference, or its thresholds (h, w) in cd/m2, for a display of `display_white` cd/m2.
Returns a dict: same, max, rms, relative_mse, beyond (percent of the pixels that differ by more than `tolerance`), and
with thresholds thresholds_max and thresholds_beyond (percent of the pixels with a visible difference in luminance).)");
    module.def("seen", &find_seen, py::arg("a") = py::none(), py::arg("b") = py::none(), py::arg("maps") = py::none(),
               py::kw_only(), py::arg("cuts") = py::list(),
               R"(What a viewer sees of the differences of two sequences.

a, b: lists of pictures of consecutive frames, as of compare; b is the reference.
maps: the Frames of the reference with their maps.
Returns percent of the pixels: seen, flicker (because it changes from frame to frame), lasting, and noticed (seen where
viewers look; None without saliency).)");
}

}  // namespace aleph::python
