#pragma once
// A study with its scenes loaded and its settings checked.

#include <string>
#include <vector>

#include "render/settings/settings.h"
#include "render/study/metric_table.h"
#include "render/study/study.h"

namespace aleph {

/// A scene as one variant or viewer has it.
struct SceneWithSettings {
    Scene scene;
    RenderSettings settings;
};

struct PreparedStudyScene {
    std::string name;  ///< of its folder or file: "pool"
    Scene scene;
    std::vector<int> frames;
};

struct PreparedStudy {
    Study study;
    std::vector<StudyVariant> variants;
    std::vector<Metric> metrics;
    std::vector<PreparedStudyScene> scenes;
    std::vector<StudyVariant> candidates{};  ///< of its search
};

/// "pool" for pool/scene.json, else the name of the file without its extension.
std::string name_scene(const std::filesystem::path& file);

/// @throws InputError naming the source, if a setting has no such name or value
void check_settings(SettingMap settings, const std::string& source);

/// Loads the scenes and checks every setting of every variant and viewer, before anything is rendered.
/// @throws InputError: a scene or a setting that is wrong, two scenes of one name, or a sweep of `size` or `seed`
PreparedStudy prepare_study(Study study);

/// The scene with the settings of its file, of the study, and `more` in their places.
/// @throws InputError
SceneWithSettings with_settings_of(const PreparedStudyScene& scene, const Study& study, const SettingMap& more);

}  // namespace aleph
