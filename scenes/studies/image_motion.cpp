// Image-based motion beside model-based motion (thesis figure 5.7): a table of errors by region, and one picture.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "motion/image_motion.h"
#include "render/cli/options.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

struct MotionOptions {
    std::string scene;
    StudyOptions study{.picture = "motion.png", .gather = 256, .spp = 4};
    int frame = 40;
    double accuracy = 0.2;
};

/// Which instances move by themselves between two frames, whatever the camera does.
std::vector<bool> find_movers(const Scene& scene, int frame) {
    const ScenePose now = pose(scene, scene.frame_rate.seconds_of(frame));
    const ScenePose next = pose(scene, scene.frame_rate.seconds_of(frame + 1));
    std::vector<bool> moves;
    for (const Instance& instance : now.instances) {
        const auto node = static_cast<std::size_t>(instance.node);
        moves.push_back(now.world[node] != next.world[node]);
    }
    return moves;
}

/// Part of a picture: whether a pixel belongs to it.
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
    // Where the other frame does not show the point there is nothing to find: such pixels have a row of their own.
    const auto shown = [=](std::size_t i) {
        return validity(i) == MotionValidity::valid || validity(i) == MotionValidity::background;
    };
    return {{"moving object", [=](std::size_t i) { return shown(i) && on_mover(i); }},
            {"background", [=](std::size_t i) { return shown(i) && !on_mover(i); }},
            {"hidden in the next frame", [=](std::size_t i) { return validity(i) == MotionValidity::hidden; }}};
}

/// Lengths of differences in pixels, sorted, of a region.
std::vector<double> list_errors(const MotionField& field, const MotionField& truth, const Region& region) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.displacement.size(); ++i) {
        if (!region.holds(i)) continue;
        const glm::dvec2 difference = field.displacement.pixels[i] - truth.displacement.pixels[i];
        errors.push_back(std::hypot(difference.x, difference.y));
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

void print_row(const std::string& source, const Region& region, const std::vector<double>& errors) {
    if (errors.empty()) return;
    const auto quantile = [&](double q) {
        return errors[std::min(errors.size() - 1, static_cast<std::size_t>(q * static_cast<double>(errors.size())))];
    };
    double mean = 0.0;
    for (const double e : errors) mean += e / static_cast<double>(errors.size());
    const auto beyond = errors.end() - std::upper_bound(errors.begin(), errors.end(), 1.0);
    fmt::print("| {} | {} | {} | {:.2f} | {:.2f} | {:.1f} | {:.1f} |\n", source, region.name, errors.size(),
               quantile(0.5), mean, quantile(0.95),
               100.0 * static_cast<double>(beyond) / static_cast<double>(errors.size()));
}

Image<float> lengths_of(const MotionField& field) {
    Image<float> lengths(field.path_length.width, field.path_length.height);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        const glm::dvec2& d = field.displacement.pixels[i];
        lengths.pixels[i] = static_cast<float>(std::hypot(d.x, d.y));
    }
    return lengths;
}

/// A round number that most of the picture's motion stays under.
double scale_of(const Image<float>& lengths) {
    std::vector<float> sorted = lengths.pixels;
    std::sort(sorted.begin(), sorted.end());
    return std::max(2.0, std::ceil(static_cast<double>(sorted[sorted.size() * 998 / 1000]) / 2.0) * 2.0);
}

int run_motion(const MotionOptions& options) {
    const Scene scene = load_scene(options.scene);
    RenderSettings settings = study_settings(scene, options.scene, options.study);
    settings.accuracy = options.accuracy;
    validate(settings);
    const ThreadLimit limit(options.study.threads);

    Sequence sequence(scene, settings);
    const FrameOutput now = sequence.render(options.frame, {.frame = true, .maps = true, .progress = {}});
    const FrameOutput next = sequence.render(options.frame + 1, {.frame = true, .maps = true, .progress = {}});
    const MotionField& model = now.motion;
    const MotionField from_frames = compute_image_motion(now.shaded.color, next.shaded.color);
    const MotionField from_estimates = compute_image_motion(now.estimate, next.estimate);
    MotionField nothing = model;
    std::fill(nothing.displacement.pixels.begin(), nothing.displacement.pixels.end(), glm::dvec2(0.0));

    fmt::print("{}, frames {} and {}, {}; errors against model-based motion, pixels\n\n", options.scene, options.frame,
               options.frame + 1, options.study.size);
    fmt::print("| motion from | region | pixels | median | mean | 95 % | beyond 1 px (%) |\n");
    fmt::print("| --- | --- | ---: | ---: | ---: | ---: | ---: |\n");
    const std::vector<bool> movers = find_movers(scene, options.frame);
    for (const Region& region : list_regions(now, movers)) {
        print_row("rendered frames", region, list_errors(from_frames, model, region));
        print_row("quick estimates", region, list_errors(from_estimates, model, region));
        print_row("nothing: 0 everywhere", region, list_errors(nothing, model, region));
    }

    const Image<float> lengths = lengths_of(model);
    const double top = scale_of(lengths);
    Image<float> error = lengths;
    for (std::size_t i = 0; i < error.size(); ++i) {
        const glm::dvec2 d = from_frames.displacement.pixels[i] - model.displacement.pixels[i];
        error.pixels[i] = static_cast<float>(std::hypot(d.x, d.y));
    }
    write_sheet(options.study.picture,
                {color_panel(fmt::format("frame {}", options.frame), now.shaded.color),
                 color_panel(fmt::format("frame {}", options.frame + 1), next.shaded.color),
                 map_panel(fmt::format("model-based motion, 0 to {:g} px", top), lengths, 0.0, top),
                 map_panel(fmt::format("image-based motion, 0 to {:g} px", top), lengths_of(from_frames), 0.0, top),
                 map_panel("image-based, from the quick estimates", lengths_of(from_estimates), 0.0, top),
                 map_panel(fmt::format("error of image-based motion, 0 to {:g} px", top), error, 0.0, top)},
                2, 400);
    fmt::print("\nThe picture: {}\n", options.study.picture);
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"image-based motion beside model-based motion: errors by region, and a picture of both"};
    aleph::MotionOptions options;
    app.add_option("scene", options.scene, "a scene file")->required();
    aleph::add_study_options(app, options.study);
    aleph::add_value(app, "--frame", options.frame, "the first of two frames");
    aleph::add_value(app, "--accuracy", options.accuracy, "ambient accuracy");
    return aleph::run_program(
        app, [&] { return aleph::run_motion(options); }, argc, argv, std::cerr);
}
