// Effect of the irradiance cache's accuracy: at 0 and near it the light of the path tracer, and less error at
// every step on the way there.
// The work of a look-up in indices of very different sizes.

#include "engine/load/load_scene.h"
#include "render/cache/record_index.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int small_width = 16, small_height = 12;
PictureMeans render_runs(const Stage& stage, RenderSettings settings, std::uint32_t runs) {
    PictureMeans means;
    for (std::uint32_t run = 0; run < runs; ++run) {
        ++settings.seed;
        means.add(shade(stage, settings).color);
    }
    return means;
}

/// A red block in a white room.
/// @param fov  of a camera that looks at the block's foot, radians
Scene make_block_room(double fov) {
    Scene scene = make_lamp_room({-0.8, 1.0, 0.5});
    add_mesh(scene, make_box({0.8, 0.8, 0.8}, add_lambert(scene, {0.7, 0.1, 0.1})), {0.5, -1.1, -0.5},
             turn_about_y(0.4));
    add_camera(scene, {0.0, 0.0, 1.8}, {0.2, -1.4, -0.1}, fov);
    return scene;
}

// The other settings are the defaults: with a smallest radius of a few pixels, a cache would interpolate at any
// accuracy. Light from one point: only indirect light is random.
TEST(IrradianceCache, IC12_TowardsAccuracyZeroItIsMonteCarlo) {
    const Stage stage(make_block_room(0.1), small_width, small_height);
    EXPECT_TRUE(holds([&](Trial& trial) {
        const PictureMeans traced = render_runs(stage, path_settings(1, 1, trial.seed), trial.times(800u));
        for (const double accuracy : {0.0, 1e-30, 1e-3}) {
            RenderSettings settings = plain_settings(accuracy, 128);
            settings.seed = 10'000 + trial.seed;
            settings.light.light_samples = 1;
            const PictureMeans cached = render_runs(stage, settings, trial.times(12u));
            trial.near(traced.all, cached.all);
            constexpr int pixels = small_width * small_height;
            double squares = 0.0;
            for (int i = 0; i < pixels; ++i) {
                const Mean &a = traced.pixels[i], &b = cached.pixels[i];
                squares += std::pow((a.mean() - b.mean()) / std::hypot(a.error(), b.error()), 2.0);
            }
            trial.at_most(squares, std::sqrt(2.0 * pixels), pixels);
            EXPECT_LT(std::hypot(traced.all.error(), cached.all.error()), 0.005 * traced.all.mean());
        }
    }));
}

/// Mean squared errors of the indirect light.
struct LightErrors {
    double all = 0.0;  ///< over the squared mean of the light
    /// Relative, e = 1 % of the mean. The worst 1 % are left out: a few pixels in the creases of the blocks are nearly
    /// black.
    double most = 0.0;
};

LightErrors find_light_errors(const Image<Rgb>& light, const std::vector<std::pair<glm::ivec2, double>>& truth) {
    const auto count = static_cast<double>(truth.size());
    double mean = 0.0;
    for (const auto& [pixel, value] : truth) mean += value / count;
    LightErrors found;
    std::vector<double> errors;
    for (const auto& [pixel, value] : truth) {
        const double square = std::pow(luminance(light(pixel.x, pixel.y)) - value, 2.0);
        found.all += square / (mean * mean * count);
        errors.push_back(square / (value * value + 1e-4 * mean * mean));
    }
    std::ranges::sort(errors);
    errors.resize(errors.size() * 99 / 100);
    for (const double error : errors) found.most += error / static_cast<double>(errors.size());
    return found;
}

/// Half of the pixels: those of odd rows and columns, and those of even ones, where records are placed first. Where
/// their reach is a pixel or two, odd ones alone are as far from them at an accuracy of .15 as at .2.
std::vector<std::pair<glm::ivec2, double>> gather_truth(const Stage& stage) {
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::vector<std::pair<glm::ivec2, double>> truth;
    for (int y = 0; y < stage.view.height; ++y) {
        for (int x = y % 2; x < stage.view.width; x += 2) {
            if (centers.hits(x, y).instance == no_index) continue;
            const PixelSurface surface = make_pixel_surface(stage.shading, stage.view, centers, x, y);
            if (!surface.material.has_diffuse()) continue;
            const double value = luminance(gather_indirect(stage, surface, 4096));
            if (value > 0.0) truth.push_back({{x, y}, value});  // 0 in the very crease of two walls
        }
    }
    return truth;
}

/// Surfaces keep their colours and textures, and lose their gloss.
Scene load_without_gloss(const std::string& name) {
    Scene scene = load_scene(source_folder() / "scenes" / name / "scene.json");
    for (Material& material : scene.materials)
        material.gloss.metallic = material.gloss.specular = material.layers.clearcoat = material.glass.transmission =
            0.0;
    return scene;
}

/// The error of most pixels falls at every step with each seed. That of all, of which a few pixels between small things
/// have much and which depends on where records happen to lie, rises at none by more than its own error tells.
void expect_steps(const std::string& name, double seconds) {
    SCOPED_TRACE(name);
    const Stage stage(load_without_gloss(name), 48, 36, seconds);
    const auto truth = gather_truth(stage);
    ASSERT_GT(truth.size(), 300u);
    auto odd = truth;
    std::erase_if(odd, [](const auto& entry) { return entry.first.y % 2 == 0; });
    constexpr int seeds = 3;
    std::optional<Mean> all_before;
    std::array<double, seeds> most_before;
    most_before.fill(infinity);
    for (const double accuracy : {0.5, 0.3, 0.2, 0.15, 0.1, 0.05}) {
        Mean all, most_of_odd;
        for (std::uint32_t seed = 0; seed < seeds; ++seed) {
            RenderSettings settings = plain_settings(accuracy, 0);
            settings.seed = seed;
            const IndirectPicture picture = shade_indirect(stage, settings);
            const LightErrors errors = find_light_errors(picture.indirect, truth);
            all.add(errors.all);
            most_of_odd.add(find_light_errors(picture.indirect, odd).most);
            EXPECT_LT(errors.most, most_before[seed]) << "at accuracy " << accuracy << ", seed " << seed;
            most_before[seed] = errors.most;
        }
        if (all_before) {
            EXPECT_LT(all.mean(), all_before->mean() + 2.0 * std::hypot(all.error(), all_before->error()))
                << "at accuracy " << accuracy;
        }
        if (accuracy == 0.05) {
            EXPECT_LT(most_of_odd.mean(), 5e-4);
        }
        all_before = all;
    }
}

TEST(IrradianceCache, IC21_EveryStepOfAccuracyLowersTheError) {
    expect_steps("cornell", 0.0);
    expect_steps("pool", 12.0 / 30.0);
}

TEST(IrradianceCache, IC12_AccuracyOneRendersWithFewRecordsAndABoundedError) {
    const Stage stage(make_block_room(1.0), 64, 48);
    const ShadedFrame coarse = shade(stage, plain_settings(1.0, 64)), fine = shade(stage, plain_settings(0.1, 64));
    EXPECT_GT(coarse.counts.records, 5u);
    EXPECT_LT(2 * coarse.counts.records, fine.counts.records);
    EXPECT_EQ(coarse.counts.invalid_samples, 0u);
    const double error = std::sqrt(
        find_light_errors(shade_indirect(stage, plain_settings(1.0, 1024)).indirect, gather_truth(stage)).most);
    EXPECT_LT(error, 0.1);
}

/// Records on a square of 1 m, each reaching a few of its neighbours, and ten that reach far.
RecordIndex make_square(int side) {
    RecordIndex index(glm::vec3(0.0f), glm::vec3(1.0f));
    const float spacing = 1.0f / static_cast<float>(side);
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 place(static_cast<float>(i % side) + 0.5f, static_cast<float>(i / side) + 0.5f);
        const bool far = i % (side * side / 10) == 0;
        index.add(spacing * glm::vec3(place.x, 0.0f, place.y), {far ? 0.25f : 2.0f * spacing}, 0.75f);
    }
    return index;
}

/// Cells asked and records visited by a look-up at a random place.
double work_of_look_up(const RecordIndex& index) {
    constexpr int look_ups = 2000;
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::size_t work = 0, found = 0;
    for (int i = 0; i < look_ups; ++i) {
        const glm::vec3 place(unit(engine), 0.0f, unit(engine));
        index.visit(
            [&](const RecordIndex::Cell& cell) {
                ++work;
                return cell.distance_to(place) <= cell.most.at(0.75f);
            },
            [&](int) {
                ++work;
                return true;
            });
        index.visit_near(place, 0.75f, 0.0f, [&](int) {
            ++found;
            return true;
        });
    }
    EXPECT_GT(found, 2u * look_ups);
    return static_cast<double>(work) / look_ups;
}

// A walk over all records would give 1000.
TEST(IrradianceCache, IC15_AThousandTimesTheRecordsAreLessThanTenTimesTheWork) {
    const double thousand = work_of_look_up(make_square(32)), million = work_of_look_up(make_square(1000));
    EXPECT_LT(million, 10.0 * thousand) << thousand << " and " << million;
}

}  // namespace
}  // namespace aleph
