#pragma once
// Study files: JSON, checked with scenes/studies/study.schema.json.

#include <filesystem>
#include <string_view>

#include "render/study/study.h"

namespace aleph {

/// Returns whether a file is a study, and no scene: a .json file whose root has a list `scenes`.
/// @throws InputError if it is a .json file that cannot be read
bool is_study(const std::filesystem::path& file);

/// A study file. Paths of scenes are taken from its folder. Comments are allowed.
/// @throws InputError with the JSON pointer of what is wrong; settings are checked when the study runs
Study load_study(const std::filesystem::path& file);

/// The text of a study file.
/// @param file  for messages and for relative paths
/// @throws InputError
Study parse_study(std::string_view text, const std::filesystem::path& file);

/// The thesis's model of vision at its own viewing conditions, as settings have it.
StudyViewer default_viewer();

}  // namespace aleph
