// Promises of every model of vision, and models that are not in the list.

#include "perception/vision/vision_model.h"
#include "engine/base/sampling.h"
#include "perception/perception.h"
#include "perception/threshold.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

TEST(VisionList, NamesEachModelOnce) {
    std::set<std::string> names;
    for (const VisionModel* const model : vision_list()) {
        names.insert(model->name());
        EXPECT_FALSE(model->summary().empty()) << model->name();
        EXPECT_EQ(find_vision(model->name()), model);
    }
    EXPECT_EQ(names, (std::set<std::string>{"thesis", "laird", "castle"}));
    EXPECT_EQ(find_vision("ones"), nullptr);
    EXPECT_EQ(find_vision(""), nullptr);
    EXPECT_EQ(PerceptionSettings().vision, find_vision("thesis"));
}

TEST(VisionModel, RowsAreThoseOfTheirPixels) {
    constexpr int width = 400;
    std::vector<float> retinal(width), tracked(width), luminance(width), f(width);
    RandomStream random({3, 0, 0, 0});
    for (int x = 0; x < width; ++x) {
        retinal[x] = static_cast<float>(0.15 * std::pow(10.0, 3.5 * random.next()));
        tracked[x] = 80.0f * random.next();
        luminance[x] = static_cast<float>(std::pow(10.0, 6.0 * random.next() - 2.0));
    }
    const Presentation shown{.viewing = {.pixels_per_degree = 40.0, .persistence = 0.7}, .frame_rate = {24, 1}};
    const auto rho = band_frequencies(Bands::printed, shown.viewing.pixels_per_degree);
    for (const VisionModel* const model : vision_list()) {
        const ElevationRowMaker make_row = model->make_rows(rho, shown);
        const auto row = make_row(width), single = make_row(1);
        row->load({retinal.data(), tracked.data(), model->uses_luminance() ? luminance.data() : nullptr});
        for (int band = 0; band < band_count; ++band) {
            row->elevations(band, f.data());
            for (int x = 0; x < width; ++x) {
                float alone = 0.0f;
                single->load({&retinal[x], &tracked[x], model->uses_luminance() ? &luminance[x] : nullptr});
                single->elevations(band, &alone);
                ASSERT_EQ(f[x], alone) << model->name() << ", band " << band;
                ASSERT_GE(f[x], 1.0f) << model->name();
                ASSERT_LE(f[x], highest_aleph) << model->name();
            }
        }
        model->thresholds(luminance.data(), luminance.size(), f.data());
        for (int x = 0; x < width; ++x) {
            float alone = 0.0f;
            model->thresholds(&luminance[x], 1, &alone);
            ASSERT_EQ(f[x], alone) << model->name() << " " << luminance[x];
            ASSERT_GT(f[x], 0.0f) << model->name() << " " << luminance[x];
        }
    }
}

TEST(VisionModel, SaysWhatItDependsOn) {
    const Stimulus bright{.frequency = 8.0, .retinal = 1.0, .tracked = 20.0, .luminance = 100.0};
    Stimulus dim = bright;
    dim.luminance = 1.0;
    const Presentation held, flashed{.viewing = {.persistence = 0.1}, .frame_rate = {}};
    for (const VisionModel* const model : vision_list()) {
        const double f = row_elevation(*model, bright, held);
        EXPECT_EQ(model->uses_luminance(), row_elevation(*model, dim, held) != f) << model->name();
        EXPECT_EQ(model->uses_persistence(), row_elevation(*model, bright, flashed) != f) << model->name();
    }
}

TEST(OwnVision, ElevationOneGivesAnAlephMapOfOnes) {
    const OnesVision ones;
    const SyntheticFrame frame = make_synthetic_frame(97, 71);
    for (const Guide guide : {Guide::none, Guide::spatial, Guide::full, Guide::saliency}) {
        const PerceptionMaps maps =
            compute_perception(frame.estimate, frame.velocity, {}, {}, {.guide = guide, .vision = &ones});
        EXPECT_EQ(maps.aleph, Image<float>(97, 71, 1.0f));
        EXPECT_TRUE(maps.adaptation.empty());
        EXPECT_EQ(maps.clamped, 0u);
    }
    const Image<float> adaptation = compute_adaptation_luminance(frame.estimate, {});
    const Image<float> threshold = compute_threshold(Image<float>(97, 71, 1.0f), adaptation, ones);
    for (std::size_t i = 0; i < threshold.size(); ++i) {
        ASSERT_FLOAT_EQ(threshold.pixels[i], static_cast<float>(tvi(adaptation.pixels[i])));
    }
}

/// Elevations that grow with luminance and motion.
class BrightVision final : public PlainVision {
  public:
    std::string name() const override { return "bright"; }
    std::string summary() const override { return "a test's model"; }
    bool uses_luminance() const override { return true; }
    double elevation(const Stimulus& seen, const Presentation& shown) const override {
        return 1.0 + 0.01 * seen.luminance + seen.retinal + seen.tracked / shown.frame_rate.per_second();
    }
    double threshold(double luminance) const override { return 0.01 * luminance; }
};

TEST(OwnVision, ReceivesLuminanceAndMotion) {
    const BrightVision bright;
    const Image<Rgb> flat(40, 30, Rgb(0.5f));
    const PerceptionMaps maps =
        compute_perception(flat, Image<float>(40, 30, 10.0f), {}, {24, 1}, {.guide = Guide::full, .vision = &bright});
    const double expected = 1.0 + 0.5 + written_retinal_velocity(10.0, 0.82) + 8.2 / 24.0;
    for (const float aleph : maps.aleph.pixels) ASSERT_NEAR(aleph, expected, 1e-4);
    EXPECT_NEAR(compute_threshold(maps.aleph, maps.adaptation, bright)(20, 15), expected * 0.5, 1e-4);
}

TEST(OwnVision, ThereHasToBeAModel) {
    EXPECT_THROW(compute_perception(Image<Rgb>(8, 8), Image<float>(8, 8), {}, {}, {.vision = nullptr}), InputError);
}

}  // namespace
}  // namespace aleph
