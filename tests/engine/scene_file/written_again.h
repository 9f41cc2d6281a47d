#pragma once
// A scene after it was written as a scene file and read again.

#include "engine/scene_file/scene_text.h"

namespace aleph {

inline Scene again(const Scene& scene) {
    return read_scene_text(write_scene_text(scene, "test.json"), "test.json").scene;
}

}  // namespace aleph
