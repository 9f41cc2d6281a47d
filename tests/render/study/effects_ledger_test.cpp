// The ledger of effects: which variants it asks for, and what it tells of each effect.

#include "render/study/effects_ledger.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "render/study/study.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Study ledger_study(const char* more = "") {
    const std::string scene = (source_folder() / "scenes/cornell/scene.json").string();
    return parse_study(fmt::format(R"({{"scenes": [{{"scene": "{}", "frames": "3"}}], "size": "20x15", "effects": true,
        "settings": {{"light_step": 0, "error": 2{}}}, "reference": {{"passes": 2, "spp": 1024}}}})",
                                   scene, more),
                       "ledger.json");
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
