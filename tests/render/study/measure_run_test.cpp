// Errors of pictures whose differences are known, and references as means of passes. The ledger of effects.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "render/compare/visible_difference.h"
#include "render/study/effects_ledger.h"
#include "render/study/measure_run.h"
#include "render/study/reference_picture.h"
#include "render/study/study.h"
#include "tests/support/grey_image.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double white = 100.0;  // cd/m2

ChannelImage grey(float value, bool with_indirect = false) {
    ChannelImage image = grey_image(10, 10, value);
    if (with_indirect) {
        for (const char* name : {"indirect.R", "indirect.G", "indirect.B"})
            image.channels.push_back({name, Image<float>(10, 10, 0.5f * value)});
    }
    image.metadata["exposureFactor"] = 1.0;
    image.metadata["whiteLuminance"] = white;
    return image;
}

std::vector<Metric> all_metrics(int viewers) {
    Study study;
    for (int i = 0; i < viewers; ++i) study.viewers.push_back({i == 0 ? "one" : "two", {}});
    return list_metrics(study);
}

const std::vector<Image<float>> thresholds = {Image<float>(10, 10, 2.0f), Image<float>(10, 10, 0.5f)};

ChannelImage truth_of(ChannelImage reference, double variance) {
    reference.channels.push_back({"variance.Y", Image<float>(10, 10, static_cast<float>(variance))});
    return reference;
}

MetricValues measure_errors(const ChannelImage& picture, const ChannelImage& truth,
                            const std::vector<Metric>& metrics) {
    return measure_errors(picture, truth, thresholds, metrics);
}

TEST(MeasureErrors, KnownDifferences) {
    ChannelImage picture = grey(0.5f);
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < 7; ++i) picture.channels[c].values.pixels[i] += 0.03f;  // 3 cd/m2
        for (std::size_t i = 7; i < 20; ++i) picture.channels[c].values.pixels[i] -= 0.01f;
    }
    const MetricValues values = measure_errors(picture, truth_of(grey(0.5f), 0.0), all_metrics(2));
    EXPECT_DOUBLE_EQ(values.at("share_beyond"), 7.0);
    EXPECT_DOUBLE_EQ(values.at("share_beyond.two"), 20.0);
    EXPECT_NEAR(values.at("mean_error"), (7 * 3.0 + 13 * 1.0) / 2.0 / 100.0, 1e-6);
    EXPECT_NEAR(values.at("p99_error"), 1.5, 0.01);
    EXPECT_NEAR(values.at("p99_error.two"), 6.0, 0.05);
    EXPECT_NEAR(values.at("bias"), 100.0 * (7 * 0.03 - 13 * 0.01) / 50.0, 1e-4);
    EXPECT_NEAR(values.at("relative_mse"), (7 * 9e-4 + 13 * 1e-4) / 100.0 / 0.25, 1e-5);
    EXPECT_FALSE(values.contains("relative_mse_indirect")) << "neither picture has its indirect light alone";
    const MetricValues alone = measure_errors(picture, truth_of(grey(0.5f), 0.0), {{"mean_error", "", "", false, 0}});
    EXPECT_EQ(alone, (MetricValues{{"mean_error", values.at("mean_error")}}));
}

TEST(MeasureErrors, NoiseOfTheReferenceIsTakenOff) {
    const double variance = 1e-4;  // standard error 1 cd/m2: half of a threshold
    const ChannelImage truth = truth_of(grey(0.5f), variance);
    const MetricValues values = measure_errors(grey(0.5f), truth, all_metrics(1));
    EXPECT_LT(values.at("relative_mse"), 0.0) << "less than the noise would make";
    const ReferenceQuality quality = measure_reference(truth, thresholds.front());
    EXPECT_NEAR(quality.percentile_99, 0.5, 0.01);
    EXPECT_NEAR(quality.share_by_noise, 4.55, 0.01) << "beyond 2 standard deviations";
}

TEST(MeasureErrors, ExposureAndIndirectLight) {
    ChannelImage picture = grey(1.0f, true);
    picture.metadata["exposureFactor"] = 2.0;
    const MetricValues values = measure_errors(picture, truth_of(grey(0.5f, true), 0.0), all_metrics(1));
    EXPECT_EQ(values.at("share_beyond"), 0.0) << "the same light, exposed twice as long";
    EXPECT_EQ(values.at("relative_mse_indirect"), 0.0);
    for (std::size_t c = 3; c < 6; ++c) picture.channels[c].values.pixels[0] = 0.6f;
    const MetricValues changed = measure_errors(picture, truth_of(grey(0.5f, true), 0.0), all_metrics(1));
    EXPECT_NEAR(changed.at("relative_mse_indirect"), 0.01 / 0.25 / 100.0, 1e-6);
}

ChannelImage grey_picture(const std::vector<float>& values) {
    ChannelImage picture;
    Image<float> grey(static_cast<int>(values.size()), 1);
    grey.pixels = values;
    for (const char* name : {"R", "G", "B"}) picture.channels.push_back({name, grey});
    picture.metadata["exposureFactor"] = 1.0;
    return picture;
}

TEST(ReferencePicture, IsTheMeanOfItsPassesWithItsVariance) {
    ChannelImage mean;
    add_pass(mean, grey_picture({1.0f, 5.0f}));
    EXPECT_TRUE(std::isinf(mean.find("variance.Y")->pixels[0]));
    for (const float value : {4.0f, 1.0f, 2.0f}) add_pass(mean, grey_picture({value, 5.0f}));
    EXPECT_EQ(reference_passes(mean), 4.0);
    EXPECT_NEAR(mean.find("G")->pixels[0], 2.0, 1e-6);
    EXPECT_NEAR(mean.find("variance.Y")->pixels[0], 6.0 / 3.0 / 4.0, 1e-6);
    EXPECT_NEAR(mean.find("variance.Y")->pixels[1], 0.0, 1e-12);
    EXPECT_NEAR(mean.find("noise.B")->pixels[0], (1.0 - 4.0 + 1.0 - 2.0) / 4.0, 1e-6);
    EXPECT_NEAR(mean.find("noise.B")->pixels[1], 0.0, 1e-6);
}

TEST(ReferencePicture, NoiseOfAnyNumberOfPassesIsLikeThatOfTheMean) {
    constexpr std::size_t pixels = 10000;
    std::mt19937 generator(4);
    std::normal_distribution<float> normal(10.0f, 1.0f);
    ChannelImage mean;
    for (int count = 1; count <= 5; ++count) {
        std::vector<float> pass(pixels);
        std::ranges::generate(pass, [&] { return normal(generator); });
        add_pass(mean, grey_picture(pass));
        const Image<Rgb> noise = read_noise(mean);
        if (count == 1) {
            EXPECT_TRUE(noise.empty()) << "one pass does not tell";
            continue;
        }
        ASSERT_EQ(noise.size(), pixels) << count;
        double squares = 0.0, products = 0.0;
        for (std::size_t i = 0; i < pixels; ++i) {
            squares += std::pow(noise.pixels[i].y, 2.0) / pixels;
            products += noise.pixels[i].y * (mean.find("G")->pixels[i] - 10.0) / pixels;
        }
        EXPECT_NEAR(squares * count, 1.0, 5.0 * std::sqrt(2.0 / pixels)) << count;
        EXPECT_NEAR(products * count, 0.0, 5.0 * std::sqrt(1.0 / pixels)) << count << ": it is no part of the mean";
    }
}

TEST(ReferencePicture, FollowsTheExposure) {
    ChannelImage mean;
    for (const float value : {1.0f, 3.0f}) add_pass(mean, grey_picture({value}));
    ChannelImage other;
    other.metadata["exposureFactor"] = 2.0;
    const ChannelImage brighter = with_exposure_of(mean, other);
    EXPECT_NEAR(brighter.find("R")->pixels[0], 4.0, 1e-6);
    EXPECT_NEAR(brighter.find("variance.Y")->pixels[0], 4.0 * mean.find("variance.Y")->pixels[0], 1e-6);
}

TEST(VisibleMetrics, AnIdealAllocationGivesEachPixelWhatItsErrorAsksFor) {
    Image<float> seen(20, 10, 0.5f), samples(20, 10, 16.0f);  // 4 samples are enough
    EXPECT_DOUBLE_EQ(find_ideal_samples(seen, samples), 4.0);
    for (int i = 0; i < 20; ++i) {
        seen.pixels[static_cast<std::size_t>(10 * i)] = 2.0f;        // 64
        seen.pixels[static_cast<std::size_t>(10 * i + 1)] = 0.125f;  // less than one, so one
    }
    EXPECT_DOUBLE_EQ(find_ideal_samples(seen, samples), (160 * 4.0 + 18 * 64.0 + 20 * 1.0) / 198);  // two are left out
    seen.pixels[0] = seen.pixels[10] = 1e9f;
    EXPECT_DOUBLE_EQ(find_ideal_samples(seen, samples), (160 * 4.0 + 18 * 64.0 + 20 * 1.0) / 198);
    // However they were shared out: an error of half the size after four times the samples asks for as many.
    for (std::size_t i = 0; i < 100; ++i) {
        seen.pixels[i] *= 0.5f;
        samples.pixels[i] *= 4.0f;
    }
    EXPECT_DOUBLE_EQ(find_ideal_samples(seen, samples), (160 * 4.0 + 18 * 64.0 + 20 * 1.0) / 198);
}

Study ledger_study(const char* more = "") {
    const std::string scene = (source_folder() / "scenes/cornell/scene.json").string();
    return parse_study(fmt::format(R"({{"scenes": [{{"scene": "{}", "frames": "3"}}], "size": "20x15", "effects": true,
        "settings": {{"light_step": 0, "error": 2{}}}, "reference": {{"passes": 2, "spp": 1024}}}})",
                                   scene, more),
                       "ledger.json");
}

TEST(EffectsLedger, LeavesOutWhatIsForcedToo) {
    const PreparedStudy prepared = prepare_study(ledger_study(R"(, "force": "emission,direct_light")"));
    const auto without = std::ranges::find(prepared.variants, "without emission", &StudyVariant::name);
    ASSERT_NE(without, prepared.variants.end());
    EXPECT_EQ(without->settings.at("forbid"), SettingValue(std::string("emission")));
    EXPECT_EQ(without->settings.at("force"), SettingValue(std::string("direct_light")));
    const auto other = std::ranges::find(prepared.variants, "without area_shadows", &StudyVariant::name);
    ASSERT_NE(other, prepared.variants.end());
    EXPECT_FALSE(other->settings.contains("force")) << "the study's own stays";
}

const LedgerEntry& entry_of(const SceneLedger& ledger, Effect effect) {
    return ledger.entries.at(static_cast<std::size_t>(effect));
}

TEST(EffectsLedger, TellsWhatEachEffectThatASceneCallsForBrings) {
    const ScratchFolder folder;
    const PreparedStudy prepared = prepare_study(ledger_study());
    std::vector<std::string> names;
    for (const StudyVariant& variant : prepared.variants) names.push_back(variant.name);
    EXPECT_EQ(names.front(), "all effects");
    EXPECT_THAT(names, testing::IsSupersetOf({"without direct_light", "without area_shadows", "without emission",
                                              "without indirect_diffuse"}));
    EXPECT_THAT(names, testing::Not(testing::Contains("without textures"))) << "the scene has none";

    const StudyResults results = run_study(prepared, folder.path());
    const std::vector<SceneLedger> ledgers = make_ledger(prepared, results);
    ASSERT_EQ(ledgers.size(), 1u);
    const SceneLedger& ledger = ledgers.front();
    EXPECT_EQ(ledger.scene, "cornell");
    ASSERT_EQ(ledger.entries.size(), effect_count);
    EXPECT_EQ(ledger.seen.value, results.variants.front().metrics.at("share_seen").value);
    for (const EffectName& effect : effect_list) {
        const LedgerEntry& entry = entry_of(ledger, effect.id);
        EXPECT_EQ(entry.effect, effect.name);
        EXPECT_EQ(entry.seen.has_value(), entry.decision != "skip") << effect.name;
        EXPECT_EQ(entry.seconds.has_value(), entry.decision != "skip") << effect.name;
    }
    const LedgerEntry& indirect = entry_of(ledger, Effect::indirect_diffuse);
    EXPECT_EQ(indirect.decision, "simulate");
    EXPECT_EQ(indirect.bound, 0.0) << "nothing is left out";
    EXPECT_GT(indirect.seen->value, ledger.seen.value + 20.0);
    EXPECT_GT(entry_of(ledger, Effect::emission).seen->value, ledger.seen.value + 20.0) << "nothing else shines";
    EXPECT_EQ(entry_of(ledger, Effect::textures).decision, "skip");

    const nlohmann::ordered_json json = to_json(ledgers);
    const nlohmann::ordered_json& of_indirect = json[0]["effects"][static_cast<std::size_t>(Effect::indirect_diffuse)];
    EXPECT_EQ(of_indirect["seen"]["value"], indirect.seen->value);
    EXPECT_EQ(of_indirect["seconds"]["value"], indirect.seconds->value);
    EXPECT_TRUE(json[0]["effects"][static_cast<std::size_t>(Effect::textures)]["seen"].is_null());
}

TEST(EffectsLedger, WhatASceneForbidsIsNotMissedInAnother) {
    const ScratchFolder folder;
    std::ifstream file(source_folder() / "scenes/cornell/scene.json");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    text.insert(text.find("\"aleph\": 1"), R"("settings": {"forbid": "indirect_diffuse"}, )");
    std::ofstream(folder / "dark.json") << text;
    const Study alone = ledger_study();
    Study both = alone;
    both.scenes.push_back({folder / "dark.json", "3"});
    const auto ledgers_of = [&](const Study& study) {
        const PreparedStudy prepared = prepare_study(study);
        return make_ledger(prepared, run_study(prepared, folder.path()));
    };
    const std::vector<SceneLedger> ledgers = ledgers_of(both);
    const SceneLedger expected = ledgers_of(alone).front();  // of runs that are finished
    for (const Effect effect : {Effect::indirect_diffuse, Effect::area_shadows, Effect::motion}) {
        ASSERT_TRUE(entry_of(ledgers[0], effect).seen.has_value()) << describe(effect).name;
        EXPECT_EQ(entry_of(ledgers[0], effect).seen->value, entry_of(expected, effect).seen->value)
            << describe(effect).name;
    }
    EXPECT_FALSE(entry_of(ledgers[1], Effect::indirect_diffuse).seen.has_value()) << "it is forbidden there";
    EXPECT_EQ(entry_of(ledgers[1], Effect::motion).seen->value, ledgers[1].seen.value)
        << "still without indirect light";
}

TEST(EffectsLedger, KeepsWhatTheStudyForbids) {
    const PreparedStudy prepared = prepare_study(ledger_study(R"(, "forbid": "motion,area_shadows")"));
    const auto without = [&](const char* effect) {
        return std::ranges::find(prepared.variants, std::string("without ") + effect, &StudyVariant::name);
    };
    EXPECT_EQ(without("area_shadows"), prepared.variants.end());
    ASSERT_NE(without("direct_light"), prepared.variants.end());
    EXPECT_EQ(without("direct_light")->settings.at("forbid"), SettingValue("direct_light,area_shadows,motion"));
}

}  // namespace
}  // namespace aleph
