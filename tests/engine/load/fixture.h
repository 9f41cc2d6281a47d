#pragma once
// Scene files in a folder of the test's own.

#include "engine/load/load_scene.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"
#include "tests/support/warnings.h"

namespace aleph {

namespace fs = std::filesystem;

/// A triangle (0,0,0) (1,0,0) (0,1,0) under the node "mover", which goes from x = 0 to x = 10 m in one second.
inline GltfDraft moving_triangle() {
    GltfDraft draft = triangle_draft();
    draft.json["nodes"][0]["name"] = "mover";
    draft.animate(0, "translation", {0, 1}, {0, 0, 0, 10, 0, 0});
    return draft;
}

class LoadScene : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_ / "lib"); }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    fs::path write_scene(const std::string& body) const { return write("scene.json", "{\"aleph\": 1, " + body + "}"); }

    /// A scene with light, so that nothing is added and no warning given.
    Scene load_lit(const std::string& body) const {
        return load_scene(write_scene("\"environment\": [1, 1, 1], " + body));
    }

    void expect_saved_and_loaded_alike(const Scene& scene) const {
        save_scene(scene, folder_ / "again.json");
        Scene again = load_scene(folder_ / "again.json");
        again.source.file = scene.source.file;
        EXPECT_TRUE(again == scene);
    }

    void expect_refused(const fs::path& path, const std::string& place, const std::string& word) const {
        expect_refusal([&] { load_scene(path); }, path.string(), place, word);
    }

    const ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

}  // namespace aleph
