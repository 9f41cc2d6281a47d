// Image-based against model-based motion (thesis figure 5.7): a table of errors by region, and a picture of both.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/load/load_scene.h"
#include "engine/pose/posed_view.h"
#include "engine/rays/ray_scene.h"
#include "motion/image_motion.h"
#include "motion/model_motion.h"
#include "render/cli/options.h"
#include "render/frame/sequence.h"
#include "render/output/sheet.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/study/processor_time.h"
#include "scenes/studies/raster_motion.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct MotionOptions {
    StudyOptions study{.size = "640x480"};
    std::string scene, picture = "motion.jpg";
    int frame = 40;
};

/// For every instance: does it move between the frame and the next, apart from the camera?
std::vector<bool> find_movers(const Scene& scene, int frame) {
    const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
    const ScenePose next = pose(scene, scene.film.frame_rate.seconds_of(frame + 1));
    std::vector<bool> moves;
    for (const Instance& instance : now.instances) {
        moves.push_back(now.world[instance.node] != next.world[instance.node]);
    }
    return moves;
}

/// A part of the picture.
struct Region {
    std::string name;
    std::function<bool(std::size_t pixel)> holds;
};

std::vector<Region> list_regions(const FrameOutput& model, const std::vector<bool>& movers) {
    const auto on_mover = [&](std::size_t i) {
        const int instance = model.hits.pixels[i].instance;
        return instance != no_index && movers[instance];
    };
    const auto validity = [&](std::size_t i) { return model.motion.validity.pixels[i]; };
    // Points that the next frame does not show cannot be found: they are a region of their own.
    const auto shown = [=](std::size_t i) {
        return validity(i) == MotionValidity::valid || validity(i) == MotionValidity::background;
    };
    return {{"moving object", [=](std::size_t i) { return shown(i) && on_mover(i); }},
            {"background", [=](std::size_t i) { return shown(i) && !on_mover(i); }},
            {"hidden in the next frame", [=](std::size_t i) { return validity(i) == MotionValidity::hidden; }}};
}

double length_of(const glm::dvec2& v) {
    return std::hypot(v.x, v.y);
}

/// Errors of displacements within a region, in pixels, sorted.
std::vector<double> list_errors(const MotionField& field, const MotionField& truth, const Region& region) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.displacement.size(); ++i) {
        if (region.holds(i)) errors.push_back(length_of(field.displacement.pixels[i] - truth.displacement.pixels[i]));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

void add_row(const StudyTable& table, const std::string& source, const Region& region,
             const std::vector<double>& errors) {
    if (errors.empty()) return;
    const auto quantile = [&](double q) {
        return errors[std::min(errors.size() - 1, static_cast<std::size_t>(q * static_cast<double>(errors.size())))];
    };
    double mean = 0.0;
    for (const double e : errors) mean += e / static_cast<double>(errors.size());
    const auto beyond = errors.end() - std::upper_bound(errors.begin(), errors.end(), 1.0);
    table.add({source, region.name, fmt::format("{}", errors.size()), fmt::format("{:.2f}", quantile(0.5)),
               fmt::format("{:.2f}", mean), fmt::format("{:.1f}", quantile(0.95)),
               fmt::format("{:.1f}", 100.0 * static_cast<double>(beyond) / static_cast<double>(errors.size()))});
}

Image<float> lengths_of(const Image<glm::dvec2>& displacement) {
    Image<float> lengths(displacement.width, displacement.height);
    for (std::size_t i = 0; i < lengths.size(); ++i)
        lengths.pixels[i] = static_cast<float>(length_of(displacement.pixels[i]));
    return lengths;
}

/// An even number of pixels that 99.8 % of the motion stays under.
double scale_of(const Image<float>& lengths) {
    std::vector<float> sorted = lengths.pixels;
    std::sort(sorted.begin(), sorted.end());
    return std::max(2.0, std::ceil(static_cast<double>(sorted[sorted.size() * 998 / 1000]) / 2.0) * 2.0);
}

/// The motion between two frames, found in four ways, and the seconds of a processor for each.
struct Motions {
    FrameOutput now, next;
    MotionField from_frames, from_estimates, from_raster;
    double model_seconds = 0.0, hits_seconds = 0.0, image_seconds = 0.0;

    const MotionField& model() const { return now.motion; }
};

/// Model-based motion once more, by itself, and what rasterized maps would give.
void time_model(const Sequence& sequence, const RenderSettings& settings, int frame, Motions& motions) {
    const Scene& scene = sequence.scene();
    const int camera = CameraNames(scene).find("");
    const auto pose_frame = [&](int number) {
        return make_posed_view(scene, scene.film.frame_rate.seconds_of(number), camera, settings.picture.width,
                               settings.picture.height);
    };
    const PosedView now = pose_frame(frame), other = pose_frame(frame + 1);
    const PosePlan plan = make_pose_plan(scene);
    RayScene rays(scene, plan);
    rays.update(now.pose, compute_anchor(now.view));
    double start = processor_seconds();
    const SampleHits hits = cast_centers(rays, now.view, nullptr);
    motions.hits_seconds = processor_seconds() - start;
    start = processor_seconds();
    compute_model_motion(scene, now, other, hits.hits, OtherFrame::next);
    motions.model_seconds = processor_seconds() - start;
    motions.from_raster = compute_raster_motion(scene, other, motions.now.hits, motions.model());
}

Motions find_motions(const Scene& scene, const RenderSettings& settings, int frame) {
    Sequence sequence(scene, settings);
    const FrameRequest request{.frame = true, .maps = true, .progress = {}};
    Motions motions;
    motions.now = sequence.render(frame, request);
    motions.next = sequence.render(frame + 1, request);
    const double start = processor_seconds();
    motions.from_frames = compute_image_motion(motions.now.shaded.color, motions.next.shaded.color);
    motions.image_seconds = processor_seconds() - start;
    motions.from_estimates = compute_image_motion(motions.now.estimate, motions.next.estimate);
    time_model(sequence, settings, frame, motions);
    return motions;
}

void print_table(const Motions& motions, const std::vector<bool>& movers, bool markdown) {
    MotionField nothing = motions.model();
    std::fill(nothing.displacement.pixels.begin(), nothing.displacement.pixels.end(), glm::dvec2(0.0));
    const StudyTable table({"motion from", "region", "pixels", "median", "mean", "95 %", "beyond 1 px (%)"}, 2,
                           markdown);
    for (const Region& region : list_regions(motions.now, movers)) {
        add_row(table, "rendered frames", region, list_errors(motions.from_frames, motions.model(), region));
        add_row(table, "ID and UV maps of 8 bits", region, list_errors(motions.from_raster, motions.model(), region));
        add_row(table, "quick estimates", region, list_errors(motions.from_estimates, motions.model(), region));
        add_row(table, "nothing: 0 everywhere", region, list_errors(nothing, motions.model(), region));
    }
}

std::vector<Panel> make_panels(const Motions& motions, int frame) {
    Image<glm::dvec2> error = motions.from_frames.displacement;
    for (std::size_t i = 0; i < error.size(); ++i) error.pixels[i] -= motions.model().displacement.pixels[i];
    const Image<float> lengths = lengths_of(motions.model().displacement);
    const MapRange range{0.0, scale_of(lengths)};
    return {color_panel(fmt::format("frame {}", frame), motions.now.shaded.color),
            color_panel(fmt::format("frame {}", frame + 1), motions.next.shaded.color),
            map_panel(fmt::format("model-based motion, 0 to {:g} px", range.high), lengths, range),
            map_panel(fmt::format("image-based motion, 0 to {:g} px", range.high),
                      lengths_of(motions.from_frames.displacement), range),
            map_panel("image-based, from the quick estimates", lengths_of(motions.from_estimates.displacement), range),
            map_panel(fmt::format("error of image-based motion, 0 to {:g} px", range.high), lengths_of(error), range)};
}

int run_motion(const MotionOptions& options) {
    const Scene scene = load_scene(options.scene);
    const RenderSettings settings = scene_settings(scene, options.scene, options.study);
    const Motions motions = find_motions(scene, settings, options.frame);
    fmt::print("{}, frames {} and {}, {}; errors against model-based motion, pixels\n\n", options.scene, options.frame,
               options.frame + 1, options.study.size);
    print_table(motions, find_movers(scene, options.frame), options.study.markdown);
    fmt::print(
        "\nProcessor seconds: model-based motion {:.4f}, and first hits {:.4f}, which the frame needs anyway; "
        "image-based motion {:.4f}\n",
        motions.model_seconds, motions.hits_seconds, motions.image_seconds);
    write_sheet(options.picture, make_panels(motions, options.frame), 2, 400);
    fmt::print("\nThe picture: {}\n", options.picture);
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"Compares image-based with model-based motion: errors by region, and a picture of both."};
    aleph::MotionOptions options;
    app.add_option("scene", options.scene, "a scene file")->required();
    aleph::add_value(app, "--frame", options.frame, "the first of two frames");
    app.add_option("-o,--output", options.picture, "file of the picture, .png or .jpg")->capture_default_str();
    aleph::add_study_program_options(app, options.study);
    return aleph::run_study_program(app, options.study, argc, argv, [&] { return aleph::run_motion(options); });
}
