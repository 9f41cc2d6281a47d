#pragma once
// Scene files in a folder of the test's own.

#include "engine/load/load_scene.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"
#include "tests/support/warnings.h"

namespace aleph {

namespace fs = std::filesystem;

class LoadScene : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_ / "lib"); }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    fs::path write_scene(const std::string& body) const { return write("scene.json", "{\"aleph\": 1, " + body + "}"); }

    void expect_refused(const fs::path& path, const std::string& place, const std::string& word) const {
        expect_refusal([&] { load_scene(path); }, path.string(), place, word);
    }

    const ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

}  // namespace aleph
