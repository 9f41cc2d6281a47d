#pragma once
// Loads drafts of glTF files from a folder of the test's own.

#include "engine/gltf/gltf.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"
#include "tests/support/warnings.h"

namespace aleph {

class GltfFixture : public testing::Test {
  protected:
    Scene load(GltfDraft draft) {
        write_text(folder_ / "scene.gltf", draft.to_text());
        return load_file("scene.gltf");
    }
    Scene load_file(const std::string& name) {
        Scene scene;
        append_gltf(folder_ / name, scene, no_index, 0);
        return scene;
    }
    ScratchFolder folder_;
};

}  // namespace aleph
