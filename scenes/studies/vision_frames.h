#pragma once
// Tables of what the maps of the three models of vision differ in, for frames of scenes.

#include <string>
#include <vector>

#include "scenes/studies/study_options.h"

namespace aleph {

/// Prints them, by image velocity.
/// @param frames  SCENE@FRAME, where a name without a suffix is a folder of scenes/
/// @throws InputError for a scene or frame that cannot be read
void print_vision_frames(const std::vector<std::string>& frames, const StudyOptions& options, bool markdown);

}  // namespace aleph
