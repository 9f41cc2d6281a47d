// The scenes of scenes/hard: every frame of every scene renders to finite numbers, and the scenes about rays and light
// have the results that scenes/hard/README.md expects.

#include "tests/scenes/hard_scenes.h"
#include "engine/load/warnings.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

void expect_all_finite(const FrameOutput& output) {
    for (const Rgb& pixel : output.shaded.color.pixels)
        ASSERT_TRUE(std::isfinite(pixel.r) && std::isfinite(pixel.g) && std::isfinite(pixel.b));
    for (const float aleph : output.perception.aleph.pixels) ASSERT_TRUE(aleph >= 1.0f && aleph <= 250.76f) << aleph;
    for (const float s : output.perception.saliency.pixels) ASSERT_TRUE(s >= 0.0f && s <= 1.0f) << s;
    for (const float v : output.velocity.pixels) ASSERT_TRUE(v >= 0.0f && std::isfinite(v)) << v;
    for (const float t : output.limits.threshold.pixels) ASSERT_TRUE(t > 0.0f && std::isfinite(t)) << t;
    for (const glm::dvec2& d : output.motion.displacement.pixels)
        ASSERT_TRUE(glm::length(d) <= std::hypot(48.0, 36.0) + 1e-9) << d.x << " " << d.y;
    EXPECT_EQ(output.statistics.counts.invalid_samples, 0u);
    EXPECT_EQ(output.statistics.traced.invalid, 0u);
    EXPECT_EQ(output.statistics.traced.all, output.statistics.counts.rays.total());
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
    for (const auto& entry : std::filesystem::directory_iterator(hard_scenes_folder()))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

INSTANTIATE_TEST_SUITE_P(All, EveryHardScene, testing::ValuesIn(scene_names()),
                         [](const auto& parameter) { return parameter.param; });

TEST(HardScenes, AreListedInTheReadme) {
    const std::string text = read_bytes(hard_scenes_folder() / "README.md");
    for (const std::string& name : scene_names()) EXPECT_NE(text.find("| `" + name + "` |"), std::string::npos) << name;
}

TEST(HardScenes, RC02_FlattenedObjectsAreSaid) {
    EXPECT_TRUE(has_warning(HardScene("flattened").scene, "node \"thing\" and 1 more: the scale is 0"));
    EXPECT_FALSE(has_warning(HardScene("scale_through_zero").scene, "the scale is 0"));
    EXPECT_FALSE(has_warning(HardScene("tiny_scale").scene, "the scale is 0"));
}
TEST(HardScenes, RC05_MillimetreWorldIsThePictureInMetres) {
    HardScene tiny("millimetre_world");
    HardScene hard("still_keys");  // the same scene in metres
    const Image<Rgb> small = tiny.render(0).shaded.color, large = hard.render(0).shaded.color;
    EXPECT_NEAR(mean_luminance(small) / mean_luminance(large), 1.0, 0.005);
    std::vector<double> differences;
    for (std::size_t i = 0; i < small.size(); ++i) {
        const double a = luminance(small.pixels[i]), b = luminance(large.pixels[i]);
        differences.push_back(std::abs(a - b) / std::max(b, 1e-6));
    }
    std::ranges::sort(differences);
    // Pixel by pixel, but for the few where single precision decides what is seen, or which record is near enough.
    EXPECT_LT(differences[differences.size() / 2], 1e-3);
    EXPECT_LT(differences[differences.size() * 9 / 10], 0.01);
}
void expect_black(const std::string& name) {
    HardScene hard(name);
    const FrameOutput output = hard.render(0);
    for (const Rgb& pixel : output.shaded.color.pixels) ASSERT_EQ(luminance(pixel), 0.0f);
}
TEST(HardScenes, RC06_IC08_SealedLampIsDarkOutside) {
    expect_black("sealed_lamp");
}
TEST(HardScenes, RC07_TheFirstOfCoplanarWins) {
    HardScene hard("coplanar");
    const FrameOutput output = hard.render(0);
    const std::vector<std::size_t> one = hard.pixels_on(output, "one"), two = hard.pixels_on(output, "two");
    ASSERT_FALSE(one.empty());
    ASSERT_FALSE(two.empty());
    // In the plane z = 0 the first quad ends at x = 1; the second may be visible only beyond that.
    for (const std::size_t i : two) {
        const double x = (static_cast<double>(i % 48) + 0.5 - 24.0) / pixels_per_unit * output.surface.depth.pixels[i];
        EXPECT_GT(x, 1.0 - 1e-6);
    }
}
TEST(HardScenes, RC10_EmptySceneShowsItsEnvironment) {
    HardScene hard("empty");
    const FrameOutput output = hard.render(0);
    EXPECT_NEAR(output.shaded.color(5, 5).g, 0.3f, 1e-6f);
    EXPECT_EQ(output.shaded.coverage(5, 5), 0.0f);
}
TEST(HardScenes, RC10_WithoutSurfacesOrCameraTheEnvironmentShows) {
    // No mesh, a mesh without vertices, one without triangles, one that is a single point.
    Mesh cloud, point;
    cloud.positions = {{-1.0f, 0.0f, 0.0f}, {1.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 3.0f}};
    point.positions = std::vector<glm::vec3>(3, glm::vec3(0.5f));
    point.triangles = {{0, 1, 2}};
    const std::vector<std::vector<Mesh>> cases = {{}, {Mesh()}, {cloud}, {point}, {Mesh(), cloud, point}};
    for (const std::vector<Mesh>& meshes : cases) {
        for (const Rgb& environment : {Rgb(0.2f, 0.3f, 0.4f), Rgb(0.0f)}) {
            Scene scene;
            scene.meshes = meshes;
            for (int m = 0; m < std::ssize(meshes); ++m) scene.nodes.emplace_back().meshes = {m};
            if (environment.x > 0.0f) scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(environment));
            scene.film.exposure = 1.0;
            add_framing_camera(scene);
            EXPECT_TRUE(has_warning(scene, "there is no camera"));
            EXPECT_EQ(has_warning(scene, "nothing to see"),
                      meshes.empty() || (meshes.size() == 1 && meshes[0].positions.empty()));
            const CameraValues camera = pose(scene, 0.0).cameras.at(0);
            for (int k = 0; k < 3; ++k) {
                EXPECT_LT(std::abs(camera.position[k]), 1e3);
                EXPECT_NEAR(glm::length(camera.axes[k]), 1.0, 1e-12);
            }
            const FrameOutput output = render_hard(scene, 0);
            expect_all_finite(output);
            for (const Rgb& pixel : output.shaded.color.pixels) ASSERT_EQ(pixel, environment);
            for (const float coverage : output.shaded.coverage.pixels) ASSERT_EQ(coverage, 0.0f);
        }
    }
}
TEST(HardScenes, RC11_BadNormalsAreReplaced) {
    HardScene hard("bad_normals");
    const FrameOutput output = hard.render(0);
    for (const std::size_t i : hard.seen_on(output, "thing")) {
        EXPECT_NEAR(glm::length(output.surface.normal.pixels[i]), 1.0f, 1e-5f);
        EXPECT_GT(output.surface.normal.pixels[i].z, 0.0f);
        EXPECT_GT(luminance(output.shaded.color.pixels[i]), 0.0f);
    }
}
TEST(HardScenes, BlankWallHasAlephOne) {
    HardScene hard("blank_wall");
    const FrameOutput output = hard.render(0);
    for (const float aleph : output.perception.aleph.pixels) ASSERT_EQ(aleph, 1.0f);
    EXPECT_TRUE(output.statistics.estimate.saliency_fallback);
}
TEST(HardScenes, CS10_MC17_BlackIsBlack) {
    expect_black("black");
}
TEST(HardScenes, MC10_MC11_NoSpikeBesideALampThatTouches) {
    HardScene hard("touching_lamp");
    const FrameOutput output = hard.render(0);
    // The floor has albedo 0.6. Each side of the lamp, of radiance 3, covers at most half of the hemisphere, and the
    // wall adds a little indirect light.
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
