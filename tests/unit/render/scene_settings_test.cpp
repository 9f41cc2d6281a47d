// The scene file's schema and the renderer know the same settings.

#include <gtest/gtest.h>

#include "engine/base/errors.h"
#include "engine/scene_file/scene_text.h"
#include "engine/scene_file/schema.h"
#include "render/settings.h"

namespace aleph {
namespace {

TEST(SceneSettings, EveryKeyOfTheRendererIsInTheSchema) {
    const nlohmann::json& known = scene_schema()["definitions"]["settings"]["properties"];
    for (const SettingKey& key : setting_keys()) EXPECT_TRUE(known.contains(key.name)) << key.name;
}

TEST(SceneSettings, WhatTheRendererWritesComesBackThroughAFile) {
    RenderSettings settings;
    settings.width = 123;
    settings.accuracy = 0.07;
    settings.perception.guide = Guide::full;
    Scene scene;
    scene.settings = setting_map(settings);
    const Scene loaded = read_scene_text(write_scene_text(scene, "a.json"), "a.json").scene;
    EXPECT_EQ(loaded.settings, scene.settings);
    RenderSettings again;
    apply_settings(again, loaded.settings, "a.json");
    EXPECT_EQ(again, settings);
}

}  // namespace
}  // namespace aleph
