// Means, standard errors and fronts of studies, and their files.
// Study files, and the variants and metrics that they ask for.

#include <nlohmann/json.hpp>

#include "render/study/metric_table.h"
#include "render/study/study.h"
#include "render/study/study_files.h"
#include "render/study/study_results.h"
#include "tests/support/german_locale.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

VariantResult variant_of(const std::string& name, double cost, double error) {
    VariantResult variant{name, {}, {}, {}, false};
    variant.metrics["processor_seconds"] = {cost, std::nullopt};
    variant.metrics["share_seen"] = {error, std::nullopt};
    return variant;
}

TEST(StudyResults, MeanAndStandardErrorOfRepeats) {
    EXPECT_EQ(mean_of({3.0}).value, 3.0);
    EXPECT_FALSE(mean_of({3.0}).error.has_value()) << "one value tells no error";
    const MeasuredValue mean = mean_of({1.0, 2.0, 3.0, 6.0});
    EXPECT_DOUBLE_EQ(mean.value, 3.0);
    EXPECT_DOUBLE_EQ(mean.error.value(), std::sqrt((4.0 + 1.0 + 0.0 + 9.0) / 3.0 / 4.0));
}

FrameRun run_of(double seconds, double rays) {
    FrameRun run;
    run.frame = 5;
    run.processor_seconds = seconds;
    run.stages = {{"fill", 0.5 * seconds}, {"shade", 0.25 * seconds}};
    run.rays = {{"primary", rays}, {"gather", 3e6}};
    run.plan = "[]";
    return run;
}

TEST(StudyResults, RepeatsCountForTimesAndSeedsForErrors) {
    std::vector<MeasuredRun> runs;
    runs.push_back({{run_of(1.0, 1e6)}, {{{"share_beyond", 2.0}}}, {"a.exr"}});
    runs.push_back({{run_of(2.0, 2e6)}, {{{"share_beyond", 4.0}}}, {"b.exr"}});
    runs.push_back({{run_of(6.0, 1e6)}, {}, {}});
    const std::vector<FrameResult> results = summarize_runs("pool", runs);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].frame, 5);
    EXPECT_EQ(results[0].picture, "a.exr");
    EXPECT_DOUBLE_EQ(results[0].metrics.at("processor_seconds").value, 3.0) << "all three";
    EXPECT_DOUBLE_EQ(results[0].metrics.at("share_beyond").value, 3.0) << "both seeds";
    EXPECT_DOUBLE_EQ(results[0].metrics.at("share_beyond").error.value(), 1.0);
    EXPECT_DOUBLE_EQ(results[0].metrics.at("rays").value, 4.5) << "millions";
    EXPECT_DOUBLE_EQ(results[0].metrics.at("gather_rays").value, 3.0);
    EXPECT_DOUBLE_EQ(results[0].stages[0].second, 1.5);
}

TEST(StudyResults, MeansOverFramesNeedEveryFrame) {
    VariantResult variant;
    variant.frames.resize(2);
    variant.frames[0].metrics = {{"a", {1.0, 0.3}}, {"b", {1.0, std::nullopt}}, {"c", {1.0, 0.1}}};
    variant.frames[1].metrics = {{"a", {3.0, 0.4}}, {"b", {2.0, 0.5}}};
    average_frames(variant);
    EXPECT_DOUBLE_EQ(variant.metrics.at("a").value, 2.0);
    EXPECT_DOUBLE_EQ(variant.metrics.at("a").error.value(), 0.25) << "sqrt(.3^2 + .4^2) / 2";
    EXPECT_DOUBLE_EQ(variant.metrics.at("b").value, 1.5);
    EXPECT_FALSE(variant.metrics.at("b").error.has_value()) << "of one frame it is not known";
    EXPECT_FALSE(variant.metrics.contains("c"));
}

TEST(StudyResults, FrontHasWhatNothingBeats) {
    std::vector<VariantResult> variants{variant_of("dear, good", 8.0, 0.1), variant_of("cheap, bad", 1.0, 5.0),
                                        variant_of("beaten", 8.0, 5.0),     variant_of("between", 2.0, 1.0),
                                        variant_of("equal", 2.0, 1.0),      variant_of("dearer", 2.5, 1.0)};
    variants.emplace_back().name = "unmeasured";
    find_front(variants);
    std::vector<std::string> front;
    for (const VariantResult& variant : variants) {
        if (variant.on_front) front.push_back(variant.name);
    }
    EXPECT_EQ(front, (std::vector<std::string>{"dear, good", "cheap, bad", "between", "equal"}));
}

struct Draft {
    PreparedStudy prepared;
    StudyResults results;
};

Draft draft_study() {
    Draft draft;
    Study& study = draft.prepared.study;
    study.title = "{\"quoted\", _under_}";
    study.viewers.push_back({"own", {}});
    study.sweep = {{"guide", {std::string("a,b")}}};
    draft.prepared.variants = list_variants(study);
    draft.prepared.metrics = {{"processor_seconds", "", "", true, -1}, {"share_beyond", "", "", false, 0}};
    VariantResult variant = variant_of(draft.prepared.variants[0].name, 1.5, 0.0);
    variant.settings = draft.prepared.variants[0].settings;
    FrameResult& frame = variant.frames.emplace_back();
    frame.scene = "say \"pool\"";
    frame.frame = -3;
    frame.metrics["processor_seconds"] = {1.5, 0.25};
    frame.plan = "[]";
    draft.results.variants = {variant};
    return draft;
}

TEST(StudyResults, DT09_CsvHasQuotesWhereNeededAndPointsInEveryLocale) {
    const Draft draft = draft_study();
    const std::string expected =
        "scene,frame,variant,guide,processor_seconds,processor_seconds_error,share_beyond,share_beyond_error\n"
        "\"say \"\"pool\"\"\",-3,\"guide=a,b\",\"a,b\",1.5,0.25,,\n";
    EXPECT_EQ(study_csv(draft.prepared, draft.results), expected);
    const GermanLocale locale;
    if (!locale.available()) GTEST_SKIP() << "the locale de_DE is not installed";
    EXPECT_EQ(study_csv(draft.prepared, draft.results), expected);
}

TEST(StudyResults, DateFollowsTheEnvironment) {
    ::setenv("SOURCE_DATE_EPOCH", "86400", 1);
    EXPECT_EQ(study_date(), "1970-01-02T00:00:00Z");
    ::unsetenv("SOURCE_DATE_EPOCH");
    EXPECT_GT(study_date(), "2024");
}

TEST(StudyFile, HoldsWhatTheTextSays) {
    const Study study = parse_study(R"({
        // comments are allowed
        "title": "Guides", "description": "What guidance saves.",
        "scenes": [{"scene": "../pool/scene.json", "frames": "20,60"}, {"scene": "/a/b.gltf"}],
        "size": "64x48",
        "settings": {"light_step": 0, "filter": "box"},
        "reference": {"kind": "settings", "passes": 3, "spp": 5, "settings": {"gather": 64}},
        "sweep": {"guide": ["none", "full"], "error": [0.5, 1]},
        "variants": [{"name": "plain", "settings": {}}, {"settings": {"spp": 4}}],
        "metrics": ["relative_mse"],
        "viewers": [{"name": "thesis", "settings": {}}, {"name": "castle", "settings": {"vision": "castle"}}],
        "repeats": 2, "seeds": [0, 7]
    })",
                                    "studies/guides.json");
    EXPECT_EQ(study.title, "Guides");
    ASSERT_EQ(study.scenes.size(), 2u);
    EXPECT_EQ(study.scenes[0].file, "pool/scene.json") << "from the study's folder";
    EXPECT_EQ(study.scenes[0].frames, "20,60");
    EXPECT_EQ(study.scenes[1].file, "/a/b.gltf");
    EXPECT_EQ(study.scenes[1].frames, "");
    EXPECT_EQ(study.settings, (SettingMap{{"light_step", 0.0}, {"filter", "box"}, {"size", "64x48"}}));
    EXPECT_EQ(study.reference.kind, "settings");
    EXPECT_EQ(study.reference.passes, 3);
    EXPECT_EQ(study.reference.spp, 5);
    EXPECT_EQ(study.reference.settings, (SettingMap{{"gather", 64.0}}));
    EXPECT_EQ(study.runs.repeats, 2);
    EXPECT_EQ(study.runs.seeds, (std::vector<std::uint32_t>{0, 7}));
    std::vector<std::string> names;
    for (const StudyVariant& variant : list_variants(study)) names.push_back(variant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"guide=none,error=0.5", "guide=none,error=1", "guide=full,error=0.5",
                                               "guide=full,error=1", "plain", "spp=4"}));
    std::vector<std::string> metrics;
    for (const Metric& metric : list_metrics(study)) metrics.push_back(metric.name);
    EXPECT_EQ(metrics, (std::vector<std::string>{"processor_seconds", "share_seen", "relative_mse"}));
}

TEST(StudyFile, HasDefaults) {
    const Study study = parse_study(R"({"scenes": [{"scene": "scene.json"}], "sweep": {"spp": [1]}})", "s.json");
    EXPECT_EQ(study.title, "s");
    EXPECT_EQ(std::get<std::string>(study.settings.at("size")), "320x240");
    EXPECT_EQ(study.reference.kind, "path");
    EXPECT_EQ(study.runs.seeds, std::vector<std::uint32_t>{0});
    EXPECT_EQ(study.viewers.size(), 1u);
    for (const Metric& metric : list_metrics(study)) EXPECT_FALSE(metric.name.starts_with("seed_")) << "needs two";
}

/// "place: reason" of the error that a study text gives.
std::string error_of(const std::string& text) {
    const auto read = [&] {
        const Study study = parse_study(text, "s.json");
        list_variants(study);
        list_metrics(study);
    };
    return find_refusal(read).message;
}

TEST(StudyFile, NamesWhatIsWrong) {
    const auto expect_error = [&](const std::string& text, const std::string& part) {
        const std::string error = error_of(text);
        EXPECT_NE(error.find(part), std::string::npos) << text << ": " << error;
    };
    const auto expect = [&](const std::string& more, const std::string& part) {
        expect_error(R"({"scenes": [{"scene": "a.json"}])" + more + "}", part);
    };
    expect_error("{}", "scenes");
    expect_error(R"({"scenes": []})", "/scenes");
    expect_error("{", "line 1");
    expect(R"(, "sweeps": {})", "sweeps");
    expect(R"(, "sweep": {"error": []})", "/sweep/error");
    expect(R"(, "sweep": {"error": [[1]]})", "/sweep/error/0");
    expect(R"(, "sweep": {"spp": [1, 1]})", "two variants");
    expect("", "no variants");
    expect(R"(, "variants": [{"settings": {}}])", "needs a name");
    expect(R"(, "reference": {"kind": "paths"})", "/reference/kind");
    expect_error(R"({"scenes": [{"scene": "a.json", "frames": "x"}], "sweep": {"spp": [1]}})",
                 "s.json: /scenes/0/frames: 'x': expected N");
    expect(R"(, "sweep": {"spp": [1]}, "metrics": ["speed"])", "s.json: metrics: there is no metric speed");
    expect(R"(, "reference": {"passes": 1})", "/reference/passes");
    expect(R"(, "reference": {"settings": {"spp": 3}})", "/reference");
    expect(R"(, "sweep": {"spp": [1]}, "metrics": ["recods"])", "\"records\"");
    expect(R"(, "sweep": {"spp": [1]}, "metrics": ["seed_flicker"])", "two seeds");
    expect(R"(, "viewers": [{"name": "A b", "settings": {}}])", "/viewers/0/name");
    expect(R"(, "seeds": [-1])", "/seeds/0");
    expect(R"(, "seeds": [3, 3])", "/seeds: expected a list of different seeds");
    std::string values = "1";
    for (int i = 2; i <= 300; ++i) values += fmt::format(",{}", i);
    expect(fmt::format(R"(, "sweep": {{"spp": [{0}], "gather": [{0}], "bounces": [{0}]}})", values), "more than 10000");
}

TEST(StudyFiles, NumbersThatPeopleReadHaveNoExponent) {
    EXPECT_EQ(brief(100.0, 2), "100");
    EXPECT_EQ(brief(99.6, 2), "100");
    EXPECT_EQ(brief(99.4, 2), "99");
    EXPECT_EQ(brief(9.6, 1), "10");
    EXPECT_EQ(brief(-1234.5, 3), "-1234");
    EXPECT_EQ(brief(0.02345, 2), "0.023");
    EXPECT_EQ(brief(1.5e12, 2), "1.5e+12");
    EXPECT_EQ(brief(std::nan(""), 2), "nan");
}

}  // namespace
}  // namespace aleph
