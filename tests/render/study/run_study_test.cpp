// Studies of a small picture: what is run, what is kept, and that a stopped study ends with the same numbers.

#include "render/study/run_study.h"

#include <gmock/gmock.h>

#include "render/study/reference_picture.h"
#include "render/study/study.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

class RunStudy : public testing::Test {
  protected:
    RunStudy() {
        study.title = "small";
        study.scenes = {{source_folder() / "scenes/cornell/scene.json", "3"}};
        study.settings = {{"size", "20x15"}, {"light_step", 0.0}, {"filter", "box"}};
        study.reference = {"path", 2, 256, {}};
        study.sweep = {{"spp", {1.0, 4.0}}, {"guide", {std::string("none"), std::string("saliency")}}};
        study.viewers = {{"own", {}}, {"castle", {{"vision", "castle"}, {"viewing.persistence", 1.0}}}};
    }
    StudyResults run(const StudyProgress& progress = {}) const {
        return run_study(prepare_study(study), folder.path(), progress);
    }

    const ScratchFolder folder;
    Study study;
};

std::vector<std::map<std::string, double>> numbers_of(const StudyResults& results) {
    std::vector<std::map<std::string, double>> numbers;
    for (const VariantResult& variant : results.variants) {
        for (const FrameResult& frame : variant.frames) {
            auto& row = numbers.emplace_back();
            for (const auto& [name, value] : frame.metrics) {
                if (name.find("seconds") == std::string::npos) row[name] = value.value;
            }
            for (const auto& [name, value] : frame.rays) row["rays " + name] = value;
        }
    }
    return numbers;
}

/// Frame 0 has the same picture, but it is not one of the study.
TEST_F(RunStudy, TheFirstFrameOfAStaticSpanHasItsWork) {
    study.scenes = {{source_folder() / "scenes/room/scene.json", "1,2"}};
    study.sweep = {{"spp", {1.0}}};
    const StudyResults results = run();
    const VariantResult& variant = results.variants.at(0);
    ASSERT_EQ(variant.frames.size(), 2u);
    EXPECT_GT(variant.frames[0].metrics.at("rays").value, 0.0);
    EXPECT_EQ(variant.frames[1].metrics.at("rays").value, 0.0) << "a copy";
}

TEST_F(RunStudy, MeasuresEveryVariantAndKeepsIt) {
    const StudyResults first = run();
    ASSERT_EQ(first.variants.size(), 4u);
    EXPECT_EQ(first.made, 4u);
    EXPECT_EQ(first.found, 0u);
    EXPECT_EQ(first.variants[1].name, "spp=1,guide=saliency");
    for (const VariantResult& variant : first.variants) {
        EXPECT_GT(variant.metrics.at("processor_seconds").value, 0.0);
        EXPECT_GT(variant.metrics.at("rays").value, 0.0);
        EXPECT_GT(variant.metrics.at("mean_error.castle").value, variant.metrics.at("mean_error").value)
            << "castleCSF is stricter in this picture";
    }
    EXPECT_EQ(first.variants[0].metrics.at("samples").value, 1.0);
    EXPECT_EQ(first.variants[2].metrics.at("samples").value, 4.0);
    EXPECT_GT(first.variants[0].metrics.at("mean_error").value, first.variants[2].metrics.at("mean_error").value)
        << "one sample is noisier than four";
    ASSERT_EQ(first.frames.size(), 1u);
    EXPECT_TRUE(fs::exists(first.frames[0].reference));
    double sum = 0.0;
    const Image<float>& aleph = *first.frames[0].maps.find("aleph.Y");
    for (int i = 0; i < band_count; ++i) {
        sum += first.frames[0].maps.find("band." + std::to_string(i))->pixels[7] *
               first.frames[0].maps.find("elevation." + std::to_string(i))->pixels[7];
    }
    EXPECT_NEAR(sum, aleph.pixels[7], 1e-4 * aleph.pixels[7]) << "(5.11)";

    const StudyResults again = run();
    EXPECT_EQ(again.made, 0u);
    EXPECT_EQ(again.found, 4u);
    EXPECT_EQ(numbers_of(again), numbers_of(first));
    EXPECT_EQ(again.variants[2].metrics.at("processor_seconds").value,
              first.variants[2].metrics.at("processor_seconds").value)
        << "times are those of the finished run";
}

TEST_F(RunStudy, PicturesOfAnotherProgramAreJudgedAlikeWithoutCosts) {
    study.sweep = {{"spp", {4.0}}};
    study.viewers = {{"own", {}}};
    const StudyResults rendered = run();
    fs::copy(rendered.variants[0].frames[0].picture, folder.path() / "other.0003.exr");
    const std::string text = R"({"scenes": [{"scene": "SCENE", "frames": "3"}], "size": "20x15", "sweep": {"spp": [4]},
        "settings": {"light_step": 0, "filter": "box"}, "reference": {"passes": 2, "spp": 256}, "seeds": [0, 5],
        "variants": [{"name": "other", "pictures": "other.####.exr"}]})";
    const std::string scene = (source_folder() / "scenes/cornell/scene.json").string();
    const auto parse = [&](std::string own) {
        return parse_study(own.replace(own.find("SCENE"), 5, scene), folder.path() / "study.json");
    };
    const StudyResults results = run_study(prepare_study(parse(text)), folder.path() / "judged");
    ASSERT_EQ(results.variants.size(), 2u);
    const VariantResult& other = results.variants[1];
    EXPECT_EQ(other.metrics.at("share_beyond").value, rendered.variants[0].metrics.at("share_beyond").value);
    EXPECT_EQ(other.metrics.at("mean_error").value, rendered.variants[0].metrics.at("mean_error").value);
    for (const char* cost : {"processor_seconds", "rays", "samples", "seed_seen"}) {
        EXPECT_FALSE(other.metrics.contains(cost)) << cost;
        EXPECT_TRUE(results.variants[0].metrics.contains(cost)) << cost;
    }
    EXPECT_FALSE(other.on_front);
    EXPECT_TRUE(results.variants[0].on_front);

    const auto refused = [&](const char* from, const char* to) {
        std::string changed = text;
        changed.replace(changed.find(from), std::string(from).size(), to);
        EXPECT_THROW(prepare_study(parse(changed)), InputError) << to;
    };
    refused("\"frames\": \"3\"", "\"frames\": \"3,4\"");
    refused("20x15", "20x16");
    refused("other.####.exr", "another.####.exr");
    refused("\"pictures\"", "\"settings\": {}, \"picture\"");
    refused("\"name\": \"other\",", "\"name\": \"other\", \"settings\": {\"spp\": 1},");
}

TEST_F(RunStudy, NoiseErrsByTheThreshold) {
    study.sweep = {{"noise", {0.0, 0.5, 2.0}}};
    study.variants = {{"fair", {{"zero_mean_noise", 1.0}}}};
    const StudyResults results = run();
    const auto metric = [&](std::size_t variant, const char* name) {
        return results.variants.at(variant).metrics.at(name).value;
    };
    EXPECT_EQ(metric(0, "mean_error"), 0.0);
    EXPECT_EQ(metric(0, "share_seen"), 0.0);
    // The mean of 300 uniform numbers is off by .58 / sqrt(300) = .033 times their range.
    EXPECT_NEAR(metric(1, "mean_error"), 0.25, 0.5 * 0.07);
    EXPECT_NEAR(metric(2, "mean_error"), 1.0, 2.0 * 0.07);
    EXPECT_EQ(metric(1, "share_beyond"), 0.0);
    EXPECT_NEAR(metric(2, "share_beyond"), 50.0, 9.0);
    EXPECT_NEAR(metric(3, "mean_error"), 0.5, 0.07);
    EXPECT_LT(std::abs(metric(3, "bias")), 0.3 * metric(2, "bias"));
    EXPECT_FALSE(results.variants[1].metrics.contains("processor_seconds"));
    EXPECT_EQ(results.made, 0u);
    EXPECT_EQ(numbers_of(run()), numbers_of(results));

    const auto refuse = [&](const SettingMap& settings) {
        study.variants = {{"wrong", settings}};
        expect_refusal(find_refusal([&] { prepare_study(study); }), "", "wrong", "");
    };
    refuse({{"noise", 1.0}, {"spp", 4.0}});
    refuse({{"noise", 1.0}, {"zero_mean_noise", 1.0}});
    refuse({{"noise", -1.0}});
    refuse({{"zero_mean_noise", not_a_number}});
    refuse({{"noise", true}});
    study.settings["noise"] = 1.0;
    EXPECT_THROW(prepare_study(study), InputError) << "of all variants and the reference";
}

TEST(ThresholdNoise, IsTheSameForASeedAndAnotherInEveryFrame) {
    ChannelImage reference;
    for (const char* name : {"R", "G", "B", "variance.Y"})
        reference.channels.push_back({name, Image<float>(32, 32, 0.5f)});
    reference.metadata["whiteLuminance"] = 200.0;
    const Image<float> threshold(32, 32, 4.0f);
    const auto red = [&](const ThresholdNoise& noise, std::uint32_t seed, std::int64_t frame) {
        const ChannelImage noisy = add_threshold_noise(reference, threshold, noise, seed, frame);
        EXPECT_EQ(noisy.channels.size(), 3u);
        EXPECT_EQ(noisy.channels[0].values.pixels, noisy.channels[2].values.pixels) << "grey";
        return noisy.channels[0].values.pixels;
    };
    const std::vector<float> one = red({1.0, false}, 3, 7);
    EXPECT_EQ(red({1.0, false}, 3, 7), one);
    EXPECT_NE(red({1.0, false}, 3, 8), one);
    EXPECT_NE(red({1.0, false}, 4, 7), one);
    // 4 cd/m2 of a white of 200 are .02.
    EXPECT_GE(std::ranges::min(one), 0.5f);
    EXPECT_LT(std::ranges::max(one), 0.5201f);
    EXPECT_GT(std::ranges::max(one), 0.519f);
    const std::vector<float> fair = red({2.0, true}, 3, 7);
    EXPECT_GT(std::ranges::max(fair), 0.538f);
    EXPECT_LT(std::ranges::min(fair), 0.462f);
    EXPECT_GE(std::ranges::min(fair), 0.4599f);
}

TEST_F(RunStudy, DividedItEndsWithTheSameNumbers) {
    const ScratchFolder divided;
    study.runs.seeds = {0, 5};
    const PreparedStudy prepared = prepare_study(study);
    const StudyResults expected = run();
    for (const std::size_t index : {2, 0, 1}) make_part(prepared, divided.path(), {index, 3});
    const StudyResults joined = run_study(prepared, divided.path());
    EXPECT_EQ(joined.made, 0u);
    EXPECT_EQ(joined.found, expected.made);
    EXPECT_EQ(numbers_of(joined), numbers_of(expected));
}

TEST_F(RunStudy, StoppedAnywhereEndsWithTheSameNumbers) {
    const ScratchFolder whole;
    study.sweep.pop_back();
    study.runs.seeds = {0, 5};
    study.runs.repeats = 2;
    const StudyResults expected = run_study(prepare_study(study), whole.path());
    EXPECT_EQ(expected.made, 8u);
    std::size_t stops = 0;
    for (int limit = 1; limit < 100; limit = 3 * limit + 1) {
        int calls = 0;
        const auto stop = [&](double, const std::string&) {
            if (++calls > limit) throw std::runtime_error("stopped");
        };
        try {
            run(stop);
            break;
        } catch (const std::runtime_error&) {
            ++stops;
        }
    }
    EXPECT_GE(stops, 2u);
    const StudyResults resumed = run();
    EXPECT_GT(resumed.found, 0u);
    EXPECT_EQ(numbers_of(resumed), numbers_of(expected));
    for (const VariantResult& variant : resumed.variants)
        EXPECT_TRUE(variant.metrics.at("share_beyond").error.has_value()) << "two seeds";
}

TEST_F(RunStudy, TwoSeedsTellWhatChanceChanges) {
    study.sweep = {{"spp", {1.0}}};
    study.scenes[0].frames = "3,4,6";
    const auto run_seeds = [&](std::vector<std::uint32_t> seeds) {
        study.runs.seeds = std::move(seeds);
        return run().variants.front();
    };
    EXPECT_FALSE(run_seeds({0}).metrics.contains("seed_seen"));
    const VariantResult equal = run_seeds({0, 0}), other = run_seeds({0, 5});
    EXPECT_EQ(equal.metrics.at("seed_seen").value, 0.0) << "equal pictures";
    EXPECT_EQ(equal.metrics.at("seed_flicker").value, 0.0);
    EXPECT_GT(other.metrics.at("seed_seen").value, 0.0);
    EXPECT_GT(other.frames[0].metrics.at("seed_flicker").value, 0.0);
    EXPECT_EQ(other.frames[2].metrics.at("seed_flicker").value, 0.0) << "frame 5 is not there";
    study.scenes[0].frames = "3,6";
    const PreparedStudy apart = prepare_study(study);
    EXPECT_EQ(std::ranges::find(apart.metrics, "seed_flicker", &Metric::name), apart.metrics.end());
    EXPECT_NE(std::ranges::find(apart.metrics, "seed_seen", &Metric::name), apart.metrics.end());
}

TEST_F(RunStudy, MakesAgainWhatIsMissingOrOfOtherSettings) {
    study.sweep.pop_back();
    run();
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "runs")) {
        if (entry.path().extension() == ".exr") {
            fs::remove(entry.path());
            break;
        }
    }
    EXPECT_EQ(run().made, 1u) << "a picture is missing";
    study.settings["light_samples"] = 5.0;
    EXPECT_EQ(run().made, 2u) << "another setting";
    study.scenes[0].frames = "4";
    EXPECT_EQ(run().made, 2u) << "another frame";
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "runs")) {
        if (entry.path().extension() == ".json") std::ofstream(entry.path()) << "{\"frames\": [{}]}";
    }
    EXPECT_NE(find_refusal([&] { run(); }).file, "") << "damaged runs";
}

TEST_F(RunStudy, AnotherExposureOrDisplayHasReferencesOfItsOwn) {
    study.sweep = {{"noise", {1.0}}};
    run();
    for (const char* key : {"exposure", "viewing.display_white"}) {
        study.settings[key] = 30.0;
        const ScratchFolder fresh;
        const StudyResults expected = run_study(prepare_study(study), fresh.path()), found = run();
        EXPECT_EQ(numbers_of(found), numbers_of(expected)) << key;
        EXPECT_EQ(found.frames[0].quality.percentile_99, expected.frames[0].quality.percentile_99) << key;
    }
}

TEST_F(RunStudy, ChecksEverythingBeforeItRenders) {
    const auto expect = [&](const char* part, void (*change)(Study&)) {
        Study changed = study;
        change(changed);
        EXPECT_THAT(find_refusal([&] { prepare_study(std::move(changed)); }).message, testing::HasSubstr(part));
    };
    EXPECT_NO_THROW(prepare_study(study));
    expect("did you mean \"gather\"", [](Study& changed) { changed.sweep.push_back({"gathr", {1.0}}); });
    expect("spp", [](Study& changed) { changed.sweep[0].values.push_back(-4.0); });
    expect("one size", [](Study& changed) { changed.variants.push_back({"large", {{"size", "64x48"}}}); });
    expect("seeds", [](Study& changed) { changed.variants.push_back({"other noise", {{"seed", 3.0}}}); });
    expect("seeds", [](Study& changed) { changed.settings["seed"] = 3.0; });
    expect("one size", [](Study& changed) { changed.viewers.push_back({"small", {{"size", "10x10"}}}); });
    expect("one size", [](Study& changed) { changed.reference = {"settings", 2, 4, {{"size", "10x10"}}}; });
    expect("vision", [](Study& changed) { changed.viewers.push_back({"bad", {{"vision", "cat"}}}); });
    expect("two viewers", [](Study& changed) { changed.viewers.push_back({"own", {}}); });
    expect("two scenes", [](Study& changed) { changed.scenes.push_back(changed.scenes[0]); });
    expect("no/such.json", [](Study& changed) { changed.scenes[0].file = "no/such.json"; });
}

}  // namespace
}  // namespace aleph
