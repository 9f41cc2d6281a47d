// Every scene of scenes/, written as .glb and read again: transforms, materials, what is seen and how it moves.
#include <fmt/format.h>

#include <cmath>

#include "tests/engine/gltf/exported.h"
#include "tests/support/seen_motion.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> list_authored_scenes() {
    std::vector<std::string> names;
    for (const auto& folder : fs::directory_iterator(source_folder() / "scenes")) {
        if (!folder.is_directory() || folder.path().filename() == "studies") continue;
        for (const auto& file : fs::directory_iterator(folder.path()))
            if (file.path().extension() == ".json")
                names.push_back(fs::relative(file.path(), source_folder() / "scenes").string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// The differences of two pictures' first hits and motion.
struct PictureDifference {
    std::size_t other = 0, compared = 0;  ///< pixels where another surface is hit, and all others
    double motion = 0.0;                  ///< pixels, at most
};

PictureDifference compare_motion(const SeenMotion& a, const SeenMotion& b) {
    PictureDifference found;
    for (std::size_t i = 0; i < a.hits.size(); ++i) {
        const Hit &hit = a.hits.pixels[i], &other = b.hits.pixels[i];
        const bool is_hit = hit.instance != no_index;
        const bool same = is_hit == (other.instance != no_index) &&
                          (!is_hit || std::abs(hit.distance - other.distance) <= 1e-4f * hit.distance) &&
                          a.motion.validity.pixels[i] == b.motion.validity.pixels[i];
        if (!same) {
            ++found.other;
            continue;
        }
        ++found.compared;
        found.motion =
            std::max(found.motion, glm::length(a.motion.displacement.pixels[i] - b.motion.displacement.pixels[i]));
    }
    return found;
}

bool are_near(const MaterialValues& a, const MaterialValues& b) {
    const auto near = [](float x, float y) { return std::abs(x - y) <= 2e-6f * std::max(1.0f, std::abs(x)); };
    const auto near_colors = [&](const Rgb& x, const Rgb& y) {
        return near(x.x, y.x) && near(x.y, y.y) && near(x.z, y.z);
    };
    return near_colors(a.base_color, b.base_color) && near(a.alpha, b.alpha) && near_colors(a.emission, b.emission) &&
           near(a.gloss.metallic, b.gloss.metallic) && near(a.gloss.roughness, b.gloss.roughness) &&
           near(a.gloss.specular, b.gloss.specular) && near(a.gloss.ior, b.gloss.ior) &&
           near(a.glass.transmission, b.glass.transmission) && near(a.glass.thickness, b.glass.thickness) &&
           near_colors(a.glass.attenuation_color, b.glass.attenuation_color) &&
           near(a.layers.clearcoat, b.layers.clearcoat) && near_colors(a.layers.sheen_color, b.layers.sheen_color) &&
           near(a.layers.anisotropy, b.layers.anisotropy);
}

int camera_of(const Scene& scene, std::int64_t frame) {
    return camera_at(list_camera_shots(scene, ""), frame);
}

/// The camera of the other scene on the node of the same name.
int same_camera(const Scene& scene, int camera, const Scene& other) {
    std::vector<std::string> names;
    for (const Node& node : scene.nodes)
        if (node.camera != no_index) names.push_back(node.name);
    return CameraNames(other).find(names[camera]);
}

/// Pixels by which motion may differ. Values are floats: 2e-7 m of a few metres.
double pixel_tolerance(const std::string& name) {
    if (name == "hard-subdivided.json") return 0.1;  // the limit surface becomes triangles, which move straight
    if (name == "hard-ten_hours.json") return 0.5;   // a float after ten hours is 4 ms from the next
    return 2e-4;
}

class ExportScenes : public testing::TestWithParam<std::string> {};

/// Key times are floats: what moves is where it is a float's distance of time earlier or later.
double time_allowance(const Exported& files, double seconds, double size) {
    const double step = std::abs(seconds) * 1.2e-7;
    const ScenePose a = pose(files.before, seconds - step), b = pose(files.before, seconds + step);
    double largest = 0.0;
    for (std::size_t n = 0; n < a.world.size(); ++n)
        for (int k = 0; k < 4; ++k)
            largest = std::max(largest, glm::length(a.world[n][k] - b.world[n][k]) / (k < 3 ? 1.0 : size));
    return largest;
}

TEST_P(ExportScenes, LooksAndMovesTheSame) {
    std::string name = GetParam();
    Scene scene = load_scene(source_folder() / "scenes" / name);
    scene.environment = {};  // glTF has none, and so no picture that turns
    std::ranges::replace(name, '/', '-');
    const Exported files(std::move(scene), name.substr(0, name.rfind('.')));
    const FrameRange range = frame_range(files.before);
    if (name == "pool-scene.json") {
        EXPECT_EQ(frame_range(files.after), range) << "its keys end with its frames";
    }
    const FrameRate& rate = files.before.film.frame_rate;
    const double size = scene_size(files.before, rate.seconds_of(range.first));
    const std::int64_t span = range.last - range.first, count = std::min<std::int64_t>(span, 49);
    double world = 0.0, beyond = 0.0, between = 0.0;
    for (std::int64_t i = 0; i <= count; ++i) {
        const double seconds = rate.seconds_of(range.first + (count > 0 ? i * span / count : 0));
        const double difference = files.world_difference(seconds, size);
        world = std::max(world, difference);
        beyond = std::max(beyond, difference - time_allowance(files, seconds, size));
        const double later = seconds + 0.5 / rate.per_second();
        between = std::max(between, files.world_difference(later, size) - time_allowance(files, later, size));
        const ScenePose a = pose(files.before, seconds), b = pose(files.after, seconds);
        for (std::size_t m = 0; m < a.materials.size(); ++m)
            EXPECT_TRUE(are_near(a.materials[m], b.materials[m]))
                << files.before.materials[m].name << " at " << seconds;
        EXPECT_EQ(a.lights.size(), b.lights.size()) << seconds;
    }
    EXPECT_LE(beyond, 1e-6) << "of the scene's size, " << size << " m";
    EXPECT_LE(between, 2e-3) << "turns with cubic keys are 1e-4 off between frames, shears that change 2e-3";
    PictureDifference picture;
    for (const std::int64_t frame : {range.first, range.first + span / 3, std::max(range.last - 1, range.first)}) {
        if (files.before.cameras.empty()) break;
        const int camera = camera_of(files.before, frame), other = same_camera(files.before, camera, files.after);
        const double from = rate.seconds_of(frame), to = rate.seconds_of(frame + 1);
        const PictureDifference found = compare_motion(SeenMotion(files.before, from, to, 96, 72, camera),
                                                       SeenMotion(files.after, from, to, 96, 72, other));
        picture.motion = std::max(picture.motion, found.motion);
        picture.other = std::max(picture.other, found.other);
        EXPECT_GT(found.compared, 6000u);
    }
    EXPECT_LE(picture.other, pixel_tolerance(name) > 0.1 ? 200u : 20u) << "of 6912 pixels";
    EXPECT_LT(picture.motion, pixel_tolerance(name));
    fmt::print("{}: world {:.1e} ({:.1e}, between frames {:.1e}), motion {:.1e} px, {} other\n", name, world, beyond,
               between, picture.motion, picture.other);
}

INSTANTIATE_TEST_SUITE_P(All, ExportScenes, testing::ValuesIn(list_authored_scenes()), [](const auto& info) {
    std::string name = info.param.substr(0, info.param.rfind('.'));
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});

}  // namespace
}  // namespace aleph
