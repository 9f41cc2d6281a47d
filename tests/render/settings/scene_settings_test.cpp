// The table of settings, scene.schema.json and AUTHORING.md say the same about every render setting.

#include <fmt/ranges.h>

#include "engine/scene_file/scene_text.h"
#include "engine/scene_file/schema.h"
#include "render/settings/setting_table.h"
#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Json = nlohmann::ordered_json;

/// A number as people write it: 1024, 0.15.
Json short_number(double value) {
    return value == std::floor(value) ? Json(static_cast<std::int64_t>(value)) : Json(value);
}

Json default_of(const Setting& setting) {
    const SettingValue value = setting.get(RenderSettings());
    const double* const number = std::get_if<double>(&value);
    return number != nullptr ? short_number(*number) : setting_json(value);
}

/// "Least reach of a record (pixels)."
std::string sentence(const Setting& setting) {
    std::string text = setting.help;
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return setting.unit.empty() ? text + "." : fmt::format("{} ({}).", text, setting.unit);
}

/// Makes the schema that a setting must have.
Json schema_of(const Setting& setting) {
    Json schema{{"description", sentence(setting)}};
    switch (setting.type) {
        case SettingType::size: {
            schema["title"] = "text like \"640x480\", each number from 1 to 65536";
            schema["type"] = "string";
            // 1 to 65536
            const std::string side =
                "0*([1-9][0-9]{0,3}|[1-5][0-9]{4}|6[0-4][0-9]{3}|65[0-4][0-9]{2}|655[0-2][0-9]|6553[0-6])";
            schema["pattern"] = "^" + side + "x" + side + "$";
            break;
        }
        case SettingType::whole_number:
        case SettingType::number:
            schema["type"] = setting.type == SettingType::number ? "number" : "integer";
            schema["minimum"] = short_number(setting.min);
            schema["maximum"] = short_number(setting.max);
            break;
        case SettingType::choice:
            schema["enum"] = setting.choices;
            break;
        case SettingType::names: {
            const std::string name = fmt::format("({})", fmt::join(setting.choices, "|"));
            schema["title"] = fmt::format("names separated by commas, of {}", fmt::join(setting.choices, ", "));
            schema["type"] = "string";
            schema["pattern"] = "^ *(" + name + " *(, *" + name + " *)*)?$";
            break;
        }
        case SettingType::boolean:
            schema["type"] = "boolean";
            break;
    }
    schema["default"] = default_of(setting);
    return schema;
}

/// The values of a setting as the table of AUTHORING.md shows them.
std::string values_on_page(const Setting& setting) {
    switch (setting.type) {
        case SettingType::size:
            return fmt::format("WIDTHxHEIGHT, {:.0f} to {:.0f} each", setting.min, setting.max);
        case SettingType::whole_number:
            return fmt::format("whole number, {:.0f} to {:.0f}", setting.min, setting.max);
        case SettingType::number:
            return fmt::format("number, {:g} to {:g}", setting.min, setting.max);
        case SettingType::boolean:
            return "`true`, `false`";
        case SettingType::names:
            return "names of effects, with commas";
        case SettingType::choice:
            break;
    }
    std::string names;
    for (const std::string& name : setting.choices) names += fmt::format("{}`{}`", names.empty() ? "" : ", ", name);
    return names;
}

/// The table that AUTHORING.md has to show.
std::string table_on_page() {
    std::string text = "| key | values | unit | default | what it does |\n| --- | --- | --- | --- | --- |\n";
    for (const Setting& setting : setting_table()) {
        const Json value = default_of(setting);
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", setting.key, values_on_page(setting), setting.unit,
                            value.is_string() ? value.get<std::string>() : value.dump(), setting.help);
    }
    return text;
}

TEST(SceneSettings, TheSchemaHasTheTableOfSettings) {
    Json expected = Json::object();
    for (const Setting& setting : setting_table()) expected[setting.key] = schema_of(setting);
    std::ifstream file(source_folder() / "scenes" / "scene.schema.json");
    const Json found = Json::parse(file)["definitions"]["settings"]["properties"];
    EXPECT_EQ(found.dump(2), expected.dump(2)) << "replace the settings of scenes/scene.schema.json by the latter";
}

TEST(SceneSettings, AuthoringHasTheTableOfSettings) {
    const std::string page = read_bytes(source_folder() / "scenes" / "AUTHORING.md");
    const std::string expected = table_on_page();
    EXPECT_NE(page.find("\n" + expected + "\n"), std::string::npos)
        << "the table of settings in scenes/AUTHORING.md has to be\n"
        << expected;
}

/// Values on both sides of every limit, of every type.
std::vector<Json> probes(const Setting& setting) {
    std::vector<Json> values{true,      false, 0,         1,         -1,        0.5,     "",  "1",        "true",
                             "640x480", "0x0", "65536x1", "1x65537", "99999x1", "007x5", "x", "640x480 ", "-5x5"};
    for (const double limit : {setting.min, setting.max}) {
        for (const double step : {-1.0, 0.0, 1.0}) values.push_back(short_number(limit + step));
    }
    values.push_back(std::nextafter(setting.max, 1e300));
    for (const std::string& name : setting.choices) {
        values.push_back(name);
        values.push_back(name + " ");
    }
    return values;
}

SettingValue to_setting(const Json& value) {
    if (value.is_boolean()) return value.get<bool>();
    if (value.is_number()) return value.get<double>();
    return value.get<std::string>();
}

TEST(SceneSettings, TheSchemaAndTheCommandLineTakeTheSameValues) {
    int taken = 0, refused = 0;
    for (const Setting& setting : setting_table()) {
        for (const Json& value : probes(setting)) {
            const bool fits = find_mismatch(setting, to_setting(value)).empty();
            const Json file{{"aleph", 1}, {"settings", {{setting.key, value}}}};
            bool loads = true;
            try {
                read_scene_text(file.dump(), "a.json");
            } catch (const InputError& e) {
                loads = false;
                EXPECT_EQ(e.place(), "/settings/" + setting.key);
            }
            EXPECT_EQ(loads, fits) << setting.key << " = " << value.dump();
            ++(fits ? taken : refused);
        }
    }
    EXPECT_GT(taken, 70);
    EXPECT_GT(refused, 300);
}

TEST(SceneSettings, WhatTheRendererWritesComesBackThroughAFile) {
    RenderSettings settings;
    settings.picture.width = 123;
    settings.cache.accuracy = 0.07;
    settings.perception.guide = Guide::full;
    Scene scene;
    scene.source.settings = setting_map(settings);
    const Scene loaded = read_scene_text(write_scene_text(scene, "a.json"), "a.json").scene;
    EXPECT_EQ(loaded.source.settings, scene.source.settings);
    RenderSettings again;
    apply_settings(again, loaded.source.settings, "a.json");
    EXPECT_EQ(again, settings);
}

TEST(SceneSettings, NumbersOfTheSceneHaveALimitThatIsTold) {
    for (const auto& [key, limit] : {std::pair("viewing.display_white", "at most 1e+18"),
                                     {"exposure", "at most 1e+18"},
                                     {"viewing.persistence", "at most 1"}}) {
        Scene scene;
        SettingMap settings{{key, 1e30}};
        expect_refusal([&] { set_scene_numbers(scene, settings, "--set"); }, "--set", key, limit);
    }
}

}  // namespace
}  // namespace aleph
