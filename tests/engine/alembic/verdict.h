#pragma once
// Loads archives that are broken on purpose, within the limits of memory.

#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "tests/support/files/alembic_draft.h"
#include "tests/support/files/load_cost.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {

/// Loads and poses a file. Returns the message of the InputError, or nothing; any other exception fails the test.
inline std::string verdict(const std::filesystem::path& path) {
    const LoadCost cost = load_cost([&] { pose(load_scene(path), 0.05); });
    const std::string& message = cost.refusal.message;
    if (cost.refused()) {
        EXPECT_EQ(cost.refusal.file, path.string());
    }
    expect_bounded(cost, path.string() + ": " + message);
    EXPECT_LT(message.size(), 1000u);
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

}  // namespace aleph
