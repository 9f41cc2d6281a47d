// Paths that look up irradiance where it is known: in rooms whose light is known exactly, and from a filled cache.
// Paths against a dense gather at every sample, and against the cache: the same picture.

#include "render/cache/bounce_places.h"
#include "render/cache/further_bounces.h"
#include "render/path/path.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/lobes.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double albedo = 0.5;

/// A closed box that glows inside: everything that a surface in it sees has the radiance 1 + albedo + albedo^2 with one
/// bounce, and the indirect irradiance pi albedo.
Scene make_glowing_box() {
    Scene scene;
    add_mesh(scene, make_box({2.0, 2.0, 2.0}, add_lambert(scene, glm::dvec3(albedo), glm::dvec3(1.0), true)));
    return scene;
}

struct ConstantIrradiance : KnownIrradiance {
    explicit ConstantIrradiance(int held) {
        bounces = held;
        find = [this](const ViewedSurface&, const Hit& hit, float accuracy, const Rgb&, RayTask&) {
            EXPECT_NE(hit.instance, no_index);
            ++lookups;
            least = std::min(least, accuracy);
            most = std::max(most, accuracy);
            return Rgb(static_cast<float>(pi * albedo));
        };
    }

    mutable int lookups = 0;
    mutable float least = 1.0f, most = 0.0f;  ///< accuracy asked for
};

PathState one_bounce(const KnownIrradiance* known) {
    PathState state;
    state.left = {1, 8};
    state.known = known;
    state.accuracy = 0.1f;
    return state;
}

/// Light that comes by the lobes other than the Lambert layer, as pixels of the cache integrator find it.
/// @param weighted  lights are sampled at the surface, too
Estimator by_lobe_rays(const PathState& state, bool weighted = false) {
    return [=](const Stage& stage, RayTask& task, const ViewedSurface& surface, RandomStream& random) {
        const LitSurface lit(surface);
        const LobeShares shares = share_lobes(lit, LobeSet::specular);
        // Without light sampling at the first surface, met light counts in full.
        ScatterSample sample = sample_scatter(lit, shares, random);
        if (!weighted) sample.pdf = 0.0f;
        return follow_sample(stage.lighting(), task, lit, sample, state, random);
    };
}

ViewedSurface make_inner_surface(const SurfaceMaterial& material) {
    const glm::vec3 view = glm::normalize(glm::vec3(0.4f, 0.8f, 0.1f));
    return {make_point({0.1f, -0.5f, 0.2f}, up), material, view};
}

TEST(KnownIrradianceTest, MC14_MirrorsGlassAndGlossShowTheFurnace) {
    const Stage stage(make_glowing_box());
    const double radiance = 1.0 + albedo + albedo * albedo;
    SurfaceMaterial glass = make_glass(0.0f, 1.5f, false);
    for (const SurfaceMaterial& material : {make_metal(0.0f), make_metal(0.3f), glass}) {
        const ViewedSurface surface = make_inner_surface(material);
        const ConstantIrradiance known(1);
        EXPECT_TRUE(holds([&](Trial& trial) {
            const int count = trial.times(4000);
            const Mean with = estimate(stage, surface, count, by_lobe_rays(one_bounce(&known)), 1 + trial.seed);
            trial.near(with, estimate(stage, surface, count, by_lobe_rays(one_bounce(nullptr)), 2 + trial.seed));
            if (material.is_mirror()) trial.near(with, radiance, 1e-4);
        }));
        EXPECT_GT(known.lookups, 3500);
    }
}

TEST(KnownIrradianceTest, ItCountsForItsOwnBouncesOnly) {
    const Stage stage(make_glowing_box());
    const ViewedSurface mirror = make_inner_surface(make_metal(0.0f));
    for (const int held : {2, 3}) {
        const ConstantIrradiance known(held);
        estimate(stage, mirror, 50, by_lobe_rays(one_bounce(&known)));
        EXPECT_EQ(known.lookups, 0) << held;
    }
    // Light of fewer bounces is asked for in the place of light of more.
    ConstantIrradiance more(2);
    const ConstantIrradiance fewer(1);
    more.fewer = &fewer;
    estimate(stage, mirror, 50, by_lobe_rays(one_bounce(&more)));
    EXPECT_EQ(more.lookups, 0);
    EXPECT_GT(fewer.lookups, 0);
    // The surface that the path begins at, and those behind a turn at a Lambert layer, are not looked up.
    const ConstantIrradiance known(1);
    const auto from_lambert = [&](const Stage& s, RayTask& task, const ViewedSurface& surface, RandomStream& random) {
        return scatter_light(s.lighting(), task, surface, one_bounce(&known), random);
    };
    estimate(stage, make_inner_surface(make_lambert(0.5f)), 50, from_lambert);
    EXPECT_EQ(known.lookups, 0);
    // The last surface may not scatter again.
    PathState last = one_bounce(&known);
    last.left.depth = 1;
    estimate(stage, mirror, 50, by_lobe_rays(last));
    EXPECT_EQ(known.lookups, 0);
}

TEST(KnownIrradianceTest, AccuracyIsLooserForFaintAndWideLobes) {
    const Stage stage(make_glowing_box());
    const auto asked = [&](SurfaceMaterial material, float reflectance, bool weighted = false) {
        material.gloss.f0 = Rgb(reflectance);
        material.gloss.f90 = reflectance;
        const ConstantIrradiance known(1);
        estimate(stage, make_inner_surface(material), 200, by_lobe_rays(one_bounce(&known), weighted));
        EXPECT_GT(known.lookups, 100);
        return std::pair(known.least, known.most);
    };
    const auto mirror = asked(make_metal(0.0f), 1.0f);
    EXPECT_FLOAT_EQ(mirror.first, 0.1f);
    EXPECT_FLOAT_EQ(mirror.second, 0.1f);
    EXPECT_NEAR(asked(make_metal(0.0f), 0.25f).first, 0.2f, 1e-5f);
    EXPECT_FLOAT_EQ(asked(make_metal(0.0f), 0.01f).first, 0.5f);
    // The density of a lobe is about 1 / (4 pi alpha^2) in its middle: wide lobes are looked up half as accurately.
    const double narrow = 0.1 * (1.0 + 0.1 * std::sqrt(4.0 * std::numbers::pi));
    EXPECT_NEAR(asked(make_metal(0.1f), 1.0f, true).first, narrow, 0.1 * narrow);
    EXPECT_NEAR(asked(make_metal(0.5f), 1.0f, true).first, 0.2, 0.02);
}

TEST(KnownIrradianceTest, SheenTakesItsShareOfIt) {
    const auto find = [](double sheen) {
        Scene scene = make_glowing_box();
        scene.materials[0].layers.sheen_color = glm::dvec3(sheen);
        scene.materials[0].layers.sheen_roughness = 1.0;
        const Stage stage(std::move(scene));
        ConstantIrradiance known(1), dark(1);
        dark.find = [](const ViewedSurface&, const Hit&, float, const Rgb&, RayTask&) { return Rgb(0.0f); };
        const auto seen = [&](const KnownIrradiance& light) {
            PathState state = one_bounce(&light);
            state.left.depth = 2;  // what the sheen scatters is not looked up
            return estimate(stage, make_inner_surface(make_metal(0.0f)), 1000, by_lobe_rays(state)).mean();
        };
        return seen(known) - seen(dark);
    };
    EXPECT_NEAR(find(0.0), albedo * albedo, 1e-5);
    EXPECT_LT(find(0.9), 0.95 * albedo * albedo);
    EXPECT_GT(find(0.9), 0.5 * albedo * albedo);
}

/// A room whose wall behind the camera is seen in a mirror only.
Scene make_mirror_room() {
    Scene scene;
    add_mesh(scene, make_box({4.0, 2.0, 4.0}, add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true)));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.6, 0.2, 0.0});
    scene.materials.push_back({.gloss = {.metallic = 1.0, .roughness = 0.0}});
    add_mesh(scene, make_quad(1.6, 1.2, 1), {0.0, 0.0, -1.9});
    add_camera(scene, {-0.3, 0.1, 0.6}, {0.0, 0.0, -1.9}, 0.8);
    return scene;
}

TEST(KnownIrradianceTest, AMirrorShowsWhatTheCacheHolds) {
    IndirectStage room(make_mirror_room(), 48, 36, 0.2, 0);
    room.settings.cache.min_radius_pixels = 2.0;  // the picture is small
    const Stage& stage = room.stage;
    auto [cache, tally] = room.fill();
    const std::size_t plain = cache.records().size();
    fill_mirror_places(cache, room.context, room.centers, tally);
    EXPECT_GT(cache.records().size(), plain + 5);
    EXPECT_EQ(tally.counts.records, cache.records().size());
    cache.finish();
    const KnownIrradiance known = make_frame_irradiance(room.context, &cache);
    EXPECT_EQ(known.bounces, 1);
    RayTask task(stage.rays);
    GatherScratch scratch;
    const MirrorPlaces mirrors = cast_mirror_places(room.context, room.centers, tally.counts.rays);
    int seen = 0, found = 0, compared = 0;
    double total = 0.0, difference = 0.0, squares = 0.0;
    for (int i = 0; i < 48 * 36; ++i) {
        const int x = i % 48, y = i / 48;
        if (mirrors.places.hits(x, y).instance == no_index) continue;
        ++seen;
        const PixelSurface place = make_bounce_surface(stage.shading, mirrors.places, x, y);
        EXPECT_GT(place.hit.distance, 2.0f);
        const std::optional<Rgb> light = known.find(place, place.hit, 0.2f, Rgb(1.0f), task);
        if (!light) continue;
        ++found;
        if (i % 7 != 0) continue;
        const IrradianceSample truth =
            gather_irradiance(room.lighting, task, place.point,
                              {choose_strata(1024), {9, 9, 9, static_cast<std::uint32_t>(i)}}, scratch, {30});
        total += luminance(truth.irradiance);
        difference += luminance(*light) - luminance(truth.irradiance);
        squares += std::pow(luminance(*light) - luminance(truth.irradiance), 2.0);
        ++compared;
    }
    EXPECT_GT(seen, 300);
    EXPECT_GE(found, seen * 98 / 100);
    EXPECT_LT(std::abs(difference), 0.02 * total);
    EXPECT_LT(std::sqrt(squares * compared), 0.1 * total);
}

enum class Walls { plain, glossy, textured, mirrors };

Scene make_box_scene(Walls walls) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.75), glm::dvec3(0.0), true);
    const int red = add_lambert(scene, {0.6, 0.1, 0.1}, glm::dvec3(0.0), true);
    add_small_room(scene, white, red, {9.0, 8.0, 6.0}, 0.6);
    add_mesh(scene, make_box({0.6, 0.8, 0.6}, white), {0.3, -0.6, -0.2}, turn_about_y(0.4));
    if (walls == Walls::glossy) {
        scene.materials[0].gloss.specular = 1.0;
        scene.materials[0].gloss.roughness = 0.5;
    }
    if (walls == Walls::mirrors) {  // the red wall is one, and a pane of glass hangs under the lamp
        scene.materials[1] = {};
        scene.materials[1].gloss.roughness = 0.0;
        scene.materials.push_back({.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}});
        add_mesh(scene, make_quad(1.2, 1.2, 3), {0.0, 0.6, 0.0}, z_to_down);
    }
    if (walls == Walls::textured) {
        SceneImage image{.floats = Image<glm::vec4>(8, 8)};
        for (int i = 0; i < 64; ++i) image.floats.pixels[i] = glm::vec4((i + i / 8) % 2 == 0 ? 1.0f : 0.3f);
        scene.images.push_back(image);
        scene.materials[0].textures[TextureSlot::base_color].image = 0;
    }
    add_camera(scene, {0.0, 0.0, 3.4}, {0.0, 0.0, 0.0}, 0.7);
    return scene;
}

class PathGather : public testing::TestWithParam<Walls> {};

TEST_P(PathGather, OneBounceIsThePictureOfTheGather) {
    constexpr int width = 20, height = 15;
    constexpr std::uint32_t seeds = 40;
    const Stage stage(make_box_scene(GetParam()), width, height);
    EXPECT_TRUE(holds([&](Trial& trial) {
        PictureMeans paths, gathers;
        for (std::uint32_t seed = trial.seed; seed < trial.seed + trial.times(seeds); ++seed) {
            RenderSettings settings = path_settings(1, GetParam() == Walls::mirrors ? 16 : 4, seed);
            paths.add(shade(stage, settings).color);
            settings.light.integrator = Integrator::cache;
            settings.cache.accuracy = 0.0;
            settings.cache.gather = 8;
            settings.seed = seed + 1000;
            gathers.add(shade(stage, settings).color);
        }
        trial.near(paths.all, gathers.all);
        EXPECT_LT(paths.all.error(), 0.01 * paths.all.mean());
        int beyond = 0;
        for (std::size_t i = 0; i < paths.pixels.size(); ++i) {
            const Mean &a = paths.pixels[i], &b = gathers.pixels[i];
            if (std::abs(a.mean() - b.mean()) > 3.0 * std::hypot(a.error(), b.error()) + 1e-6) ++beyond;
        }
        // About one of 300 pixels is expected. Under mirrors, rare paths bring much of the light of some pixels, whose
        // spread over few renders says too little.
        trial.at_most(beyond, 0.0, GetParam() == Walls::mirrors ? width * height / 50 : width * height / 100);
    }));
}

/// Means of independent pictures with the cache and of paths.
TEST_P(PathGather, IC23_ThreeBouncesWithTheCacheToo) {
    constexpr int width = 20, height = 15;
    const Stage stage(make_box_scene(GetParam()), width, height);
    const auto mean = [&](RenderSettings settings, std::uint32_t runs) {
        PictureMeans pictures;
        for (std::uint32_t run = 0; run < runs; ++run, ++settings.seed) pictures.add(shade(stage, settings).color);
        return pictures.all;
    };
    EXPECT_TRUE(holds([&](Trial& trial) {
        RenderSettings settings = path_settings(3, 16, trial.seed);
        const Mean paths = mean(settings, trial.times(32u));
        settings.light.integrator = Integrator::cache;
        settings.light.light_samples = 64;
        settings.seed += 1000;
        for (const double accuracy : {0.0, 0.3}) {
            settings.cache.accuracy = accuracy;
            settings.cache.gather = accuracy > 0.0 ? 64 : 4;
            const Mean gathers = mean(settings, trial.times(6u));
            trial.near(gathers, paths, 0.005 * paths.mean());
            EXPECT_LT(std::hypot(paths.error(), gathers.error()),
                      (GetParam() == Walls::mirrors ? 0.03 : 0.006) * paths.mean());
        }
    }));
}

INSTANTIATE_TEST_SUITE_P(Boxes, PathGather,
                         testing::Values(Walls::plain, Walls::glossy, Walls::textured, Walls::mirrors));

}  // namespace
}  // namespace aleph
