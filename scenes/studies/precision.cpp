// What double precision buys in motion from the scene: errors of float, in world space and relative to the camera, at
// several distances from the origin, and what each takes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "engine/load/load_scene.h"
#include "motion/reprojection.h"
#include "render/cli/options.h"
#include "scenes/studies/motion_precision.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct PrecisionOptions {
    StudyOptions study{.size = "320x240", .gather = 0, .spp = 0, .threads = 1};
    std::vector<std::string> frames, offsets = {"0", "1e3", "1e5", "1e7"};
    bool markdown = false;
};

/// The points of one rigid object that a frame shows.
struct SeenObject {
    ObjectPose now, other;
    std::vector<glm::dvec3> points;  ///< object space, m
};

std::vector<SeenObject> list_objects(const std::string& text, const PrecisionOptions& options) {
    const FrameOfScene which = parse_frame_of_scene(text);
    const Scene loaded = load_scene(which.file);
    const RenderSettings settings = scene_settings(loaded, which.file, options.study.size, {});
    const Sequence sequence(loaded, settings);
    StudyFrame frame(sequence, settings, which.frame.value_or(0));
    const Image<Hit> hits = frame.centers.hits;
    const PosedView now = frame.posed;
    frame.move_to(frame.frame + 1);
    std::vector<SeenObject> objects(now.pose.instances.size());
    for (const Hit& hit : hits.pixels) {
        if (hit.instance == no_index) continue;
        const Instance& instance = now.pose.instances[hit.instance];
        const PosedMesh& shape = now.pose.meshes[instance.mesh];
        if (!shape.positions.empty() || !shape.control.empty()) continue;
        SeenObject& object = objects[hit.instance];
        if (object.points.empty()) {
            object.now = {now.view, now.pose.world[instance.node]};
            object.other = {frame.posed.view, frame.posed.pose.world[instance.node]};
        }
        object.points.push_back(surface_point(frame.scene.meshes[instance.mesh], hit));
    }
    std::erase_if(objects, [](const SeenObject& object) { return object.points.empty(); });
    return objects;
}

/// Displacements of all points by one kind of projection, and the processor's ns per point.
template <class Projection, class T>
std::vector<glm::vec<2, T>> displace_all(const std::vector<SeenObject>& objects, const glm::dvec3& offset,
                                         double& nanoseconds) {
    std::vector<glm::vec<2, T>> all;
    constexpr int repetitions = 5;
    double best = 1e30;
    for (int i = 0; i < repetitions; ++i) {
        all.clear();
        const double start = processor_seconds();
        for (const SeenObject& object : objects) {
            const Projection now(move_world(object.now, offset)), other(move_world(object.other, offset));
            for (const glm::dvec3& point : object.points) all.push_back(displace(now, other, glm::vec<3, T>(point)));
        }
        best = std::min(best, processor_seconds() - start);
    }
    nanoseconds = 1e9 * best / static_cast<double>(all.size());
    return all;
}

template <class T>
std::string describe_errors(const std::vector<glm::vec<2, T>>& found,
                            const std::vector<glm::vec<2, long double>>& truth) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < found.size(); ++i) {
        errors.push_back(static_cast<double>(glm::length(glm::vec<2, long double>(found[i]) - truth[i])));
    }
    std::ranges::sort(errors);
    const auto quantile = [&](double q) {
        return errors[static_cast<std::size_t>(q * static_cast<double>(errors.size() - 1))];
    };
    return fmt::format("{:.1e}, {:.1e}, {:.1e}", quantile(0.5), quantile(0.99), errors.back());
}

void run_precision(const PrecisionOptions& options) {
    const StudyTable table({"frame", "offset, m", "float, world space", "double, world space",
                            "float, relative to the camera", "double, relative to the camera", "ns per pixel"},
                           1, options.markdown);
    for (const std::string& text : options.frames) {
        const std::vector<SeenObject> objects = list_objects(text, options);
        const FrameOfScene which = parse_frame_of_scene(text);
        for (const double distance : parse_values(options.offsets, "--offsets")) {
            const glm::dvec3 offset(distance / std::sqrt(3.0));
            double ns[5];
            const auto truth = displace_all<RelativeProjection<long double>, long double>(objects, offset, ns[4]);
            const auto float_world = displace_all<WorldProjection<float>, float>(objects, offset, ns[0]);
            const auto double_world = displace_all<WorldProjection<double>, double>(objects, offset, ns[1]);
            const auto float_relative = displace_all<RelativeProjection<float>, float>(objects, offset, ns[2]);
            const auto double_relative = displace_all<RelativeProjection<double>, double>(objects, offset, ns[3]);
            table.add({fmt::format("{} {}", scene_name(which.file), which.frame.value_or(0)),
                       fmt::format("{:g}", distance), describe_errors(float_world, truth),
                       describe_errors(double_world, truth), describe_errors(float_relative, truth),
                       describe_errors(double_relative, truth),
                       fmt::format("{:.1f}, {:.1f}, {:.1f}, {:.1f}", ns[0], ns[1], ns[2], ns[3])});
        }
    }
    fmt::print("\nErrors of the motion in pixels: median, 99 %, largest; against the same in long double.\n");
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Computes the motion of all rigid surfaces of frames in float and in double, in world space and relative to "
        "the camera, with the whole scene moved away from the origin. Prints errors in pixels and times."};
    aleph::PrecisionOptions options;
    app.add_option("frames", options.frames, "SCENE@FRAME")->required();
    app.add_option("--offsets", options.offsets, "distances from the origin, m")->delimiter(',')->capture_default_str();
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_precision(options); });
}
