// A moving truck and a lit box, our own models (tests/assets/gltf/author_models.py) and, where they are there, those
// that other programs wrote: they move and render.

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

RenderSettings small_settings() {
    RenderSettings settings = quick_settings(96, 72);
    settings.cache.accuracy = 0.3;
    return settings;
}

/// Its parameter: name in tests/assets/gltf or in the folder of other programs' files.
class AssetRender : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        file_ = own_assets_folder() / "gltf" / GetParam();
        if (!std::filesystem::exists(file_)) file_ = assets_folder() / "gltf" / GetParam();
        if (!std::filesystem::exists(file_)) GTEST_SKIP() << missing_asset(file_);
    }
    std::filesystem::path file_;
};
class TruckRender : public AssetRender {};
class BoxRender : public AssetRender {};

const auto name_of = [](const auto& file) { return std::filesystem::path(file.param).stem().string(); };
INSTANTIATE_TEST_SUITE_P(All, TruckRender, testing::Values("truck.glb", "CesiumMilkTruck.glb"), name_of);
INSTANTIATE_TEST_SUITE_P(All, BoxRender, testing::Values("lamp_box.glb", "CornellBox.glb"), name_of);

TEST_P(TruckRender, RollsItsWheelsAndNothingElse) {
    const Scene scene = load_scene(file_);
    Sequence sequence(scene, small_settings());
    const FrameOutput output = sequence.render(3, {.frame = true, .maps = true, .progress = {}});
    const ScenePose frame = pose(scene, scene.film.frame_rate.seconds_of(3));
    int wheel_pixels = 0, body_pixels = 0;
    double fastest = 0.0;
    for (const auto [x, y] : all_pixels(output.view)) {
        const Hit& hit = output.hits(x, y);
        if (hit.instance == no_index) continue;
        const int node = frame.instances[hit.instance].node;
        const double moved = glm::length(output.motion.displacement(x, y));
        if (is_animated(scene.nodes[node].transform.rotation)) {
            ++wheel_pixels;
            fastest = std::max(fastest, moved);
        } else {
            ++body_pixels;
            EXPECT_EQ(moved, 0.0) << x << ", " << y;
        }
    }
    EXPECT_GT(wheel_pixels, 20);
    EXPECT_GT(body_pixels, 200);
    // A rim of at most .438 m turns by the animation's step per frame. In the picture, its chord is at most as long as
    // at the nearest distance.
    const double turn =
        glm::angle(glm::inverse(evaluate(scene.nodes.back().transform.rotation, scene.film.frame_rate.seconds_of(3))) *
                   evaluate(scene.nodes.back().transform.rotation, scene.film.frame_rate.seconds_of(4)));
    const double step = std::min(turn, 2.0 * 3.14159265358979 - turn);
    float nearest = 1e30f;
    for (const float z : output.surface.depth.pixels) nearest = std::min(nearest, z);
    EXPECT_GT(fastest, 0.2);
    EXPECT_LE(fastest, 2.0 * 0.4375 * std::sin(step / 2.0) * output.view.pixels_per_unit / nearest);

    const FrameStatistics& statistics = output.statistics;
    EXPECT_EQ(statistics.counts.invalid_samples, 0u);
    EXPECT_EQ(statistics.counts.rays.total(), statistics.traced.all);
    EXPECT_GT(statistics.counts.records, 0u);
    // The scene has no lights and gets a white environment, so the paint shows its texture's colour.
    double blueness = 0.0;
    for (std::size_t i = 0; i < output.shaded.color.size(); ++i) {
        const Rgb& c = output.shaded.color.pixels[i];
        if (output.hits.pixels[i].instance != no_index) blueness = std::max<double>(blueness, c.z - c.x);
        EXPECT_GE(luminance(c), 0.0f);
    }
    EXPECT_GT(blueness, 0.05);  // the sign on its side
}

TEST_P(BoxRender, BleedsColour) {
    const Scene scene = load_scene(file_);
    RenderSettings settings = small_settings();
    settings.cache.gather = 256;
    const auto render = [&](int bounces) {
        RenderSettings s = settings;
        s.light.bounces = bounces;
        return Sequence(scene, s).render(0);
    };
    const FrameOutput direct = render(0), full = render(1);
    EXPECT_EQ(direct.statistics.counts.rays.gather, 0u);
    // The light that the bounce adds has the walls' colours: reddish on one side of the picture, greenish on the other.
    Rgb left(0.0f), right(0.0f);
    double more = 0.0, less = 0.0;  // reflections are sampled, so single pixels may get darker
    for (const auto [x, y] : all_pixels(96, 72)) {
        const Rgb added = full.shaded.color(x, y) - direct.shaded.color(x, y);
        (luminance(added) >= 0.0f ? more : less) += luminance(added);
        const auto& hit = full.hits(x, y);
        if (hit.instance == no_index) continue;
        (x < 48 ? left : right) += added;
    }
    EXPECT_LT(-less, 0.05 * more);
    const float left_tint = (left.x - left.y) / luminance(left), right_tint = (right.x - right.y) / luminance(right);
    EXPECT_GT(std::abs(left_tint - right_tint), 0.1f);
    EXPECT_LT(left_tint * right_tint, 0.0f) << left_tint << " " << right_tint;
    // Neither the scene nor the camera moves.
    const FrameOutput maps = Sequence(scene, settings).render(0, {.frame = false, .maps = true, .progress = {}});
    for (const glm::dvec2& d : maps.motion.displacement.pixels) EXPECT_EQ(d, glm::dvec2(0.0));
}

}  // namespace
}  // namespace aleph
