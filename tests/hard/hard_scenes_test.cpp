// The scenes of scenes/hard: every one renders to finite numbers on every frame, and what its first lines promise
// holds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "engine/archive.h"
#include "engine/base/color.h"
#include "render/sequence.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

const fs::path& folder() {
    static const fs::path path = fs::path(ALEPH_SOURCE_DIR) / "scenes" / "hard";
    return path;
}

RenderSettings small_settings() {
    RenderSettings settings;
    settings.width = 48;
    settings.height = 36;
    settings.spp = 1;
    settings.gather = 64;
    settings.light_samples = 4;
    return settings;
}

/// A scene of the folder with what renders it.
struct HardScene {
    explicit HardScene(const std::string& name)
        : scene(load_scene(folder() / (name + ".json"))), sequence(scene, small_settings()) {}
    FrameOutput render(std::int64_t frame) {
        return sequence.render(frame, {.frame = true, .maps = true, .progress = {}});
    }
    int node(const std::string& name) const {
        for (std::size_t i = 0; i < scene.nodes.size(); ++i)
            if (scene.nodes[i].name == name) return static_cast<int>(i);
        ADD_FAILURE() << "no node " << name;
        return 0;
    }
    SceneFrame posed(double frame) const { return pose(scene, frame / scene.frame_rate.per_second()); }
    glm::dmat4 world(const std::string& name, double frame) const {
        return posed(frame).world[static_cast<std::size_t>(node(name))];
    }
    /// Pixels whose first hit is on a node.
    std::vector<std::size_t> pixels_on(const FrameOutput& output, const std::string& name) const {
        const std::vector<Instance> instances = list_instances(scene);
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < output.hits.size(); ++i) {
            const int instance = output.hits.pixels[i].instance;
            if (instance != no_index && instances[static_cast<std::size_t>(instance)].node == node(name))
                pixels.push_back(i);
        }
        return pixels;
    }

    Scene scene;
    Sequence sequence;
};

double mean_luminance(const Image<Rgb>& image) {
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) sum += luminance(pixel);
    return sum / static_cast<double>(image.size());
}

double longest_motion(const FrameOutput& output) {
    double longest = 0.0;
    for (const glm::dvec2& d : output.motion.displacement.pixels) longest = std::max(longest, glm::length(d));
    return longest;
}

bool warns(const Scene& scene, const std::string& words) {
    return std::ranges::any_of(scene.warnings,
                               [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

void expect_all_finite(const FrameOutput& output) {
    for (const Rgb& pixel : output.shaded.color.pixels)
        ASSERT_TRUE(std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b));
    for (const float aleph : output.perception.aleph.pixels) ASSERT_TRUE(aleph >= 1.0f && aleph <= 250.76f) << aleph;
    for (const float s : output.perception.saliency.pixels) ASSERT_TRUE(s >= 0.0f && s <= 1.0f) << s;
    for (const float v : output.velocity.pixels) ASSERT_TRUE(v >= 0.0f && std::isfinite(v)) << v;
    for (const float t : output.threshold.pixels) ASSERT_TRUE(t > 0.0f && std::isfinite(t)) << t;
    for (const glm::dvec2& d : output.motion.displacement.pixels)
        ASSERT_TRUE(glm::length(d) <= std::hypot(48.0, 36.0) + 1e-9) << d.x << " " << d.y;
    EXPECT_EQ(output.statistics.nan_count, 0u);
    EXPECT_EQ(output.statistics.invalid_rays, 0u);
    EXPECT_EQ(output.statistics.traced_rays, output.statistics.rays.total());
}

class EveryHardScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryHardScene, RendersToFiniteNumbers) {
    HardScene hard(GetParam());
    const FrameRange range = hard.sequence.range();
    for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
        SCOPED_TRACE(frame);
        expect_all_finite(hard.render(frame));
        if (HasFatalFailure()) return;
    }
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder()))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

INSTANTIATE_TEST_SUITE_P(All, EveryHardScene, testing::ValuesIn(scene_names()),
                         [](const auto& parameter) { return parameter.param; });

TEST(HardScenes, AreListedInTheReadme) {
    std::ifstream file(folder() / "README.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (const std::string& name : scene_names()) EXPECT_NE(text.find("| `" + name + "` |"), std::string::npos) << name;
}

void expect_rotation(const glm::dmat4& world, double scale = 1.0) {
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            EXPECT_NEAR(glm::dot(glm::dvec3(world[a]), glm::dvec3(world[b])), a == b ? scale * scale : 0.0, 1e-12);
}

TEST(HardScenes, KF03_HalfTurnGoesOneWay) {
    const HardScene hard("half_turn");
    const glm::dmat4 middle = hard.world("thing", 1);
    expect_rotation(middle);
    EXPECT_NEAR(std::abs(middle[0].z), 1.0, 1e-12);
}
TEST(HardScenes, KF04_KeysOfAnyLengthAreRotations) {
    const HardScene hard("unequal_quaternions");
    for (const double frame : {0.0, 0.7, 1.0, 2.0}) expect_rotation(hard.world("thing", frame));
    EXPECT_TRUE(warns(hard.scene, "length 0.5"));
}
TEST(HardScenes, KF08_SplineThroughZeroHolds) {
    const HardScene hard("spline_through_zero");
    for (const double frame : {0.9, 1.0, 1.1}) expect_rotation(hard.world("thing", frame));
}
TEST(HardScenes, KF12_KF13_KeysHold) {
    HardScene hard("held_keys");
    EXPECT_EQ(hard.world("thing", 0), hard.world("thing", 2));
    EXPECT_EQ(hard.world("thing", 100), hard.world("thing", 4));
    EXPECT_NEAR(hard.world("thing", 3)[3].x, 0.5, 1e-12);
    EXPECT_EQ(longest_motion(hard.render(0)), 0.0);
    EXPECT_GT(longest_motion(hard.render(2)), 1.0);
}
TEST(HardScenes, KF14_KF16_TenHoursIn) {
    const HardScene hard("ten_hours");
    EXPECT_EQ(hard.world("thing", 1080001)[3].x, 1.0);
}
TEST(HardScenes, KF17_MirroredScaleKeepsItsLight) {
    HardScene hard("mirrored");
    Scene straight = hard.scene;
    Node& thing = straight.nodes[static_cast<std::size_t>(hard.node("thing"))];
    thing.scale = glm::dvec3(1.0);  // unmirrored and turned the other way: the whole picture's mirror image
    thing.axis_rotation->angle = Track<double>(-20.0 * std::numbers::pi / 180.0);
    RenderSettings settings = small_settings();
    settings.light_samples = 256;
    settings.gather = 1024;
    Sequence mirrored(hard.scene, settings), sequence(straight, settings);
    const Image<Rgb> picture = mirrored.render(0).shaded.color, other = sequence.render(0).shaded.color;
    double sum = 0.0, difference = 0.0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const double a = luminance(picture(x, y)), b = luminance(other(picture.width - 1 - x, y));
            sum += a;
            difference += std::abs(a - b);
        }
    }
    EXPECT_GT(sum, 1.0);
    EXPECT_LT(difference / sum, 0.03);  // noise
}
TEST(HardScenes, KF18_FlattenedIsLeftOut) {
    HardScene hard("flattened");
    const FrameOutput output = hard.render(0);
    EXPECT_TRUE(hard.pixels_on(output, "thing").empty());
    EXPECT_TRUE(hard.pixels_on(output, "gone").empty());
    EXPECT_GT(mean_luminance(output.shaded.color), 0.01);
}
TEST(HardScenes, KF19_TinyScaleLooksLikeABox) {
    HardScene hard("tiny_scale");
    EXPECT_GT(hard.pixels_on(hard.render(0), "thing").size(), 50u);
}
TEST(HardScenes, KF20_ScaleThroughZeroHasNoMotionThere) {
    HardScene hard("scale_through_zero");
    EXPECT_TRUE(hard.pixels_on(hard.render(1), "thing").empty());
    EXPECT_FALSE(hard.pixels_on(hard.render(0), "thing").empty());
    EXPECT_FALSE(hard.pixels_on(hard.render(2), "thing").empty());
}
TEST(HardScenes, KF21_ShearedKeysAreExact) {
    const HardScene hard("sheared_matrices");
    EXPECT_EQ(hard.world("thing", 0)[1].x, 0.5);
    EXPECT_EQ(hard.world("thing", 2)[0].y, 0.5);
    EXPECT_NEAR(glm::determinant(glm::dmat3(hard.world("thing", 1))), 1.0, 0.1);
}
TEST(HardScenes, KF22_MatrixTurnKeepsItsVolume) {
    const HardScene hard("matrix_half_turn");
    EXPECT_NEAR(glm::determinant(glm::dmat3(hard.world("thing", 1))), 1.0, 1e-12);
}
TEST(HardScenes, KF23_EqualReflectionsStay) {
    HardScene hard("reflected_keys");
    EXPECT_EQ(hard.world("thing", 0), hard.world("thing", 1));
    EXPECT_EQ(longest_motion(hard.render(0)), 0.0);
}
TEST(HardScenes, KF24_AHundredTurnsAreOne) {
    const HardScene hard("deep_hierarchy");
    const glm::dmat4 world = hard.world("thing", 0);
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(world[c][r], c == r ? 1.0 : 0.0, 1e-12);
}
TEST(HardScenes, KF25_RP02_FarAwayMovesAsNear) {
    HardScene hard("far_away");
    Scene near = hard.scene;
    for (Node& node : near.nodes)
        for (glm::dvec3& key : node.translation.values) key -= glm::dvec3(1e6, 0.0, -1e6);
    Sequence sequence(near, small_settings());
    const FrameOutput far_frame = hard.render(0);
    const FrameOutput near_frame = sequence.render(0, {.frame = true, .maps = true, .progress = {}});
    std::size_t compared = 0;
    for (std::size_t i = 0; i < far_frame.hits.size(); ++i) {
        if (far_frame.hits.pixels[i].instance != near_frame.hits.pixels[i].instance) continue;  // an edge
        ++compared;
        const glm::dvec2 d = far_frame.motion.displacement.pixels[i] - near_frame.motion.displacement.pixels[i];
        ASSERT_LT(glm::length(d), 1e-6);
    }
    EXPECT_GT(compared, far_frame.hits.size() * 99 / 100);
    EXPECT_GT(longest_motion(far_frame), 0.5);
}
TEST(HardScenes, KF26_NormalsOfShearedFaces) {
    HardScene hard("squeezed_parent");
    const FrameOutput output = hard.render(0);
    const glm::dmat3 linear(hard.world("thing", 0));
    const std::vector<std::size_t> pixels = hard.pixels_on(output, "thing");
    ASSERT_FALSE(pixels.empty());
    for (const std::size_t i : pixels) {
        // Perpendicular to two of the box's edges as they stand in the world.
        int perpendicular = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(glm::dot(glm::normalize(linear[axis]), glm::dvec3(output.normal.pixels[i]))) < 1e-6)
                ++perpendicular;
        EXPECT_EQ(perpendicular, 2);
    }
}
TEST(HardScenes, KF27_LookingDownSeesTheBox) {
    HardScene hard("looking_down");
    const FrameOutput output = hard.render(0);
    EXPECT_NEAR(output.normal(24, 18).y, 1.0, 1e-6);
    EXPECT_NEAR(output.depth(24, 18), 3.0, 1e-5);
}
TEST(HardScenes, RP01_StaticIsExactlyStill) {
    HardScene hard("static");
    EXPECT_EQ(longest_motion(hard.render(0)), 0.0);
}
TEST(HardScenes, RP02_RP03_CreepingIsMeasuredAndNotSalient) {
    HardScene hard("creeping");
    const FrameOutput output = hard.render(0);
    const double pixels_per_unit = 18.0 / std::tan(20.0 * std::numbers::pi / 180.0);
    for (std::size_t i = 0; i < output.hits.size(); ++i) {
        if (output.hits.pixels[i].instance == no_index) continue;
        const double expected = pixels_per_unit * 1e-6 / output.depth.pixels[i];
        ASSERT_NEAR(glm::length(output.motion.displacement.pixels[i]), expected, 1e-3 * expected);
    }
    for (const float m : output.perception.conspicuity_motion.pixels) ASSERT_EQ(m, 0.0f);
}
TEST(HardScenes, RP04_RP06_BehindTheNextCameraIsFlagged) {
    HardScene hard("flying_through");
    std::size_t behind = 0;
    for (const std::int64_t frame : {0, 1})
        for (const MotionValidity v : hard.render(frame).motion.validity.pixels)
            behind += v == MotionValidity::behind_camera ? 1 : 0;
    EXPECT_GT(behind, 100u);
}
TEST(HardScenes, RP07_SpinHasTheLengthOfItsArc) {
    HardScene hard("spinning");
    const FrameOutput output = hard.render(0);
    double longest_path = 0.0, chord = 0.0;
    for (const std::size_t i : hard.pixels_on(output, "thing")) {
        if (output.motion.path_length.pixels[i] <= longest_path) continue;
        longest_path = output.motion.path_length.pixels[i];
        chord = glm::length(output.motion.displacement.pixels[i]);
    }
    EXPECT_GT(longest_path, 15.0 * chord);  // 350 degrees of arc against 10 of chord: 35 times
}
TEST(HardScenes, RP08_LongTurnsAreWarnedOf) {
    EXPECT_TRUE(warns(HardScene("long_way_round").scene, "270 degrees apart"));
}
TEST(HardScenes, RP09_SkyMovesByRotationAlone) {
    HardScene hard("sky");
    const FrameOutput output = hard.render(0);
    const double pixels_per_unit = 18.0 / std::tan(20.0 * std::numbers::pi / 180.0);
    ASSERT_EQ(output.hits(24, 2).instance, no_index);
    const double from = std::atan(0.5 / pixels_per_unit), turn = std::numbers::pi / 180.0;
    const double expected = pixels_per_unit * (std::tan(from + turn) - std::tan(from));
    EXPECT_NEAR(std::abs(output.motion.displacement(24, 17).x), expected, 0.05 * expected);
}
TEST(HardScenes, RP10_NoMotionAcrossACut) {
    HardScene hard("camera_cut");
    EXPECT_EQ(longest_motion(hard.render(1)), 0.0);
}
TEST(HardScenes, RP12_AppearingHasNoCounterpart) {
    HardScene hard("appearing");
    EXPECT_TRUE(hard.pixels_on(hard.render(0), "thing").empty());
    const FrameOutput output = hard.render(1);
    const std::vector<std::size_t> pixels = hard.pixels_on(output, "thing");
    ASSERT_FALSE(pixels.empty());
    for (const std::size_t i : pixels) {
        EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::no_counterpart);
        EXPECT_EQ(output.motion.displacement.pixels[i], glm::dvec2(0.0));
    }
}
TEST(HardScenes, RP13_LeavingKeepsItsDisplacement) {
    HardScene hard("leaving");
    const FrameOutput output = hard.render(0);
    for (const std::size_t i : hard.pixels_on(output, "thing")) {
        EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::leaves_screen);
        EXPECT_GT(output.motion.displacement.pixels[i].x, 30.0);
    }
}
TEST(HardScenes, RP14_DeformingMovesAsRigid) {
    HardScene hard("deforming");
    Scene rigid = hard.scene;
    Mesh& mesh =
        rigid
            .meshes[static_cast<std::size_t>(rigid.nodes[static_cast<std::size_t>(hard.node("thing"))].meshes.front())];
    mesh.points = no_index;
    Node& node = rigid.nodes[static_cast<std::size_t>(hard.node("thing"))];
    node.translation.sampling = {.kind = TimeSampling::Kind::acyclic, .times = {0.0, 2.0 / 30.0}};
    node.translation.values = {{0.0, 0.5, 0.0}, {0.5, 0.5, 0.0}};
    Sequence sequence(rigid, small_settings());
    const FrameOutput output = hard.render(0);
    const FrameOutput expected = sequence.render(0, {.frame = true, .maps = true, .progress = {}});
    const std::vector<std::size_t> pixels = hard.pixels_on(output, "thing");
    ASSERT_FALSE(pixels.empty());
    for (const std::size_t i : pixels) {
        EXPECT_GT(output.motion.displacement.pixels[i].x, 0.5);
        EXPECT_LT(glm::length(output.motion.displacement.pixels[i] - expected.motion.displacement.pixels[i]), 1e-6);
    }
}
TEST(HardScenes, RP15_NoMotionAcrossATopologyChange) {
    HardScene hard("changing_topology");
    const FrameOutput output = hard.render(0);
    const std::vector<std::size_t> pixels = hard.pixels_on(output, "a");
    ASSERT_FALSE(pixels.empty());
    for (const std::size_t i : pixels) EXPECT_EQ(output.motion.validity.pixels[i], MotionValidity::no_counterpart);
    EXPECT_FALSE(hard.pixels_on(hard.render(1), "b").empty());
}
TEST(HardScenes, RP16_RP17_StillCageIsExactlyStill) {
    HardScene hard("subdivided");
    const FrameOutput output = hard.render(0);
    const std::vector<std::size_t> still = hard.pixels_on(output, "thing"), swaying = hard.pixels_on(output, "swaying");
    ASSERT_FALSE(still.empty());
    for (const std::size_t i : still) EXPECT_EQ(output.motion.displacement.pixels[i], glm::dvec2(0.0));
    double longest = 0.0;
    for (const std::size_t i : swaying) longest = std::max(longest, glm::length(output.motion.displacement.pixels[i]));
    EXPECT_GT(longest, 0.1);
}
TEST(HardScenes, RC05_MillimetreWorldIsThePictureInMetres) {
    HardScene tiny("millimetre_world");
    HardScene hard("still_keys");  // the same things at their own size
    const Image<Rgb> small = tiny.render(0).shaded.color, large = hard.render(0).shaded.color;
    EXPECT_NEAR(mean_luminance(small) / mean_luminance(large), 1.0, 0.02);
}
TEST(HardScenes, RC06_IC08_SealedLampIsDarkOutside) {
    HardScene hard("sealed_lamp");
    const FrameOutput output = hard.render(0);
    for (const Rgb& pixel : output.shaded.color.pixels) ASSERT_EQ(luminance(pixel), 0.0f);
}
TEST(HardScenes, RC07_TheFirstOfCoplanarWins) {
    HardScene hard("coplanar");
    const FrameOutput output = hard.render(0);
    const std::vector<std::size_t> one = hard.pixels_on(output, "one"), two = hard.pixels_on(output, "two");
    ASSERT_FALSE(one.empty());
    ASSERT_FALSE(two.empty());
    // In the plane z = 0 the first ends at x = 1; the second may only be seen beyond.
    const double pixels_per_unit = 18.0 / std::tan(20.0 * std::numbers::pi / 180.0);
    for (const std::size_t i : two) {
        const double x = (static_cast<double>(i % 48) + 0.5 - 24.0) / pixels_per_unit * output.depth.pixels[i];
        EXPECT_GT(x, 1.0 - 1e-6);
    }
}
TEST(HardScenes, RC09_DegenerateTrianglesAreCounted) {
    const HardScene hard("slivers");
    EXPECT_EQ(RayScene(hard.scene).degenerate_triangles(), 2u);
}
TEST(HardScenes, RC10_EmptySceneShowsItsEnvironment) {
    HardScene hard("empty");
    const FrameOutput output = hard.render(0);
    EXPECT_NEAR(output.shaded.color(5, 5).g, 0.3f, 1e-6f);
    EXPECT_EQ(output.shaded.coverage(5, 5), 0.0f);
}
TEST(HardScenes, RC11_BadNormalsAreReplaced) {
    HardScene hard("bad_normals");
    const FrameOutput output = hard.render(0);
    const std::vector<std::size_t> pixels = hard.pixels_on(output, "thing");
    ASSERT_FALSE(pixels.empty());
    for (const std::size_t i : pixels) {
        EXPECT_NEAR(glm::length(output.normal.pixels[i]), 1.0f, 1e-5f);
        EXPECT_GT(output.normal.pixels[i].z, 0.0f);
        EXPECT_GT(luminance(output.shaded.color.pixels[i]), 0.0f);
    }
}
TEST(HardScenes, BlankWallHasAlephOne) {
    HardScene hard("blank_wall");
    const FrameOutput output = hard.render(0);
    for (const float aleph : output.perception.aleph.pixels) ASSERT_EQ(aleph, 1.0f);
    EXPECT_TRUE(output.statistics.saliency_fallback);
}
TEST(HardScenes, CS10_MC17_BlackIsBlack) {
    HardScene hard("black");
    const FrameOutput output = hard.render(0);
    for (const Rgb& pixel : output.shaded.color.pixels) ASSERT_EQ(luminance(pixel), 0.0f);
}
TEST(HardScenes, MC10_MC11_NoSpikeBesideALampThatTouches) {
    HardScene hard("touching_lamp");
    const FrameOutput output = hard.render(0);
    // A floor of albedo .6 sees at most half its sky filled by each side of the panel, at radiance 3, and a little of
    // what the wall returns.
    for (const std::size_t i : hard.pixels_on(output, "floor"))
        ASSERT_LT(luminance(output.shaded.color.pixels[i]), 3.0f);
}
TEST(HardScenes, OU01_MC13_BrightSparkIsFinite) {
    HardScene hard("bright_spark");
    EXPECT_GT(mean_luminance(hard.render(0).shaded.color), 0.1);
}
TEST(HardScenes, FX01_EqualKeysAreNoAnimation) {
    const HardScene hard("still_keys");
    EXPECT_FALSE(is_world_animated(hard.scene));
}

}  // namespace
}  // namespace aleph
