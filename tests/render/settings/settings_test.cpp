// Render settings: every key there and back, and a refusal that names key and values for everything else.

#include "render/settings/setting_table.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A value other than the default for every key.
const std::map<std::string, SettingValue>& other_values() {
    static const std::map<std::string, SettingValue> values{{"size", "320x200"},
                                                            {"seed", 4294967295.0},
                                                            {"guide", "full"},
                                                            {"estimate", "flat"},
                                                            {"motion", "image"},
                                                            {"vision", "castle"},
                                                            {"bands", "measured"},
                                                            {"grid", "center"},
                                                            {"neutral_opponent", true},
                                                            {"adapter", "scale-add"},
                                                            {"adapter_k", 50.0},
                                                            {"accuracy", 0.3},
                                                            {"gather", 64.0},
                                                            {"bounces", 0.0},
                                                            {"spp", 4.0},
                                                            {"sampling", "variance"},
                                                            {"integrator", "path"},
                                                            {"path_depth", 5.0},
                                                            {"light_samples", 7.0},
                                                            {"min_radius_pixels", 2.5},
                                                            {"error", 0.5},
                                                            {"filter", "box"},
                                                            {"stopping", "pixel"},
                                                            {"light_step", 5.0},
                                                            {"subdivision_level", 3.0},
                                                            {"plan", "off"},
                                                            {"force", "caustics"},
                                                            {"forbid", "direct_light,alpha"}};
    return values;
}

/// Returns the message of an error, and expects it to name source and key.
std::string refusal(const std::string& key, const SettingValue& value) {
    RenderSettings settings;
    const Refusal found = find_refusal([&] { apply_settings(settings, {{key, value}}, "--set"); });
    expect_refusal(found, "--set", key, "");
    EXPECT_EQ(settings, RenderSettings()) << "changed by a refused " << key;
    return found.reason;
}

TEST(Settings, NoEffectIsForcedAndForbidden) {
    RenderSettings settings;
    apply_settings(settings, {{"force", "caustics"}, {"forbid", "alpha"}}, "scene.json");
    for (const SettingMap& map :
         {SettingMap{{"force", "alpha,caustics"}, {"forbid", "textures,alpha"}}, SettingMap{{"forbid", "caustics"}}}) {
        RenderSettings changed = settings;
        const Refusal found = find_refusal([&] { apply_settings(changed, map, "--set"); });
        expect_refusal(found, "--set", "forbid", "\"force\" too");
    }
    EXPECT_NO_THROW(apply_settings(settings, {{"force", ""}, {"forbid", "caustics"}}, "--set"));
}

TEST(Settings, EveryKeyRoundTrips) {
    std::set<std::string> keys;
    for (const Setting& setting : setting_table()) {
        keys.insert(setting.key);
        EXPECT_FALSE(setting.help.empty());
        ASSERT_TRUE(other_values().contains(setting.key)) << setting.key;
        RenderSettings settings;
        apply_settings(settings, {{setting.key, other_values().at(setting.key)}}, "test");
        const SettingMap map = setting_map(settings);
        EXPECT_EQ(map.at(setting.key), other_values().at(setting.key)) << setting.key;
        // One key changes one thing.
        const SettingMap defaults = setting_map(RenderSettings());
        for (const auto& [name, value] : map) {
            if (name != setting.key && setting.key != "error") {
                EXPECT_EQ(value, defaults.at(name)) << setting.key << " changed " << name;
            }
        }
        RenderSettings again;
        apply_settings(again, map, "test");
        EXPECT_EQ(again, settings) << setting.key;
    }
    EXPECT_EQ(keys.size(), setting_table().size()) << "a key is listed twice";
    EXPECT_EQ(keys.size(), setting_map(RenderSettings()).size());
}

TEST(Settings, AnErrorChoosesWhatCostsAndTheRestOverridesIt) {
    RenderSettings settings;
    settings.sampling.spp = 7;
    apply_settings(settings, {{"error", 2.0}, {"gather", 100.0}}, "test");
    EXPECT_EQ(settings.sampling.rule, Sampling::threshold);
    EXPECT_EQ(settings.guide.adapter, Adapter::none);
    EXPECT_DOUBLE_EQ(settings.cache.accuracy, 0.07);
    EXPECT_EQ(settings.light.bounces, 16);
    EXPECT_EQ(settings.sampling.spp, 4096);
    EXPECT_EQ(settings.cache.gather, 100);
    EXPECT_EQ(settings.cache.light_step, 0);
    apply_settings(settings, {{"spp", 64.0}}, "test");  // as the command line after the scene's file
    EXPECT_EQ(settings.sampling.spp, 64);
    EXPECT_EQ(settings.error, 2.0);
    RenderSettings strict;
    apply_settings(strict, {{"error", 0.5}}, "test");
    EXPECT_DOUBLE_EQ(strict.cache.accuracy, 0.035);
    // 0 changes nothing else.
    RenderSettings plain;
    apply_settings(plain, {{"error", 0.0}}, "test");
    EXPECT_EQ(plain, RenderSettings());
    EXPECT_EQ(refusal("error", -1.0), "expected a number from 0 to 1000; found -1");
    EXPECT_EQ(refusal("error", "much"), "expected a number from 0 to 1000; found \"much\"");
}

TEST(Settings, KnowWhereTheyComeFrom) {
    const auto from = [](const SettingMap& scene, const SettingMap& given) {
        std::map<std::string, std::string> texts;
        for (const SettingOrigin& origin : list_origins(scene, given))
            texts[origin.key] = setting_text(origin.value) + " " + origin.from;
        EXPECT_EQ(texts.size(), setting_table().size());
        return texts;
    };
    // Nothing chooses the work: an error of 1 does.
    auto texts = from({{"guide", std::string("none")}}, {{"seed", 5.0}, {"exposure", 2.0}});
    EXPECT_EQ(texts["guide"], "none scene");
    EXPECT_EQ(texts["seed"], "5 option");
    EXPECT_EQ(texts["error"], "1 default");
    EXPECT_EQ(texts["bounces"], "16 error");
    EXPECT_EQ(texts["filter"], "blackman-harris default");
    // An option's error overrides what the scene file says, and options beside it override the error.
    texts = from({{"bounces", 3.0}, {"error", 4.0}}, {{"error", 2.0}, {"spp", 64.0}});
    EXPECT_EQ(texts["error"], "2 option");
    EXPECT_EQ(texts["bounces"], "16 error");
    EXPECT_EQ(texts["spp"], "64 option");
    texts = from({{"bounces", 3.0}}, {{"spp", 8.0}});
    EXPECT_EQ(texts["error"], "0 default");
    EXPECT_EQ(texts["bounces"], "3 scene");
    EXPECT_EQ(texts["accuracy"], "0.15 default");
}

TEST(Settings, FieldsReceiveWhatKeysSay) {
    RenderSettings s;
    apply_settings(s, SettingMap(other_values().begin(), other_values().end()), "test");
    EXPECT_EQ(s.picture.width, 320);
    EXPECT_EQ(s.picture.height, 200);
    EXPECT_EQ(s.seed, 4294967295u);
    EXPECT_EQ(s.perception.guide, Guide::full);
    EXPECT_EQ(s.perception.vision, &castle_vision());
    EXPECT_EQ(s.perception.bands, Bands::measured);
    EXPECT_EQ(s.perception.grid, SaliencyGrid::center);
    EXPECT_TRUE(s.perception.neutral_opponent);
    EXPECT_EQ(s.guide.estimate, EstimateKind::flat);
    EXPECT_EQ(s.guide.adapter, Adapter::scale_add);
    EXPECT_EQ(s.guide.adapter_k, 50.0);
    EXPECT_EQ(s.cache.accuracy, 0.3);
    EXPECT_EQ(s.cache.gather, 64);
    EXPECT_EQ(s.light.bounces, 0);
    EXPECT_EQ(s.light.path_depth, 5);
    EXPECT_EQ(s.light.integrator, Integrator::path);
    EXPECT_EQ(s.sampling.spp, 4);
    EXPECT_EQ(s.light.light_samples, 7);
    EXPECT_EQ(s.cache.min_radius_pixels, 2.5);
    EXPECT_EQ(s.cache.light_step, 5);
    EXPECT_EQ(s.picture.subdivision_level, 3);
}

TEST(Settings, ChoicesNameWhatIsAllowed) {
    EXPECT_EQ(refusal("guide", "everything"), "expected one of none, spatial, full, saliency; found \"everything\"");
    EXPECT_EQ(refusal("guide", 1.0), "expected one of none, spatial, full, saliency; found 1");
    EXPECT_EQ(refusal("estimate", ""), "expected one of flat, direct; found \"\"");
    EXPECT_EQ(refusal("bands", "Printed"), "expected one of printed, measured; found \"Printed\"");
    EXPECT_EQ(refusal("grid", true), "expected one of full, center; found true");
    EXPECT_EQ(refusal("adapter", "scale_add"), "expected one of compress, scale-add, none; found \"scale_add\"");
    EXPECT_EQ(refusal("neutral_opponent", "yes"), "expected true or false; found \"yes\"");
    EXPECT_EQ(refusal("neutral_opponent", 1.0), "expected true or false; found 1");
    EXPECT_EQ(refusal("motion", "none"), "expected one of model, raster, flow, image, census; found \"none\"");
    EXPECT_EQ(refusal("sampling", "random"),
              "expected one of uniform, consecutive, variance, protocol, threshold; found \"random\"");
    EXPECT_EQ(refusal("integrator", 3.0), "expected one of cache, path; found 3");
    EXPECT_EQ(refusal("bounces", 1001.0), "expected a whole number from 0 to 1000; found 1001");
}

TEST(Settings, MC20_NumbersOutOfRangeOfAnyKind) {
    const std::map<std::string, std::vector<double>> bad{{"accuracy", {-0.01, 1.01, not_a_number, infinity, -infinity}},
                                                         {"adapter_k", {0.0, -1.0, not_a_number, infinity}},
                                                         {"gather", {-1.0, -4.0, 1048577.0, 10.5, not_a_number}},
                                                         {"bounces", {-1.0, 0.5, not_a_number}},
                                                         {"path_depth", {0.0, 2.5, not_a_number}},
                                                         {"spp", {0.0, 1.5, 65537.0, not_a_number, infinity}},
                                                         {"light_samples", {0.0, not_a_number, 1e9}},
                                                         {"seed", {-1.0, 4294967296.0, 0.5, not_a_number}},
                                                         {"min_radius_pixels", {0.0, -1.0, 1001.0, not_a_number}},
                                                         {"light_step", {-1.0, 1001.0, 2.5, not_a_number}},
                                                         {"subdivision_level", {-2.0, 11.0, 0.5, not_a_number}}};
    for (const auto& [key, values] : bad) {
        for (const double value : values) EXPECT_NE(refusal(key, value).find(" from "), std::string::npos) << key;
        EXPECT_NE(refusal(key, "1").find(" from "), std::string::npos) << key << " as text";
        EXPECT_NE(refusal(key, true).find(" from "), std::string::npos) << key << " as true";
    }
    EXPECT_EQ(refusal("accuracy", 2.0), "expected a number from 0 to 1; found 2");
}

TEST(Settings, Sizes) {
    for (const char* text : {"", "x", "640", "640x", "x480", "640x480x3", "640X480", " 640x480", "640x480 ", "-1x5",
                             "0x5", "5x0", "1e3x5", "70000x1", "99999999999x1", "6.5x4", "640*480"}) {
        EXPECT_NE(refusal("size", text).find("WIDTHxHEIGHT"), std::string::npos) << text;
    }
    EXPECT_NE(refusal("size", 640.0).find("WIDTHxHEIGHT"), std::string::npos);
    EXPECT_NE(refusal("size", "65536x65536").find("2^28"), std::string::npos);
    RenderSettings settings;
    apply_settings(settings, {{"size", "1x65536"}}, "test");
    EXPECT_EQ(settings.picture.height, 65536);
}

TEST(Settings, UnknownKeysListTheKnown) {
    RenderSettings settings;
    const Refusal found = find_refusal([&] { apply_settings(settings, {{"acuracy\x01", 0.1}}, "scene.json"); });
    EXPECT_EQ(found.file, "scene.json");
    EXPECT_NE(found.place.find("acuracy"), std::string::npos);
    EXPECT_EQ(found.place.find('\x01'), std::string::npos);
    for (const Setting& setting : setting_table()) EXPECT_NE(found.reason.find(setting.key), std::string::npos);
}

TEST(Settings, ValidateChecksStructsFilledByHand) {
    RenderSettings settings;
    EXPECT_NO_THROW(validate(settings));
    void (*const changes[])(RenderSettings&) = {[](RenderSettings& s) { s.cache.accuracy = not_a_number; },
                                                [](RenderSettings& s) { s.picture.width = 0; },
                                                [](RenderSettings& s) { s.cache.gather = -1; },
                                                [](RenderSettings& s) { s.guide.adapter = static_cast<Adapter>(9); },
                                                [](RenderSettings& s) { s.perception.vision = nullptr; }};
    for (const auto change : changes) {
        RenderSettings wrong;
        change(wrong);
        EXPECT_THROW(validate(wrong), InputError);
    }
    const OnesVision own;
    settings.perception.vision = &own;
    EXPECT_NO_THROW(validate(settings));
    EXPECT_EQ(setting_map(settings).at("vision"), SettingValue("ones"));
    EXPECT_EQ(refusal("vision", "ones"), "expected one of thesis, laird, castle; found \"ones\"");
}

TEST(Settings, ParseTellsTextNumbersAndTruth) {
    SettingMap map;
    for (const char* text :
         {"a=1", "b=-2.5e3", "c=true", "d=false", "e=640x480", "f=", "g=1=2", "h= 1", "i=1,5", "j=0x10", "a=3"}) {
        parse_setting(text, map);
    }
    EXPECT_EQ(map, (SettingMap{{"a", 3.0},  // the last one counts
                               {"b", -2500.0},
                               {"c", true},
                               {"d", false},
                               {"e", "640x480"},
                               {"f", ""},
                               {"g", "1=2"},
                               {"h", " 1"},
                               {"i", "1,5"},
                               {"j", "0x10"}}));
    EXPECT_THROW(parse_setting("accuracy", map), InputError);
    EXPECT_THROW(parse_setting("=1", map), InputError);
}

}  // namespace
}  // namespace aleph
