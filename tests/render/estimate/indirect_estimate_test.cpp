// The quick estimate: lamps behind bars; amount and smoothness of its indirect light; the thresholds of vision that it
// gives.

#include "engine/load/load_scene.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "render/estimate/estimate.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Image<Rgb> estimate(const Stage& stage, bool indirect, RayCounts& counts) {
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::optional<EstimateNodes> nodes;
    if (indirect) nodes = gather_estimate(stage.lighting(), stage.view, centers, nullptr, counts);
    return compute_estimate(stage.lighting(), stage.view, centers, {.indirect = nodes ? &*nodes : nullptr}, counts);
}

Image<float> indirect_part(const Stage& stage) {
    RayCounts counts;
    const Image<Rgb> with = estimate(stage, true, counts), without = estimate(stage, false, counts);
    Image<float> part(with.width, with.height);
    for (std::size_t i = 0; i < part.size(); ++i) {
        part.pixels[i] = luminance(with.pixels[i]) - luminance(without.pixels[i]);
    }
    return part;
}

Scene make_room() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.6), glm::dvec3(0.0), true);
    add_mesh(scene, make_box(glm::dvec3(4.0), grey));
    add_light(scene, Light::Kind::point, glm::dvec3(20.0), {0.5, 0.6, 0.3});
    add_camera(scene, {0.0, 0.0, 1.9}, {0.0, 0.0, 0.0}, 1.2);
    return scene;
}

TEST(IndirectEstimate, IsTheFirstBounceInAFurnace) {
    // Inside a closed body that emits 1 and reflects .5, the light of one bounce is .25 everywhere.
    Scene scene;
    add_mesh(scene, make_faceted_sphere(1.0, 24, add_lambert(scene, glm::dvec3(0.5), glm::dvec3(1.0), true)));
    const Stage stage(std::move(scene), 32, 24);
    double sum = 0.0;
    const Image<float> part = indirect_part(stage);
    for (const float v : part.pixels) {
        EXPECT_NEAR(v, 0.25, 0.12);
        sum += v;
    }
    EXPECT_NEAR(sum / static_cast<double>(part.size()), 0.25, 0.03);
}

TEST(IndirectEstimate, NothingIsAddedWhereNothingReflects) {
    Scene scene;
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.8))), {0.0, -1.0, 0.0}, z_to_up);
    add_light(scene, Light::Kind::point, glm::dvec3(20.0), {0.0, 2.0, -3.0});
    const Stage stage(std::move(scene), 32, 24);
    const Image<float> part = indirect_part(stage);
    EXPECT_EQ(part.pixels, Image<float>(32, 24, 0.0f).pixels);
}

/// A floor below five lamps of 1 m, each behind three bars.
/// @param width  m, of a bar
Image<Rgb> estimate_below_windows(double width) {
    Scene scene;
    const int black = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.8))), {0.0, -1.0, 0.0}, z_to_up);
    for (int lamp = 0; lamp < 5; ++lamp) {
        const glm::dvec3 center(2.0 * lamp - 4.0, 2.0, -3.0);
        add_lamp(scene, 1.0, glm::dvec3(5.0), center);
        for (const double bar : {-0.25, 0.0, 0.25})
            add_mesh(scene, make_quad(1.0, width, black), center + glm::dvec3(0.0, -0.05, bar), z_to_down);
    }
    const Stage stage(std::move(scene), 32, 24);
    RayCounts counts;
    return estimate(stage, false, counts);
}

TEST(Estimate, BarsHideTheirShareOfAWindow) {
    const auto light = [](double width) {
        double sum = 0.0;
        for (const Rgb& pixel : estimate_below_windows(width).pixels) sum += luminance(pixel);
        return sum;
    };
    EXPECT_NEAR(light(0.2) / light(0.001), 0.4, 0.15) << "its open area";
}

TEST(IndirectEstimate, HasNoDetailOnAWall) {
    const Stage stage(make_room(), 160, 120);
    const Image<float> part = indirect_part(stage);
    // The middle of the picture is one wall. Blocks or noise would have large second differences.
    double largest = 0.0, lowest = 1e9, highest = 0.0;
    for (int y = 40; y < 80; ++y) {
        for (int x = 50; x < 110; ++x) {
            const double here = part(x, y);
            const double across = part(x - 1, y) - 2.0 * here + part(x + 1, y);
            const double along = part(x, y - 1) - 2.0 * here + part(x, y + 1);
            largest = std::max({largest, std::abs(across) / here, std::abs(along) / here});
            lowest = std::min(lowest, here);
            highest = std::max(highest, here);
        }
    }
    EXPECT_GT(lowest, 0.0);
    EXPECT_LT(highest, 4.0 * lowest);
    EXPECT_LT(largest, 0.03);
}

TEST(IndirectEstimate, NoBouncesMeansNone) {
    const auto maps = [](int bounces) {
        const RenderSettings settings{.picture = {.width = 40, .height = 30}, .light = {.bounces = bounces}};
        Sequence sequence(make_room(), settings);
        return std::pair(sequence.render(0, {.frame = false, .progress = {}}), sequence.exposure());
    };
    const auto [none, exposure_of_none] = maps(0);
    const auto [one, exposure_of_one] = maps(1);
    EXPECT_EQ(none.statistics.counts.rays.gather, 0u);
    EXPECT_GT(one.statistics.counts.rays.gather, 0u);
    EXPECT_EQ(exposure_of_none, exposure_of_one) << "automatic exposure takes direct light only";
    for (std::size_t i = 0; i < one.estimate.size(); ++i) {
        ASSERT_GE(luminance(one.estimate.pixels[i]), luminance(none.estimate.pixels[i]));
    }
}

/// The share of pixels whose thresholds differ by more than a factor of 2.
double share_beyond(const Image<float>& a, const Image<float>& b) {
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!(std::abs(std::log2(a.pixels[i] / b.pixels[i])) < 1.0)) ++beyond;
    }
    return static_cast<double>(beyond) / static_cast<double>(a.size());
}

TEST(IndirectEstimate, GivesTheThresholdsOfTheFinishedFrameInCornell) {
    const Scene scene = load_scene(source_folder() / "scenes/cornell/scene.json");
    RenderSettings settings{
        .picture = {.width = 128, .height = 96}, .cache = {.accuracy = 0.1, .gather = 256}, .sampling = {.spp = 1}};
    const auto render = [&](int bounces) {
        settings.light.bounces = bounces;
        return Sequence(scene, settings).render(10);
    };
    const FrameOutput direct = render(0), all = render(1);
    // The finished frame's indirect light on the estimate's direct light: both have the same penumbrae.
    Image<Rgb> finished = direct.estimate;
    for (std::size_t i = 0; i < finished.size(); ++i) {
        finished.pixels[i] += glm::max(all.shaded.color.pixels[i] - direct.shaded.color.pixels[i], Rgb(0.0f));
    }
    sanitize_estimate(finished);
    const PerceptionMaps maps =
        compute_perception(finished, all.velocity, scene.film.viewing, scene.film.frame_rate, settings.perception);
    const Image<float> threshold =
        compute_threshold(maps.aleph, compute_adaptation_luminance(finished, scene.film.viewing));
    EXPECT_LT(share_beyond(all.limits.threshold, threshold), 0.01);
    EXPECT_GT(share_beyond(direct.limits.threshold, threshold), 0.01) << "indirect light does not matter here";
}

}  // namespace
}  // namespace aleph
