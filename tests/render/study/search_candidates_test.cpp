// Which settings a search tries, and how its rounds grow. Ranks, crowding and fronts of points made by hand.

#include <fmt/ranges.h>

#include "render/study/pareto.h"
#include "render/study/search_study.h"
#include "render/study/study.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Study searched(StudySearch search) {
    Study study;
    study.search = std::move(search);
    return study;
}

const SettingValue none = std::string("none"), saliency = std::string("saliency");

TEST(SearchCandidates, DefaultsAreFixedSettingsThatDiffer) {
    const std::vector<StudyVariant> candidates = list_candidates(searched(default_search()));
    ASSERT_EQ(candidates.size(), 48u);
    std::set<SettingMap> different;
    std::map<SettingValue, int> spp;
    int without_records = 0;
    for (const StudyVariant& candidate : candidates) {
        const SettingMap& settings = candidate.settings;
        const bool records = settings.at("accuracy") != SettingValue(0.0);
        EXPECT_EQ(settings.contains("gather"), records);
        EXPECT_EQ(settings.contains("light_step"), records);
        EXPECT_TRUE(records || settings.at("guide") == none);
        without_records += records ? 0 : 1;
        EXPECT_TRUE(different.insert(settings).second) << candidate.name;
        EXPECT_EQ(settings.at("sampling"), SettingValue(std::string("uniform")));
        EXPECT_EQ(settings.at("error"), SettingValue(0.0));
        EXPECT_EQ(settings.contains("adapter"), settings.at("guide") == saliency) << "without a guide there is none";
        ++spp[settings.at("spp")];
    }
    EXPECT_NEAR(without_records, 8, 2);
    ASSERT_EQ(spp.size(), 6u);
    for (const auto& [value, count] : spp) EXPECT_NEAR(count, 8, 3) << "dealt evenly, but for equal candidates";
}

TEST(SearchCandidates, MoreBeginWithTheSame) {
    StudySearch search = default_search();
    const std::vector<StudyVariant> many = list_candidates(searched(search));
    search.candidates = 12;
    const std::vector<StudyVariant> few = list_candidates(searched(search));
    ASSERT_EQ(few.size(), 12u);
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].name, many[i].name);
        EXPECT_EQ(few[i].settings, many[i].settings);
    }
}

TEST(SearchCandidates, AnyNumberHasAllValuesAboutEquallyOften) {
    StudySearch search;
    std::vector<SettingValue> values;
    for (int i = 0; i < 100; ++i) values.emplace_back(static_cast<double>(i));
    search.settings = {{"gather", values}, {"spp", {1.0, 2.0, 3.0}}};
    search.candidates = 100;
    std::map<SettingValue, int> gather, spp;
    for (const StudyVariant& candidate : list_candidates(searched(search))) {
        ++gather[candidate.settings.at("gather")];
        ++spp[candidate.settings.at("spp")];
    }
    EXPECT_EQ(gather.size(), 100u) << "each once";
    EXPECT_EQ(spp[1.0] + spp[2.0] + spp[3.0], 100);
    for (const auto& [value, count] : spp) EXPECT_NEAR(count, 33.5, 0.51);
}

TEST(SearchCandidates, FewCombinationsAreAllTried) {
    StudySearch search;
    search.settings = {{"guide", {none, saliency}},
                       {"adapter", {std::string("compress"), std::string("scale-add")}},
                       {"light_samples", {1.0, 16.0}},
                       {"spp", {4.0}}};
    std::vector<std::string> names;
    for (const StudyVariant& candidate : list_candidates(searched(search)))
        names.push_back(candidate.name + ": " + name_settings(candidate.settings, search.settings));
    const std::string more = ",error=0,sampling=uniform";
    EXPECT_EQ(names, (std::vector<std::string>{
                         "fixed 1: guide=none,light_samples=1,spp=4" + more,
                         "fixed 2: guide=none,light_samples=16,spp=4" + more,
                         "fixed 3: guide=saliency,adapter=compress,light_samples=1,spp=4" + more,
                         "fixed 4: guide=saliency,adapter=compress,light_samples=16,spp=4" + more,
                         "fixed 5: guide=saliency,adapter=scale-add,light_samples=1,spp=4" + more,
                         "fixed 6: guide=saliency,adapter=scale-add,light_samples=16,spp=4" + more,
                     }));
    Study unguided = searched({{{"adapter", {std::string("compress"), std::string("scale-add")}}}, 48, 3});
    unguided.settings["guide"] = none;
    EXPECT_EQ(list_candidates(unguided).size(), 1u) << "the study has no guide";
}

std::string text_of(const std::vector<SearchRound>& rounds) {
    std::string text;
    for (const auto& [candidates, width, height, frames] : rounds)
        text += fmt::format("{} of {}x{}: {}; ", candidates, width, height, fmt::join(frames, " "));
    return text;
}

TEST(SearchCandidates, RoundsHalveCandidatesAndGrowPictures) {
    // The picture of the second has half the pixels.
    EXPECT_EQ(text_of(plan_rounds(3, 45, 320, 240, {30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41})),
              "45 of 160x120: 30 31 32; 23 of 226x170: 30 31 32 33 34 35; "
              "12 of 320x240: 30 31 32 33 34 35 36 37 38 39 40 41; ");
    EXPECT_EQ(text_of(plan_rounds(1, 7, 33, 1, {5})), "7 of 33x1: 5; ");
    EXPECT_EQ(text_of(plan_rounds(3, 2, 33, 1, {5})), "2 of 17x1: 5; 1 of 23x1: 5; 1 of 33x1: 5; ");
}

TEST(SearchCandidates, FirstFramesFollowEachOther) {
    EXPECT_EQ(plan_rounds(2, 4, 8, 8, {3, 9, 20, 21, 22, 40})[0].frames, (std::vector<int>{20, 21, 22}));
    EXPECT_EQ(plan_rounds(2, 4, 8, 8, {3, 9, 20, 40})[0].frames, (std::vector<int>{3, 9, 20})) << "where they can";
    EXPECT_EQ(plan_rounds(2, 4, 8, 8, {3, 9})[0].frames, (std::vector<int>{3, 9}));
}

TEST(SearchCandidates, StudyFilesChangeTheDefaults) {
    const auto read = [](const std::string& search) {
        return parse_study(R"({"scenes": [{"scene": "a.json"}], "search": )" + search + "}", "s.json");
    };
    const StudySearch usual = read("{}").search.value();
    EXPECT_EQ(usual.candidates, 48);
    EXPECT_EQ(usual.rounds, 3);
    EXPECT_EQ(usual.settings.size(), default_search().settings.size());
    EXPECT_TRUE(list_variants(read("{}")).empty()) << "a search needs no variants";
    const StudySearch own =
        read(R"({"candidates": 5, "rounds": 2, "settings": {"spp": [1, 2], "vision": ["castle"]}})").search.value();
    EXPECT_EQ(own.candidates, 5);
    EXPECT_EQ(own.rounds, 2);
    EXPECT_EQ(own.settings.size(), usual.settings.size() + 1);
    const auto spp = std::ranges::find(own.settings, "spp", &StudyAxis::setting);
    EXPECT_EQ(spp->values, (std::vector<SettingValue>{1.0, 2.0}));
    const auto refuse = [&](const std::string& search, const std::string& place, const std::string& words) {
        expect_refusal([&] { read(search); }, "s.json", place, words);
    };
    refuse("true", "/search", "a search of fixed settings");
    refuse(R"({"candidate": 3})", "/search/candidate", "candidates");
    refuse(R"({"candidates": 0})", "/search/candidates", "1");
    refuse(R"({"rounds": 11})", "/search/rounds", "10");
    refuse(R"({"settings": {"spp": []}})", "/search/settings/spp", "");
    refuse(R"({"settings": {"spp": 4}})", "/search/settings/spp", "a list of values");
    refuse(R"({"settings": {"error": [1]}})", "/search/settings/error", "no error is asked for");
    refuse(R"({"settings": {"sampling": ["variance"]}})", "/search/settings/sampling", "uniform");
    refuse(R"({"settings": {"size": ["8x8"]}})", "/search/settings/size", "one size");
    refuse(R"({"settings": {"seed": [1]}})", "/search/settings/seed", "seeds");
}

TEST(Pareto, RanksAreFrontsOfWhatIsLeft) {
    const std::vector<CostPoint> points{{4.0, 4.0}, {1.0, 8.0}, {2.0, 4.0}, {8.0, 1.0},
                                        {4.0, 8.0}, {9.0, 9.0}, {2.0, 4.0}, {3.0, 5.0}};
    EXPECT_EQ(rank_points(points), (std::vector<int>{1, 0, 0, 0, 2, 3, 0, 1}));
    EXPECT_TRUE(rank_points({}).empty());
}

TEST(Pareto, CrowdingIsTheExtentOfTheNeighboursInLogarithms) {
    // Costs and errors over three decades; the last two points are of another rank.
    const std::vector<CostPoint> points{{1000.0, 0.1}, {1.0, 100.0},  {10.0, 10.0},
                                        {100.0, 5.0},  {10.0, 100.0}, {100.0, 50.0}};
    const std::vector<int> ranks = rank_points(points);
    EXPECT_EQ(ranks, (std::vector<int>{0, 0, 0, 0, 1, 1}));
    const std::vector<double> distances = crowding_distances(points, ranks);
    EXPECT_EQ(distances[0], infinity);
    EXPECT_EQ(distances[1], infinity);
    EXPECT_NEAR(distances[2], 2.0 / 3.0 + std::log10(100.0 / 5.0) / 3.0, 1e-12);
    EXPECT_NEAR(distances[3], 2.0 / 3.0 + std::log10(10.0 / 0.1) / 3.0, 1e-12);
    EXPECT_EQ(distances[4], infinity);
    EXPECT_EQ(distances[5], infinity);
}

TEST(Pareto, CrowdingTakesErrorsBelowTheLeastAsEqual) {
    const std::vector<CostPoint> points{{1.0, 0.008}, {10.0, 0.004}, {100.0, 0.0}};
    const std::vector<double> distances = crowding_distances(points, rank_points(points));
    EXPECT_DOUBLE_EQ(distances[1], 1.0) << "costs alone tell them apart";
}

TEST(Pareto, KeepsLowRanksThenTheEndsThenWhatStandsAlone) {
    const std::vector<CostPoint> points{{9.0, 90.0},   // rank 1
                                        {1.0, 80.0},   // an end
                                        {2.0, 20.0},   // crowded by the next
                                        {2.1, 19.0},   // crowded
                                        {20.0, 2.0},   // alone
                                        {40.0, 1.0}};  // an end
    EXPECT_EQ(keep_best(points, 2), (std::vector<std::size_t>{1, 5}));
    EXPECT_EQ(keep_best(points, 3), (std::vector<std::size_t>{1, 4, 5}));
    EXPECT_EQ(keep_best(points, 4), (std::vector<std::size_t>{1, 3, 4, 5}));
    EXPECT_EQ(keep_best(points, 5), (std::vector<std::size_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(keep_best(points, 9), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Pareto, KeepsTheFirstOfEqualPoints) {
    const std::vector<CostPoint> points{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}};
    EXPECT_EQ(keep_best(points, 1), std::vector<std::size_t>{0});
    EXPECT_EQ(list_front(points), std::vector<std::size_t>{0});
}

const std::vector<CostPoint> front{{4.0, 1.0}, {1.0, 16.0}, {5.0, 2.0}, {64.0, 0.25}};  // {5, 2} is beaten

TEST(Pareto, FrontIsSortedByCost) {
    EXPECT_EQ(list_front(front), (std::vector<std::size_t>{1, 0, 3}));
    EXPECT_EQ(find_cheapest(front, 1.0), 0u);
    EXPECT_EQ(find_cheapest(front, 0.9), 3u);
    EXPECT_EQ(find_cheapest(front, 100.0), 1u);
    EXPECT_FALSE(find_cheapest(front, 0.2).has_value());
}

void expect_cost(double error, double cost, FrontCost::Bound bound) {
    const FrontCost found = interpolate_front(front, error);
    EXPECT_NEAR(found.cost, cost, 1e-12 * cost) << error;
    EXPECT_EQ(found.bound, bound) << error;
}

TEST(Pareto, CostOfAnErrorIsInterpolatedInLogarithms) {
    using Bound = FrontCost::Bound;
    expect_cost(16.0, 1.0, Bound::between);
    expect_cost(4.0, 2.0, Bound::between);
    expect_cost(1.0, 4.0, Bound::between);
    expect_cost(0.5, 16.0, Bound::between);
    expect_cost(0.25, 64.0, Bound::between);
    expect_cost(17.0, 1.0, Bound::at_most);
    expect_cost(0.2, 64.0, Bound::more);
}

TEST(Pareto, ErrorsBelowTheLeastAreEqual) {
    const std::vector<CostPoint> points{{1.0, 1.0}, {3.0, 0.005}, {9.0, 0.0}};
    EXPECT_EQ(interpolate_front(points, 0.0).cost, 3.0);
    EXPECT_EQ(interpolate_front(points, 0.0).bound, FrontCost::Bound::between);
    EXPECT_NEAR(interpolate_front(points, 0.1).cost, std::sqrt(3.0), 1e-12);
    const std::vector<CostPoint> one{{2.0, 0.0}};
    EXPECT_EQ(interpolate_front(one, 0.0).cost, 2.0);
    EXPECT_EQ(interpolate_front(one, 3.0).bound, FrontCost::Bound::at_most);
}

}  // namespace
}  // namespace aleph
