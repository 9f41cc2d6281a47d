// What double precision buys in model-based motion: errors of displacements, in pixels, of scenes far from the origin,
// in float and in double, against long double near the origin.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/load/load_scene.h"
#include "motion/reprojection.h"
#include "render/cli/options.h"
#include "scenes/studies/reprojection_variants.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct PrecisionOptions {
    StudyOptions study{.size = "320x240", .gather = 0, .spp = 0};
    int frame = 0;
    double telephoto = 1.0;  ///< degrees
    int repeats = 20;
    bool markdown = false;
};

/// A surface point that a pixel shows, where it is at both frames.
struct SeenPoint {
    std::size_t instance = 0;
    glm::dvec3 now{0.0}, other{0.0};  ///< m, object space
};

/// Two poses and the points that the first one's pixels show.
struct Case {
    const PosedView& now;
    const PosedView& other;
    CameraView view_now, view_other;
    std::vector<SeenPoint> points;
};

/// Points behind either camera are left out.
std::vector<SeenPoint> find_points(const StudyFrame& frame, const Case& views) {
    const SampleHits centers = cast_centers(frame.rays, views.view_now, nullptr);
    std::vector<SeenPoint> points;
    for (const Hit& hit : centers.hits.pixels) {
        if (hit.instance == no_index) continue;
        const auto [node, mesh] = views.now.pose.instances[static_cast<std::size_t>(hit.instance)];
        const Mesh& shape = frame.scene.meshes[static_cast<std::size_t>(mesh)];
        const SeenPoint point{static_cast<std::size_t>(hit.instance),
                              surface_point(shape, views.now.pose.meshes[mesh], hit),
                              surface_point(shape, views.other.pose.meshes[mesh], hit)};
        const auto is_before = [&](const PosedView& posed, const CameraView& view, const glm::dvec3& place) {
            return -make_camera_from_object(view, posed.pose.world[node])(place).z > nearest_depth(view);
        };
        if (is_before(views.now, views.view_now, point.now) && is_before(views.other, views.view_other, point.other)) {
            points.push_back(point);
        }
    }
    return points;
}

/// Displacements of all points, pixels, by a kind of reprojection, with everything moved by an offset.
template <class Reprojection>
class Variant {
  public:
    Variant(const Case& views, const glm::dvec3& offset) : points_(views.points) {
        const CameraView from = moved_by(views.view_now, offset), to = moved_by(views.view_other, offset);
        for (const Instance& instance : views.now.pose.instances) {
            now_.emplace_back(from, moved_by(views.now.pose.world[instance.node], offset));
            other_.emplace_back(to, moved_by(views.other.pose.world[instance.node], offset));
        }
    }
    using Displacement = decltype(std::declval<Reprojection>()(glm::dvec3()));

    void run(std::vector<Displacement>& out) const {
        out.resize(points_.size());
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const SeenPoint& point = points_[i];
            out[i] = other_[point.instance](point.other) - now_[point.instance](point.now);
        }
    }
    /// ns per point, the least of so many repeats.
    double time(int repeats) const {
        std::vector<Displacement> out;
        double least = 1e30;
        for (int i = 0; i < repeats; ++i) {
            const double start = processor_seconds();
            run(out);
            least = std::min(least, processor_seconds() - start);
        }
        return 1e9 * least / static_cast<double>(points_.size());
    }

  private:
    const std::vector<SeenPoint>& points_;
    std::vector<Reprojection> now_, other_;
};

using Truth = Variant<RelativeReprojection<long double, long double>>;

struct Row {
    std::string scene, lens, variant;
    double metres = 0.0;
};

/// Adds a row: errors of a variant, and ns per pixel.
template <class Reprojection>
void add_row(const StudyTable& table, const Case& views, const std::vector<Truth::Displacement>& truth, const Row& row,
             int repeats) {
    const Variant<Reprojection> variant(views, glm::dvec3(row.metres));
    std::vector<typename Variant<Reprojection>::Displacement> found;
    variant.run(found);
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        errors.push_back(static_cast<double>(std::hypot(static_cast<long double>(found[i].x) - truth[i].x,
                                                        static_cast<long double>(found[i].y) - truth[i].y)));
    }
    // Float may divide by 0, which gives no number: these count as infinite.
    for (double& error : errors) error = std::isnan(error) ? INFINITY : error;
    std::sort(errors.begin(), errors.end());
    const auto quantile = [&](double q) { return errors[static_cast<std::size_t>(q * (errors.size() - 1.0))]; };
    table.add({row.scene, row.lens, fmt::format("{:g}", row.metres), row.variant, fmt::format("{:.1e}", quantile(0.5)),
               fmt::format("{:.1e}", quantile(0.99)), fmt::format("{:.1e}", errors.back()),
               fmt::format("{:.1f}", variant.time(repeats))});
}

void add_rows(const StudyTable& table, const StudyFrame& frame, Case views, const PrecisionOptions& options,
              const std::string& lens) {
    views.points = find_points(frame, views);
    if (views.points.empty()) return;
    std::vector<Truth::Displacement> truth;
    Truth(views, glm::dvec3(0.0)).run(truth);
    for (const double metres : {0.0, 1e3, 1e5, 1e7}) {
        Row row{scene_name(options.study.scene), lens, "float, world", metres};
        add_row<WorldReprojection<float>>(table, views, truth, row, options.repeats);
        row.variant = "float, camera";
        add_row<RelativeReprojection<float, double>>(table, views, truth, row, options.repeats);
        row.variant = "double";
        add_row<RelativeReprojection<double, double>>(table, views, truth, row, options.repeats);
    }
}

void run_precision(const PrecisionOptions& options) {
    const Scene scene = load_scene(options.study.scene);
    const RenderSettings settings = study_settings(scene, options.study.scene, options.study);
    const Sequence sequence(scene, settings);
    const StudyFrame frame(sequence, settings, options.frame);
    const PosedView other = make_posed_view(scene, scene.frame_rate.seconds_of(options.frame + 1), frame.camera,
                                            settings.width, settings.height);
    const StudyTable table({"scene", "lens", "m", "variant", "median (px)", "99 % (px)", "most (px)", "ns"}, 2,
                           options.markdown);
    Case views{frame.posed, other, frame.posed.view, other.view, {}};
    add_rows(table, frame, views, options, "authored");
    if (views.view_now.orthographic) return;
    const double focal = 0.5 * settings.height / std::tan(0.5 * options.telephoto * std::numbers::pi / 180.0);
    views.view_now.pixels_per_unit = views.view_other.pixels_per_unit = focal;
    add_rows(table, frame, views, options, fmt::format("{:g} degrees", options.telephoto));
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Prints a table of errors of model-based motion in float and in double, in pixels, with the scene and its "
        "camera moved away from the origin along every axis, and ns of a processor per pixel. The truth is in long "
        "double, at the origin."};
    aleph::PrecisionOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_value(app, "--frame", options.frame, "the first of two frames");
    aleph::add_value(app, "--telephoto", options.telephoto, "field of view of the second lens, degrees");
    aleph::add_value(app, "--repeats", options.repeats, "runs of each variant; the fastest counts");
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_precision(options); });
}
