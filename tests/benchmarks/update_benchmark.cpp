// Cost of a frame's update when 10 objects move among many, on one thread: pose, ray scene, shading scene, motion
// field. Pose, rays and shading are also measured when made from scratch. Prints a table; the last column is the cost
// in the largest scene divided by that in the smallest.

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/pose/posed_view.h"
#include "engine/rays/ray_scene.h"
#include "engine/surface/shapes.h"
#include "motion/model_motion.h"
#include "render/light/lights.h"
#include "render/surface/shading_scene.h"
#include "render/surface/texture.h"
#include "tests/benchmarks/thread_seconds.h"
#include "tests/support/first_hits.h"

namespace aleph {
namespace {

constexpr int movers = 10;
constexpr int frames = 60;
constexpr int width = 80, height = 60;

/// A square field of boxes with a lamp and a camera above it. Ten boxes, spread over the field, slide and turn, one of
/// them through 172 degrees a frame, which motion follows in steps.
Scene make_field(int objects) {
    Scene scene;
    scene.meshes.push_back(make_shape_mesh({.kind = Shape::Kind::box}));
    scene.meshes.push_back(make_shape_mesh({.kind = Shape::Kind::quad, .size = {4.0, 4.0, 0.0}}));
    scene.meshes[1].material = 0;
    scene.materials.resize(1);
    scene.materials[0].glow.color = glm::dvec3(5.0);
    const int columns = static_cast<int>(std::ceil(std::sqrt(objects)));
    for (int i = 0; i < objects; ++i) {
        Node node{.meshes = {i == 0 ? 1 : 0}};
        const glm::dvec3 at(2.0 * (i % columns), i == 0 ? 9.0 : 0.0, 2.0 * (i / columns));
        node.transform.translation = at;
        if (i % (objects / movers) == 5) {
            node.transform.translation = Track<glm::dvec3>({0.0, 10.0}, {at, at + glm::dvec3(0.0, 3.0, 0.0)});
            const Track<double> angle = Track<double>({0.0, 10.0}, {0.0, i < objects / movers ? 900.0 : 9.0});
            node.transform.axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, angle};
        }
        scene.nodes.push_back(node);
    }
    scene.cameras.emplace_back();
    scene.nodes.push_back({.transform = {.translation = glm::dvec3(6.0, 4.0, -6.0),
                                         .axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, {std::numbers::pi}}},
                           .camera = 0});
    return scene;
}

struct Row {
    const char* name;
    Best best{};
};

std::vector<Row> measure(int objects) {
    std::vector<Row> rows = {{"pose afresh"},    {"pose update"},    {"rays afresh"},      {"rays update"},
                             {"shading afresh"}, {"shading update"}, {"lights"},           {"motion"},
                             {"hidden points"},  {"all updates"},    {"build of the rays"}};
    const Scene scene = make_field(objects);
    const TextureSet textures = make_texture_set(scene);
    const PosePlan plan = make_pose_plan(scene);
    const glm::dvec3 anchor(0.0);
    std::optional<RayScene> rays;
    rows[10].best.time([&] { rays.emplace(scene); });
    PosedView now = make_posed_view(scene, 0.0, 0, width, height),
              next = make_posed_view(scene, 1 / 30.0, 0, width, height);
    rows[2].best.time([&] { rays->update(now.pose, anchor); });
    RayScene next_rays = rays->share_meshes();
    next_rays.update(next.pose, anchor);
    ModelMotion motion(scene, plan);
    ShadingScene shading = make_shading_scene(scene, now.pose, *rays, textures);
    update_shading_scene(shading, plan, *rays);
    for (int i = 1; i <= frames; ++i) {
        const double seconds = i / 30.0;
        if (i % 10 == 0) {
            rows[0].best.time([&] { pose(scene, seconds); });
            rows[4].best.time([&] { make_shading_scene(scene, now.pose, *rays, textures); });
        }
        const Image<Hit> hits = cast_first_hits(next_rays, next.view);  // next becomes now
        update_posed_view(scene, plan, (i + 1) / 30.0, 0, next);
        next_rays.update(next.pose, anchor);
        rows[9].best.time([&] {
            rows[1].best.time([&] { update_posed_view(scene, plan, seconds, 0, now); });
            rows[3].best.time([&] { rays->update(now.pose, anchor); });
            rows[5].best.time([&] { update_shading_scene(shading, plan, *rays); });
            rows[6].best.time([&] { make_light_set(shading); });
            MotionField field;
            rows[7].best.time([&] { field = motion.compute(now, next, hits); });
            rows[8].best.time([&] { mark_hidden(field, scene, next, hits, next_rays); });
        });
    }
    return rows;
}

void print_table() {
    const std::vector<int> sizes = {1000, 10000, 100000};
    std::vector<std::vector<Row>> columns;
    for (const int size : sizes) columns.push_back(measure(size));
    fmt::print("{} objects move; ms, the fastest of {} frames, one thread\n{:<20}", movers, frames, "objects");
    for (const int size : sizes) fmt::print("{:>12}", size);
    fmt::print("{:>12}\n", "ratio");
    for (std::size_t row = 0; row < columns[0].size(); ++row) {
        fmt::print("{:<20}", columns[0][row].name);
        for (const std::vector<Row>& column : columns) fmt::print("{:>12.4f}", 1e3 * column[row].best.least);
        fmt::print("{:>12.1f}\n", columns.back()[row].best.least / columns[0][row].best.least);
    }
}

}  // namespace
}  // namespace aleph

int main() {
    const aleph::ThreadLimit one(1);
    aleph::print_table();
}
