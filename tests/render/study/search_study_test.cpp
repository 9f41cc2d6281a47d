// Searches of tiny pictures: what is run, what is left, and that a stopped search goes on.

#include <nlohmann/json.hpp>

#include "render/study/search_study.h"
#include "render/study/study_files.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Two scenes; 6 candidates, of which 3 and then 2 are left; and one variant of its own.
Study small_search() {
    Study study;
    study.title = "small";
    study.scenes = {{source_folder() / "scenes/cornell/scene.json", "3-4"},
                    {source_folder() / "scenes/boomerang/scene.json", "10"}};
    study.settings = {{"size", "16x12"}, {"filter", "box"}};
    study.reference = {"gather", 2, 8, {}};
    study.variants = {{"asked", {{"error", 4.0}}}};
    study.viewers = {{"own", {}}};
    study.search = {{{"spp", {1.0, 2.0, 4.0}}, {"gather", {16.0, 64.0}}}, 6, 3};
    return study;
}

/// Everything that the results tell, but for the date.
std::string text_of(const PreparedStudy& prepared, const StudyResults& results, const std::filesystem::path& folder) {
    return study_json(prepared, results, {"", "", 1, folder}).dump() + study_csv(prepared, results);
}

std::size_t frames_in(const VariantResult& variant, const std::string& scene) {
    return static_cast<std::size_t>(std::ranges::count(variant.frames, scene, &FrameResult::scene));
}

TEST(SearchStudy, StoppedAnywhereGoesOnAndLeavesTheBestOfEachSceneBesideTheStudysVariants) {
    const ScratchFolder folder;
    const PreparedStudy prepared = prepare_study(small_search());
    ASSERT_EQ(prepared.candidates.size(), 6u);
    ASSERT_EQ(prepared.variants.size(), 1u);
    int stops = 0;
    for (int limit = 1; limit < 1000; limit = 3 * limit + 1) {
        int calls = 0;
        double before = 0.0;
        const auto stop = [&](double share, const std::string&) {
            EXPECT_LE(before, share + 1e-9);
            before = share;
            if (++calls > limit) throw std::runtime_error("stopped");
        };
        try {
            search_study(prepared, folder.path(), stop);
            break;
        } catch (const std::runtime_error&) {
            ++stops;
        }
    }
    EXPECT_GE(stops, 2);
    const StudyResults results = search_study(prepared, folder.path());
    EXPECT_EQ(results.made + results.found, 2u * (6 + 3 + 2 + 1));
    const StudyResults again = search_study(prepared, folder.path());
    EXPECT_EQ(again.made, 0u);
    EXPECT_EQ(again.found, results.made + results.found);
    EXPECT_EQ(text_of(prepared, again, folder.path()), text_of(prepared, results, folder.path()))
        << "seconds are those of the finished runs";
    ASSERT_GE(results.variants.size(), 3u);
    EXPECT_EQ(results.variants[0].name, "asked");
    EXPECT_EQ(frames_in(results.variants[0], "cornell"), 2u);
    EXPECT_EQ(frames_in(results.variants[0], "boomerang"), 1u);
    for (const char* scene : {"cornell", "boomerang"}) {
        const std::vector<VariantResult> variants = variants_of_scene(results, scene);
        ASSERT_EQ(variants.size(), 3u) << scene;
        EXPECT_EQ(variants[0].name, "asked");
        for (const VariantResult& variant : variants) {
            EXPECT_EQ(frames_in(variant, scene), variant.frames.size());
            const auto whole = std::ranges::find(results.variants, variant.name, &VariantResult::name);
            EXPECT_TRUE(whole->on_front || !variant.on_front) << variant.name;
            EXPECT_EQ(variant.settings, whole->settings);
        }
    }
    const std::vector<SceneSearch> summaries = summarize_search(prepared, results);
    ASSERT_EQ(summaries.size(), 2u);
    for (const SceneSearch& scene : summaries) {
        ASSERT_GE(scene.front.size(), 1u);
        for (const SearchedPoint& point : scene.front) EXPECT_EQ(point.variant.substr(0, 6), "fixed ");
        ASSERT_EQ(scene.against.size(), 1u);
        EXPECT_EQ(scene.against[0].own.variant, "asked");
        EXPECT_GT(scene.against[0].fixed.cost, 0.0);
    }
    const auto json = study_json(prepared, results, {"", "", 1, folder.path()})["search"];
    EXPECT_EQ(json["candidates"], 6);
    EXPECT_EQ(json["axes"].size(), 2u);
    ASSERT_EQ(json["scenes"].size(), 2u);
    EXPECT_EQ(json["scenes"][0]["scene"], "cornell");
    EXPECT_EQ(json["scenes"][0]["rounds"][0]["size"], "8x6");
    EXPECT_EQ(json["scenes"][0]["rounds"][2]["candidates"], 2);
    EXPECT_EQ(json["scenes"][0]["against"][0]["variant"], "asked");
    EXPECT_NE(study_csv(prepared, results).find(",gather,"), std::string::npos) << "columns of searched settings";
}

VariantResult variant_of(const std::string& name, const std::vector<std::pair<std::string, CostPoint>>& frames) {
    VariantResult variant{name, {}, {}, {}, false};
    for (const auto& [scene, point] : frames) {
        FrameResult& frame = variant.frames.emplace_back();
        frame.scene = scene;
        frame.metrics["processor_seconds"] = {point.cost, std::nullopt};
        frame.metrics["share_seen"] = {point.error, std::nullopt};
    }
    return variant;
}

TEST(SearchStudy, ComparesWithinAScene) {
    PreparedStudy prepared;
    for (const char* scene : {"a", "b"}) prepared.scenes.emplace_back().name = scene;
    prepared.variants = {{"asked", {}}};
    for (const char* name : {"fixed 1", "fixed 2", "fixed 3"}) prepared.candidates.push_back({name, {}});
    StudyResults results;
    results.variants = {variant_of("asked", {{"a", {1.0, 2.0}}, {"a", {3.0, 6.0}}, {"b", {1.0, 1.0}}}),
                        variant_of("fixed 1", {{"a", {4.0, 16.0}}, {"a", {4.0, 16.0}}}),
                        variant_of("fixed 2", {{"a", {16.0, 1.0}}, {"a", {16.0, 1.0}}, {"b", {5.0, 8.0}}}),
                        variant_of("fixed 3", {{"b", {0.5, 4.0}}}), variant_of("pictures", {{"a", {0.0, 3.0}}})};
    results.variants.back().frames[0].metrics.erase("processor_seconds");
    const std::vector<SceneSearch> summaries = summarize_search(prepared, results);
    ASSERT_EQ(summaries.size(), 2u);
    ASSERT_EQ(summaries[0].front.size(), 2u);
    EXPECT_EQ(summaries[0].front[0].variant, "fixed 1") << "the study's own variants beat none of them away";
    EXPECT_EQ(summaries[0].front[1].variant, "fixed 2");
    EXPECT_EQ(summaries[0].against.size(), 1u) << "pictures from elsewhere have no cost";
    EXPECT_EQ(summaries[0].against[0].own.point.cost, 2.0) << "mean of its frames in a";
    EXPECT_NEAR(summaries[0].against[0].fixed.cost, 8.0, 1e-12) << "halfway from 16 % to 1 %";
    ASSERT_EQ(summaries[1].front.size(), 1u);
    EXPECT_EQ(summaries[1].front[0].variant, "fixed 3");
    EXPECT_EQ(summaries[1].against[0].fixed.bound, FrontCost::Bound::more);
    const std::vector<VariantResult> a = variants_of_scene(results, "a");
    ASSERT_EQ(a.size(), 4u);
    EXPECT_TRUE(a[0].on_front);
    EXPECT_FALSE(a[1].on_front) << "the study's own variant beats it";
    EXPECT_TRUE(a[2].on_front);
}

TEST(SearchStudy, ChecksCandidatesBeforeItRenders) {
    const auto error_of = [](Study study) { return find_refusal([&] { prepare_study(std::move(study)); }).message; };
    EXPECT_EQ(error_of(small_search()), "");
    Study study = small_search();
    study.search->settings.push_back({"gathr", {1.0}});
    EXPECT_NE(error_of(study).find("gathr"), std::string::npos);
    study = small_search();
    study.search->settings[0].values.push_back(-4.0);
    EXPECT_NE(error_of(study).find("spp"), std::string::npos);
    study = small_search();
    study.variants.push_back({"fixed 2", {}});
    EXPECT_NE(error_of(study).find("fixed 2"), std::string::npos);
}

}  // namespace
}  // namespace aleph
