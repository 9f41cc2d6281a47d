// Scene files made from the truth of two archives (tests/assets/abc/author_scenes.py) have the same first hits and
// motion as the archives.
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "engine/rays/ray_scene.h"
#include "engine/scene/transforms.h"
#include "tests/support/files/alembic_truth.h"
#include "tests/support/paths.h"
#include "tests/support/seen_motion.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 96, height = 72;

/// Where an object stands in an archive: the names above it. Authored nodes are called by that path.
std::string path_of_instance(const Scene& scene, int instance) {
    int node = list_instances(scene)[instance].node;
    std::string path = scene.nodes[node].name;
    if (path.front() == '/') return path.substr(0, path.find('#'));
    for (path.clear(); node != no_index; node = scene.nodes[node].parent) path = "/" + scene.nodes[node].name + path;
    return path;
}

struct View {
    glm::dvec3 eye, target;
};

SeenMotion look(const Scene& scene, double seconds, double other_seconds, const View& view) {
    CameraValues camera{.position = view.eye, .axes = look_at(view.eye, view.target, {0.0, 1.0, 0.0})};
    const CameraView pixels = make_camera_view(camera, width, height);
    return {scene, {pose(scene, seconds), pixels}, {pose(scene, other_seconds), pixels}};
}

void expect_same(const std::string& name, const std::vector<View>& views, int frames, double least_share) {
    const std::filesystem::path folder = source_folder() / "tests/assets/abc";
    const Scene archive = load_scene(folder / (name + ".abc"));
    const Scene authored = load_scene(folder / (name + ".scene.json"));
    EXPECT_EQ(authored.film.frame_rate, archive.film.frame_rate);
    EXPECT_EQ(frame_range(authored), frame_range(archive));
    double worst_distance = 0.0, worst_motion = 0.0, largest_motion = 0.0;
    for (const View& view : views) {
        int surface = 0;
        for (int step = 0; step < 2 * frames; ++step) {  // between the samples too
            const double seconds = 0.5 * step / 24.0, next = seconds + 1.0 / 24.0;
            const SeenMotion ours = look(archive, seconds, next, view), theirs = look(authored, seconds, next, view);
            for (std::size_t p = 0; p < ours.hits.size(); ++p) {
                const Hit &a = ours.hits.pixels[p], &b = theirs.hits.pixels[p];
                ASSERT_EQ(a.instance == no_index, b.instance == no_index) << name << " pixel " << p << " step " << step;
                if (a.instance == no_index) continue;
                ++surface;
                ASSERT_EQ(path_of_instance(archive, a.instance), path_of_instance(authored, b.instance))
                    << name << " pixel " << p;
                worst_distance = std::max(worst_distance, std::abs(double(a.distance) / b.distance - 1.0));
                const glm::dvec2 move = ours.motion.displacement.pixels[p];
                worst_motion = std::max(worst_motion, glm::distance(move, theirs.motion.displacement.pixels[p]));
                largest_motion = std::max(largest_motion, glm::length(move));
                EXPECT_EQ(ours.motion.validity.pixels[p], theirs.motion.validity.pixels[p]) << name << " pixel " << p;
            }
        }
        EXPECT_GE(surface, least_share * width * height * 2 * frames) << name;
    }
    EXPECT_LE(worst_distance, 1e-5) << name;
    EXPECT_LE(worst_motion, 1e-6) << name;
    EXPECT_GE(largest_motion, 1.0) << name;
}

TEST(AlembicAuthored, WavesPentagonAndGrowingSurface) {
    expect_same("polymesh_anim", {{{2.0, 3.0, 6.0}, {1.0, 0.0, -0.5}}, {{-3.0, 1.0, 4.0}, {1.0, 0.5, 0.0}}}, 8, 0.05);
}

TEST(AlembicAuthored, TurningBoxesInInstances) {
    expect_same("instances", {{{3.0, 4.0, 9.0}, {3.0, 0.0, 0.0}}, {{0.0, -97.0, 5.0}, {0.0, -100.0, 0.0}}}, 3, 0.03);
}

}  // namespace
}  // namespace aleph
