// Study files, and the variants and metrics that they ask for.

#include "render/study/study_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/base/errors.h"
#include "render/study/metric_table.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

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
    EXPECT_EQ(study.repeats, 2);
    EXPECT_EQ(study.seeds, (std::vector<std::uint32_t>{0, 7}));
    std::vector<std::string> names;
    for (const StudyVariant& variant : list_variants(study)) names.push_back(variant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"guide=none,error=0.5", "guide=none,error=1", "guide=full,error=0.5",
                                               "guide=full,error=1", "plain", "spp=4"}));
    std::vector<std::string> metrics;
    for (const Metric& metric : list_metrics(study)) metrics.push_back(metric.name);
    EXPECT_EQ(metrics,
              (std::vector<std::string>{"processor_seconds", "share_seen", "relative_mse"}));
}

TEST(StudyFile, HasDefaults) {
    const Study study = parse_study(R"({"scenes": [{"scene": "scene.json"}], "sweep": {"spp": [1]}})", "s.json");
    EXPECT_EQ(study.title, "s");
    EXPECT_EQ(std::get<std::string>(study.settings.at("size")), "320x240");
    EXPECT_EQ(study.reference.kind, "path");
    EXPECT_EQ(study.seeds, std::vector<std::uint32_t>{0});
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
    const std::string scenes = R"("scenes": [{"scene": "a.json"}])";
    const auto expect = [&](const std::string& more, const std::string& part) {
        const std::string error = error_of("{" + scenes + more + "}");
        EXPECT_NE(error.find(part), std::string::npos) << more << ": " << error;
    };
    EXPECT_NE(error_of("{}").find("scenes"), std::string::npos);
    EXPECT_NE(error_of(R"({"scenes": []})").find("/scenes"), std::string::npos);
    EXPECT_NE(error_of("{").find("line 1"), std::string::npos);
    expect(R"(, "sweeps": {})", "sweeps");
    expect(R"(, "sweep": {"error": []})", "/sweep/error");
    expect(R"(, "sweep": {"error": [[1]]})", "/sweep/error/0");
    expect(R"(, "sweep": {"spp": [1, 1]})", "two variants");
    expect("", "no variants");
    expect(R"(, "variants": [{"settings": {}}])", "needs a name");
    expect(R"(, "reference": {"kind": "paths"})", "/reference/kind");
    expect(R"(, "reference": {"passes": 1})", "/reference/passes");
    expect(R"(, "reference": {"settings": {"spp": 3}})", "/reference");
    expect(R"(, "sweep": {"spp": [1]}, "metrics": ["recods"])", "\"records\"");
    expect(R"(, "sweep": {"spp": [1]}, "metrics": ["seed_flicker"])", "two seeds");
    expect(R"(, "viewers": [{"name": "A b", "settings": {}}])", "/viewers/0/name");
    expect(R"(, "seeds": [-1])", "/seeds/0");
}

TEST(StudyFile, RefusesGridsOfMillions) {
    std::string values = "1";
    for (int i = 2; i <= 300; ++i) values += fmt::format(",{}", i);
    const std::string error = error_of(fmt::format(
        R"({{"scenes": [{{"scene": "a.json"}}], "sweep": {{"spp": [{0}], "gather": [{0}], "bounces": [{0}]}}}})",
        values));
    EXPECT_NE(error.find("more than 10000"), std::string::npos) << error;
}

}  // namespace
}  // namespace aleph
