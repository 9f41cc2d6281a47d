// How the cost of one frame grows with triangles, lamps, pixels and threads, to an error of one just visible
// difference. Below each table are exponents: seconds grow as size to that power (least squares of logarithms).
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
#include "tests/support/scenes/render_scenes.h"

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
    double embree = 0.0;  ///< s, for Embree alone to build a tree of the triangles
    double start = 0.0;   ///< s, until the first frame may begin
    double frame = 0.0;   ///< s
    double samples = 0.0, rays = 0.0;
};

Cost measure(const Scene& scene, int width, int picture_height, clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
    RenderSettings settings{.picture = {.width = width, .height = picture_height}};
    follow_error(settings, 1.0);
    const ScenePose posed = pose(scene, 0.0);
    const double first = seconds_now(clock);
    { const RawEmbree embree(scene, posed, glm::dvec3(0.0)); }
    const double before = seconds_now(clock);
    Sequence sequence(scene, settings);
    const double begun = seconds_now(clock);
    const FrameStatistics stats = sequence.render(0).statistics;
    return {.embree = before - first,
            .start = begun - before,
            .frame = seconds_now(clock) - begun,
            .samples = static_cast<double>(stats.counts.samples),
            .rays = static_cast<double>(stats.counts.rays.total())};
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

/// Rows of one table, with exponents at their end.
class Table {
  public:
    explicit Table(const char* what) {
        fmt::print("\n{:>10} {:>9} {:>9} {:>9} {:>9} {:>9} {:>11}\n", what, "Embree, s", "start, s", "frame, s",
                   "M rays", "samples", "memory, MiB");
    }
    void add(double size, int pixels, const Cost& cost) {
        fmt::print("{:>10.0f} {:9.3f} {:9.3f} {:9.2f} {:9.2f} {:9.1f} {:11.0f}\n", size, cost.embree, cost.start,
                   cost.frame, cost.rays / 1e6, cost.samples / pixels, peak_memory_mib());
        std::fflush(stdout);
        sizes_.push_back(size);
        starts_.push_back(cost.start);
        frames_.push_back(cost.frame);
    }
    void finish() const {
        fmt::print("{:>10} {:>9} {:9.2f} {:9.2f}\n", "exponent", "", find_exponent(sizes_, starts_),
                   find_exponent(sizes_, frames_));
    }

  private:
    std::vector<double> sizes_, starts_, frames_;
};

void run() {
    constexpr int width = 160, rows = 120, pixels = width * rows;
    fmt::print(
        "One frame of a hall to an error of 1; seconds of one thread, samples per pixel, largest memory so far\n");
    {
        const ThreadLimit one_thread(1);
        Table triangles("triangles");
        for (const int count : {1'000, 10'000, 100'000, 1'000'000})
            triangles.add(count, pixels, measure(make_hall(count, 4), width, rows));
        triangles.finish();
        Table lamps("lamps");
        for (const int count : {1, 10, 100, 1'000, 10'000})
            lamps.add(count, pixels, measure(make_hall(10'000, count), width, rows));
        lamps.finish();
        Table sizes("pixels");
        for (const int scale : {1, 2, 4, 8}) {
            const int count = pixels * scale * scale;
            sizes.add(count, count, measure(make_hall(10'000, 4), width * scale, rows * scale));
        }
        sizes.finish();
    }
    fmt::print("\nThe same at 640x480, seconds of the clock\n");
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
