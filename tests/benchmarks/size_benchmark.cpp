// How the cost of one frame grows with the scene and with the picture, to an error of one just visible difference: of
// triangles, of lamps, of pixels, and with threads. Above each table is what it varies; the last column of a table's
// last row is the exponent of the whole: seconds grow like size to that power (least squares in logarithms).
//   bench_size

#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/surface/shapes.h"
#include "render/frame/sequence.h"
#include "render/settings/measure.h"
#include "tests/benchmarks/raw_embree.h"
#include "tests/benchmarks/thread_seconds.h"
#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

constexpr double side = 20.0, height = 4.0;  // m, of the hall
constexpr int ball_triangles = 1000;

/// Things at so many places, in rows over a square.
template <class Place>
void place_in_rows(int count, const Place& place) {
    const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
    const double step = side / columns;
    for (int i = 0; i < count; ++i)
        place(glm::dvec2(step * (i % columns + 0.5), step * (i / columns + 0.5)) - side / 2, step);
}

/// A closed hall with balls on its floor, each a mesh of its own, and square lamps under its ceiling. All lamps
/// together are as bright, and as large, whatever their number.
Scene make_hall(int triangles, int lamps) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    const int red = add_lambert(scene, {0.6, 0.2, 0.1});
    const int light = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(60.0));
    add_mesh(scene, make_box({side, height, side}, grey), {0.0, 0.5 * height, 0.0});
    place_in_rows(std::max(1, triangles / ball_triangles), [&](const glm::dvec2& at, double step) {
        Shape ball{.kind = Shape::Kind::sphere, .radius = 0.35 * std::min(step, 2.0)};
        ball.segments = 32;
        add_mesh(scene, make_shape_mesh(ball, red), {at.x, ball.radius, at.y});
    });
    place_in_rows(lamps, [&](const glm::dvec2& at, double step) {
        add_mesh(scene, make_quad(0.1 * step, 0.1 * step, light), {at.x, height - 0.2, at.y}, z_to_down);
    });
    add_camera(scene, {0.45 * side, 0.8 * height, 0.45 * side}, {0.0, 0.3, 0.0});
    return scene;
}

struct Cost {
    double start = 0.0;  ///< s, until the first frame may begin
    double fill = 0.0, shade = 0.0, frame = 0.0;
    double samples = 0.0, rays = 0.0;
};

Cost measure(const Scene& scene, int width, int picture_height, clockid_t clock) {
    RenderSettings settings;
    settings.picture.width = width;
    settings.picture.height = picture_height;
    follow_error(settings, 1.0);
    const double before = seconds_now(clock);
    Sequence sequence(scene, settings);
    const double begun = seconds_now(clock);
    const FrameStatistics stats = sequence.render(0).statistics;
    return {.start = begun - before,
            .fill = stats.seconds.fill,
            .shade = stats.seconds.shade,
            .frame = seconds_now(clock) - begun,
            .samples = static_cast<double>(stats.counts.samples),
            .rays = static_cast<double>(stats.counts.rays.total())};
}

/// Seconds for Embree alone to build a tree of the scene's triangles.
double measure_embree(const Scene& scene) {
    const ScenePose frame = pose(scene, 0.0);
    const double before = seconds_now();
    const RawEmbree embree(scene, frame, glm::dvec3(0.0));
    return seconds_now() - before;
}

double find_exponent(const std::vector<double>& sizes, const std::vector<double>& costs) {
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    const double n = static_cast<double>(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const double x = std::log(sizes[i]), y = std::log(costs[i]);
        sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Rows of one table, with the exponent of the frame's seconds at its end.
class Table {
  public:
    explicit Table(const char* what) {
        fmt::print("\n{:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", what, "start, s", "fill, s", "shade, s",
                   "frame, s", "M rays", "samples", "memory, MiB");
    }
    void add(double size, int pixels, const Cost& cost) {
        fmt::print("{:>10.0f} {:9.3f} {:9.2f} {:9.2f} {:9.2f} {:9.2f} {:9.1f} {:11.0f}\n", size, cost.start, cost.fill,
                   cost.shade, cost.frame, cost.rays / 1e6, cost.samples / pixels, peak_memory_mib());
        std::fflush(stdout);
        sizes_.push_back(size);
        frames_.push_back(cost.frame);
        starts_.push_back(cost.start);
    }
    void finish() const {
        fmt::print("{:>10} {:9.2f} {:>9} {:>9} {:9.2f}\n", "exponent", find_exponent(sizes_, starts_), "", "",
                   find_exponent(sizes_, frames_));
    }

  private:
    std::vector<double> sizes_, frames_, starts_;
};

void run() {
    constexpr int width = 160, rows = 120, pixels = width * rows;
    fmt::print(
        "One frame of a hall to an error of 1; seconds of one thread, fill and shade by the clock, samples per pixel, "
        "largest memory so far\n");
    std::vector<double> embree;
    {
        const ThreadLimit one_thread(1);
        Table table("triangles");
        for (const int triangles : {1'000, 10'000, 100'000, 1'000'000}) {
            const Scene scene = make_hall(triangles, 4);
            table.add(triangles, pixels, measure(scene, width, rows, CLOCK_THREAD_CPUTIME_ID));
            embree.push_back(measure_embree(scene));
        }
        table.finish();
        fmt::print("{:>10} {:9.3f} {:9.3f} {:9.3f} {:9.3f}\n", "Embree, s", embree[0], embree[1], embree[2], embree[3]);
        Table lamps("lamps");
        for (const int count : {1, 10, 100, 1'000, 10'000})
            lamps.add(count, pixels, measure(make_hall(10'000, count), width, rows, CLOCK_THREAD_CPUTIME_ID));
        lamps.finish();
        Table sizes("pixels");
        for (const int scale : {1, 2, 4, 8}) {
            sizes.add(pixels * scale * scale, pixels * scale * scale,
                      measure(make_hall(10'000, 4), width * scale, rows * scale, CLOCK_THREAD_CPUTIME_ID));
        }
        sizes.finish();
    }
    fmt::print("\nThe same at 640x480, by the clock\n");
    Table threads("threads");
    for (const int count : {1, 2, 4}) {
        const ThreadLimit limit(count);
        threads.add(count, 16 * pixels, measure(make_hall(10'000, 4), 4 * width, 4 * rows, CLOCK_MONOTONIC));
    }
    threads.finish();
}

}  // namespace
}  // namespace aleph

int main() {
    aleph::run();
}
