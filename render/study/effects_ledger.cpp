#include "render/study/effects_ledger.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "render/frame/sequence.h"
#include "render/study/search_study.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* complete = "all effects";

std::string variant_without(const char* effect) {
    return std::string("without ") + effect;
}

/// The decision of a scene's frames about an effect, and their largest bound.
void add_decision(const VariantResult& all, std::size_t effect, LedgerEntry& entry) {
    for (const FrameResult& frame : all.frames) {
        const Json plan = Json::parse(frame.plan);
        if (effect >= plan.size()) continue;
        const std::string decision = plan[effect].at("decision");
        entry.decision = entry.decision.empty() || entry.decision == decision ? decision : "mixed";
        const Json& bound = plan[effect].at("bound");
        const bool known = !bound.is_null() && bound.at("thresholds").is_number();
        // std::fmax would drop what is not known.
        const double thresholds = known ? bound.at("thresholds").get<double>() : std::nan("");
        if (!(entry.bound >= thresholds)) entry.bound = thresholds;
    }
}

Json to_json(const MeasuredValue& value) {
    Json json{{"value", value.value}};
    if (value.error) json["error"] = *value.error;
    return json;
}

Json to_json(const std::optional<MeasuredValue>& value) {
    return value ? to_json(*value) : Json();
}

}  // namespace

std::vector<StudyVariant> list_ledger_variants(const std::vector<PreparedStudyScene>& scenes, const Study& study) {
    EffectSet simulated, allowed, forced;
    for (const PreparedStudyScene& scene : scenes) {
        const SceneWithSettings own = with_settings_of(scene, study, {});
        for (const EffectName& effect : effect_list) {
            if (!own.settings.effects.forbid.contains(effect.id)) allowed.add(effect.id);
            if (own.settings.effects.force.contains(effect.id)) forced.add(effect.id);
        }
        Sequence sequence(own.scene, own.settings);
        for (const int frame : scene.frames) {
            const EffectsPlan plan = sequence.plan(frame);
            for (const EffectName& effect : effect_list) {
                if (!plan.skips(effect.id)) simulated.add(effect.id);
            }
        }
    }
    std::string others;  // that every scene forbids
    for (const EffectName& effect : effect_list) {
        if (!allowed.contains(effect.id)) others += std::string(",") + effect.name;
    }
    std::vector<StudyVariant> variants{{complete, {}}};
    for (const EffectName& effect : effect_list) {
        if (!simulated.contains(effect.id)) continue;
        StudyVariant without{.name = variant_without(effect.name), .settings = {}, .forbids_more = true};
        without.settings["forbid"] = effect.name + others;
        if (forced.contains(effect.id)) {
            EffectSet left = forced;
            left.remove(effect.id);
            without.settings["force"] = format_effects(left);
        }
        variants.push_back(std::move(without));
    }
    return variants;
}

std::vector<SceneLedger> make_ledger(const PreparedStudy& prepared, const StudyResults& results) {
    std::vector<SceneLedger> ledgers;
    for (const PreparedStudyScene& scene : prepared.scenes) {
        const std::vector<VariantResult> variants = variants_of_scene(results, scene.name);
        const auto find = [&](const std::string& name) {
            return std::ranges::find(variants, name, &VariantResult::name);
        };
        const VariantResult& all = *find(complete);
        SceneLedger& ledger = ledgers.emplace_back();
        ledger.scene = scene.name;
        ledger.seconds = all.metrics.at("processor_seconds");
        ledger.seen = all.metrics.at("share_seen");
        for (std::size_t i = 0; i < effect_count; ++i) {
            LedgerEntry& entry = ledger.entries.emplace_back();
            entry.effect = effect_list[i].name;
            add_decision(all, i, entry);
            const auto without = find(variant_without(effect_list[i].name));
            if (without == variants.end() || entry.decision == "skip") continue;
            entry.seen = without->metrics.at("share_seen");
            MeasuredValue& saved = entry.seconds.emplace(without->metrics.at("processor_seconds"));
            saved.value = ledger.seconds.value - saved.value;
            if (saved.error) saved.error = std::hypot(*saved.error, ledger.seconds.error.value_or(0.0));
        }
    }
    return ledgers;
}

Json to_json(const std::vector<SceneLedger>& ledgers) {
    Json json = Json::array();
    for (const SceneLedger& ledger : ledgers) {
        Json effects = Json::array();
        for (const LedgerEntry& entry : ledger.entries) {
            effects.push_back({{"effect", entry.effect},
                               {"decision", entry.decision},
                               {"bound", entry.bound},
                               {"seconds", to_json(entry.seconds)},
                               {"seen", to_json(entry.seen)}});
        }
        json.push_back({{"scene", ledger.scene},
                        {"seconds", to_json(ledger.seconds)},
                        {"seen", to_json(ledger.seen)},
                        {"effects", effects}});
    }
    return json;
}

}  // namespace aleph
