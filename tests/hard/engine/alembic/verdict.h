#pragma once
// Loads archives that are broken on purpose, within limits of time and memory.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "tests/support/alembic_draft.h"
#include "tests/support/scratch_folder.h"

namespace aleph {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
inline constexpr double max_seconds = 2.0;
#else
inline constexpr double max_seconds = 60.0;
#endif

#ifndef __SANITIZE_ADDRESS__
inline long peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;
}
#endif

/// Loads and poses a file. Returns the message of the InputError, or nothing; any other exception fails the test.
inline std::string verdict(const std::filesystem::path& path) {
    const std::clock_t start = std::clock();  // of this process: others may keep the machine busy
    std::string message;
    try {
        const Scene scene = load_scene(path);
        pose(scene, 0.05);
    } catch (const InputError& error) {
        EXPECT_EQ(error.file(), path.string());
        EXPECT_LT(std::string(error.what()).size(), 1000u);
        message = error.what();
        EXPECT_FALSE(message.empty());
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, max_seconds) << path << ": " << message;
#ifndef __SANITIZE_ADDRESS__
    EXPECT_LT(peak_megabytes(), 512) << path << ": " << message;
#endif
    return message;
}

inline std::string verdict(const DraftBytes& bytes) {
    const ScratchFolder folder;
    return verdict(write_draft(folder / "bad.abc", bytes));
}

inline std::string verdict(const std::vector<DraftObject>& objects) {
    OgawaDraft draft;
    draft.times = {0.0, 1.0, 2.0, 3.0};
    return verdict(draft.finish(objects));
}

inline void expect_refused(const std::string& message, const std::string& word) {
    EXPECT_NE(message.find(word), std::string::npos) << "expected \"" << word << "\" in \"" << message << "\"";
}

inline const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

}  // namespace aleph
