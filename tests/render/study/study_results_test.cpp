// Means, standard errors and fronts of studies, and their files.

#include "render/study/study_results.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "render/study/study_files.h"
#include "tests/support/german_locale.h"

namespace aleph {
namespace {

VariantResult variant_of(const std::string& name, double cost, double error) {
    VariantResult variant{name, {}, {}, {}, false};
    variant.metrics["processor_seconds"] = {cost, std::nullopt};
    variant.metrics["share_beyond"] = {error, std::nullopt};
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
    runs.push_back({0, {run_of(1.0, 1e6)}, {{{"share_beyond", 2.0}}}, {"a.exr"}});
    runs.push_back({0, {run_of(2.0, 2e6)}, {{{"share_beyond", 4.0}}}, {"b.exr"}});
    runs.push_back({1, {run_of(6.0, 1e6)}, {}, {}});
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
    find_front(variants, "processor_seconds", "share_beyond");
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

}  // namespace
}  // namespace aleph
