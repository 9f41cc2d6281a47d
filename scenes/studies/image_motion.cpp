// Motion of every source against model-based motion (thesis figure 5.7): errors by region, and a picture.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>

#include "engine/base/pixel_loops.h"
#include "engine/load/load_scene.h"
#include "engine/pose/posed_view.h"
#include "engine/rays/ray_scene.h"
#include "motion/picture_motion.h"
#include "motion/raster.h"
#include "render/cli/study_output.h"
#include "render/cli/support/options.h"
#include "render/frame/sequence.h"
#include "render/output/sheet.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/study/timed_run.h"
#include "scenes/studies/study_options.h"

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

/// True if a pixel is of a part of the picture.
using Region = std::function<bool(std::size_t pixel)>;

/// Movers, what stands still, and what the next frame hides: there points cannot be found.
std::array<Region, 3> list_regions(const FrameOutput& model, const std::vector<bool>& movers) {
    const auto on_mover = [&](std::size_t i) {
        const int instance = model.hits.pixels[i].instance;
        return instance != no_index && movers[instance];
    };
    const auto validity = [&](std::size_t i) { return model.motion.validity.pixels[i]; };
    const auto shown = [=](std::size_t i) {
        return validity(i) == MotionValidity::valid || validity(i) == MotionValidity::background;
    };
    return {[=](std::size_t i) { return shown(i) && on_mover(i); },
            [=](std::size_t i) { return shown(i) && !on_mover(i); },
            [=](std::size_t i) { return validity(i) == MotionValidity::hidden; }};
}

/// Errors of the valid displacements within a region, pixels, sorted; and the share that is valid.
struct RegionErrors {
    std::vector<double> sorted;
    std::size_t pixels = 0;

    std::string share() const {
        if (pixels == 0) return "-";
        return fmt::format("{:.1f}", 100.0 * static_cast<double>(sorted.size()) / static_cast<double>(pixels));
    }
    std::string quantile(double q) const {
        if (sorted.empty()) return "-";
        const auto at = static_cast<std::size_t>(q * static_cast<double>(sorted.size()));
        return fmt::format("{:.2f}", sorted[std::min(sorted.size() - 1, at)]);
    }
};

RegionErrors find_errors(const MotionField& field, const MotionField& truth, const Region& region) {
    RegionErrors errors;
    for (std::size_t i = 0; i < truth.displacement.size(); ++i) {
        if (!region(i)) continue;
        ++errors.pixels;
        const MotionValidity validity = field.validity.pixels[i];
        if (validity != MotionValidity::valid && validity != MotionValidity::background) continue;
        errors.sorted.push_back(glm::length(field.displacement.pixels[i] - truth.displacement.pixels[i]));
    }
    std::ranges::sort(errors.sorted);
    return errors;
}

Image<float> lengths_of(const Image<glm::dvec2>& displacement) {
    return map_pixels([](const glm::dvec2& way) { return static_cast<float>(glm::length(way)); }, displacement);
}

/// An even number of pixels that 99.8 % of the motion stays under.
double scale_of(const Image<float>& lengths) {
    std::vector<float> sorted = lengths.pixels;
    std::ranges::sort(sorted);
    return std::max(2.0, std::ceil(static_cast<double>(sorted[sorted.size() * 998 / 1000]) / 2.0) * 2.0);
}

/// The motion between two frames as one source finds it.
struct FoundMotion {
    std::string source;
    MotionField field;
    double seconds = 0.0;  ///< of a processor
};

struct Motions {
    FrameOutput now, next;
    std::vector<FoundMotion> found;

    const MotionField& model() const { return now.motion; }
    const MotionField& find(const std::string& source) const {
        return std::ranges::find(found, source, &FoundMotion::source)->field;
    }
};

template <class Find>
void add_motion(Motions& motions, const std::string& source, const Find& find) {
    const double start = processor_seconds();
    MotionField field = find();
    motions.found.push_back({source, std::move(field), processor_seconds() - start});
}

/// Motion from the scene, by cast rays and by rasterized maps. The seconds include both.
void add_scene_motions(const Sequence& sequence, const RenderSettings& settings, int frame, Motions& motions) {
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
    ModelMotion model(scene, plan);
    add_motion(motions, "`model`",
               [&] { return model.compute(now, other, cast_centers(rays, now.view, nullptr).hits, OtherFrame::next); });
    add_motion(motions, "`raster`",
               [&] { return compute_raster_motion(model, scene, now, other, rasterize(scene, now)); });
}

/// Motion from two pictures, in every way that this program was built with.
void add_picture_motions(const Image<Rgb>& now, const Image<Rgb>& next, const std::string& pictures, Motions& motions) {
    const auto add = [&](const std::string& source, PictureSearch search) {
        add_motion(motions, fmt::format("`{}`, {}", source, pictures), [&] {
            return compute_picture_motion(prepare_picture(now, search), prepare_picture(next, search), search);
        });
    };
    add("census", PictureSearch::census);
    add("image", PictureSearch::checked);
    if (has_flow()) add("flow", PictureSearch::flow);
}

constexpr const char *of_frames = "rendered frames", *of_estimates = "quick estimates";

Motions find_motions(const Scene& scene, const RenderSettings& settings, int frame) {
    Sequence sequence(scene, settings);
    const FrameRequest request{.frame = true, .maps = true, .progress = {}};
    Motions motions;
    motions.now = sequence.render(frame, request);
    motions.next = sequence.render(frame + 1, request);
    add_scene_motions(sequence, settings, frame, motions);
    add_picture_motions(motions.now.shaded.color, motions.next.shaded.color, of_frames, motions);
    add_picture_motions(motions.now.estimate, motions.next.estimate, of_estimates, motions);
    add_motion(motions, "nothing: 0 everywhere", [&] {
        MotionField still = motions.model();
        std::ranges::fill(still.displacement.pixels, glm::dvec2(0.0));
        return still;
    });
    return motions;
}

void print_table(const Motions& motions, const std::vector<bool>& movers, bool markdown) {
    std::vector<TableRow> rows{{"motion from", "object: valid (%)", "median", "95 %", "background: valid (%)", "median",
                                "95 %", "hidden: valid (%)", "processor seconds"}};
    const std::array<Region, 3> regions = list_regions(motions.now, movers);
    for (const FoundMotion& found : motions.found) {
        TableRow& row = rows.emplace_back();
        row.push_back(found.source);
        for (std::size_t i = 0; i < 2; ++i) {
            const RegionErrors errors = find_errors(found.field, motions.model(), regions[i]);
            row.insert(row.end(), {errors.share(), errors.quantile(0.5), errors.quantile(0.95)});
        }
        row.push_back(find_errors(found.field, motions.model(), regions[2]).share());
        row.push_back(fmt::format("{:.3f}", found.seconds));
    }
    print_rows(rows, markdown, std::cout);
}

std::vector<Panel> make_panels(const Motions& motions, int frame) {
    const MotionField& census = motions.find(fmt::format("`census`, {}", of_frames));
    const std::string best = fmt::format("`{}`, {}", has_flow() ? "flow" : "image", of_frames);
    const Image<glm::dvec2> error =
        map_pixels(std::minus<glm::dvec2>(), census.displacement, motions.model().displacement);
    const Image<float> lengths = lengths_of(motions.model().displacement);
    const MapRange range{0.0, scale_of(lengths)};
    return {color_panel(fmt::format("frame {}", frame), motions.now.shaded.color),
            color_panel(fmt::format("frame {}", frame + 1), motions.next.shaded.color),
            map_panel(fmt::format("model-based motion, 0 to {:g} px", range.high), lengths, range),
            map_panel(fmt::format("census search, 0 to {:g} px", range.high), lengths_of(census.displacement), range),
            map_panel(fmt::format("{}, 0 to {:g} px", has_flow() ? "optical flow" : "checked census", range.high),
                      lengths_of(motions.find(best).displacement), range),
            map_panel(fmt::format("error of the census search, 0 to {:g} px", range.high), lengths_of(error), range)};
}

int run_motion(const MotionOptions& options) {
    const Scene scene = load_scene(options.scene);
    const RenderSettings settings = scene_settings(scene, options.scene, options.study);
    const Motions motions = find_motions(scene, settings, options.frame);
    fmt::print("{}, frames {} and {}, {}; errors of the valid pixels against model-based motion, pixels\n\n",
               options.scene, options.frame, options.frame + 1, options.study.size);
    print_table(motions, find_movers(scene, options.frame), options.study.markdown);
    write_sheet(options.picture, make_panels(motions, options.frame), 2, 400);
    fmt::print("\nThe picture: {}\n", options.picture);
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"Compares every source of motion with model-based motion: errors by region, and a picture."};
    aleph::MotionOptions options;
    app.add_option("scene", options.scene, "a scene file")->required();
    aleph::add_value(app, "--frame", options.frame, "the first of two frames");
    app.add_option("-o,--output", options.picture, "file of the picture, .png or .jpg")->capture_default_str();
    return aleph::run_study_program(app, options.study, argc, argv, [&] { return aleph::run_motion(options); });
}
