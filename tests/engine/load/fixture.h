#pragma once
// Scene files in a folder of the test's own.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"

namespace aleph {

namespace fs = std::filesystem;

class LoadScene : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ =
            fs::path(testing::TempDir()) / (std::string("aleph_load_scene_") + test->name() + std::to_string(getpid()));
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "lib");
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    fs::path write_scene(const std::string& body) const { return write("scene.json", "{\"aleph\": 1, " + body + "}"); }

    void expect_refused(const fs::path& path, const std::string& place, const std::string& word) const {
        try {
            load_scene(path);
            ADD_FAILURE() << path << " was read";
        } catch (const InputError& error) {
            EXPECT_EQ(error.file(), path.string()) << error.what();
            EXPECT_EQ(error.place(), place) << error.what();
            EXPECT_NE(error.reason().find(word), std::string::npos) << error.what();
        }
    }

    fs::path folder_;
};

inline bool has_warning(const Scene& scene, const std::string& word) {
    for (const std::string& warning : scene.warnings) {
        if (warning.find(word) != std::string::npos) return true;
    }
    return false;
}

}  // namespace aleph
