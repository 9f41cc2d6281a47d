// scenes/stats.schema.json describes every key of the --stats file.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/json/schema.h"
#include "tests/render/cli/answers.h"
#include "tests/support/paths.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {
namespace {

using Json = nlohmann::json;

class StatsSchema : public ProgramTest {
  protected:
    StatsSchema() { write_sliding_box(folder_ / "scene.json"); }

    /// The statistics of a command.
    Json run_for_stats(const std::string& command, const Words& more) const {
        const Words words{command, folder_ / "scene.json", "--size",  "12x9",
                          "-o",    folder_ / "out/",       "--stats", folder_ / "stats.json"};
        const Ended ended = run(joined(words, more));
        EXPECT_EQ(ended.code, 0) << ended.err;
        return Json::parse(read_bytes(folder_ / "stats.json"));
    }
    std::string mismatch(const Json& stats) const {
        const auto found = schema_.find_mismatch(stats);
        return found ? found->pointer + ": " + found->reason : "";
    }

  private:
    const JsonSchema schema_{Json::parse(read_bytes(source_folder() / "scenes/stats.schema.json"))};
};

TEST_F(StatsSchema, FitsTheFilesOfAllCommands) {
    for (const auto& [command, words] :
         std::vector<std::pair<std::string, Words>>{{"render", {"--frames", "1-3"}},
                                                    {"render", {"--frames", "2", "--light-step", "2", "--spp", "2"}},
                                                    {"render", {"--frames", "1", "--integrator", "path", "--spp", "2"}},
                                                    {"render", {"--frames", "1-2", "--budget", "1"}},
                                                    {"render", {"--frames", "1", "--verify", ".1"}},
                                                    {"render", {"--frames", "1", "--spp", "1", "--crop", "2,7,1,4"}},
                                                    {"maps", {"--frames", "1-2"}}}) {
        SCOPED_TRACE(testing::PrintToString(words));
        const Json stats = run_for_stats(command, words);
        EXPECT_EQ(mismatch(stats), "");
        const bool cropped = std::ranges::count(words, "--crop") == 1;
        EXPECT_EQ(stats["frames"][0]["window"], cropped ? Json({2, 7, 1, 4}) : Json());
        EXPECT_EQ(stats.contains("budget"), std::ranges::count(words, "--budget") == 1);
        EXPECT_EQ(stats.contains("verified"), std::ranges::count(words, "--verify") == 1);
    }
}

TEST_F(StatsSchema, RefusesKeysThatItDoesNotDescribe) {
    const Json stats = run_for_stats("render", {"--frames", "1", "--light-step", "2", "--spp", "2"});
    ASSERT_EQ(mismatch(stats), "");
    const auto refused = [&](const std::string& place) {
        Json changed = stats;
        changed[Json::json_pointer(place)]["another"] = 1;
        return mismatch(changed).starts_with(place);
    };
    for (const std::string place :
         {"", "/frames/0", "/frames/0/seconds", "/frames/0/rays", "/frames/0/cache", "/frames/0/keyframes/0",
          "/frames/0/keyframes/0/rays", "/frames/0/estimate", "/frames/0/plan/0", "/frames/0/plan/0/bound"})
        EXPECT_TRUE(refused(place)) << place;
    Json without = stats;
    without["frames"][0].erase("samples");
    EXPECT_NE(mismatch(without), "");
}

/// `aleph explain` describes what `aleph render` does with the same options.
TEST_F(StatsSchema, ExplainHasTheSettingsAndThePlanOfTheFile) {
    for (const Words& more :
         {Words{}, Words{"--error", "2", "--spp", "64"}, Words{"--light-step", "2", "--spp", "2"}}) {
        SCOPED_TRACE(testing::PrintToString(more));
        const Words frame = joined({"--frames", "2"}, more);
        const Json stats = run_for_stats("render", frame);
        const Ran explained =
            run_command(joined({"explain", folder_ / "scene.json", "--json", "--size", "12x9"}, frame));
        ASSERT_EQ(explained.code, 0);
        const Json description = Json::parse(explained.out);
        for (const Json& setting : description.at("settings"))
            EXPECT_EQ(setting.at("value"), stats.at("settings").at(setting.at("key"))) << setting;
        Json plan = description.at("plan");
        for (Json& effect : plan) effect.erase("frames");
        EXPECT_EQ(plan, stats.at("frames")[0].at("plan"));
    }
}

}  // namespace
}  // namespace aleph
