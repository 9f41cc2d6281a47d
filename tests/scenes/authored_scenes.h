#pragma once
// Loading the scenes in scenes/, querying them, and running their generators.

#include <cstdlib>

#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/seen_motion.h"
#include "tests/support/test.h"

namespace aleph {

inline const std::filesystem::path scenes_folder = source_folder() / "scenes";

/// The scene in a folder; loaded once.
inline const Scene& loaded(const std::string& name) {
    static std::map<std::string, Scene> cache;
    if (!cache.contains(name)) cache[name] = load_scene(scenes_folder / name / "scene.json");
    return cache[name];
}

inline glm::dvec3 origin_of(const ScenePose& frame, int node) {
    return frame.world[node][3];
}

/// First hits of a frame and their motion to the next frame.
inline SeenMotion compute_motion(const Scene& scene, int frame, int width, int height) {
    return {scene, scene.film.frame_rate.seconds_of(frame), scene.film.frame_rate.seconds_of(frame + 1), width, height};
}

/// Every file that make_scenes writes equals the one in scenes/, and the folders hold no other scene files and
/// textures.
/// @param files  number of files that the program writes
inline void expect_generated(std::size_t files) {
    namespace fs = std::filesystem;
    const ScratchFolder made;
    ASSERT_EQ(std::system(fmt::format("\"{}\" \"{}\"", program_path("make_scenes"), made.path().string()).c_str()), 0);
    std::set<fs::path> names, kept;
    for (const auto& entry : fs::recursive_directory_iterator(made.path())) {
        if (!entry.is_regular_file()) continue;
        const fs::path name = fs::relative(entry.path(), made.path());
        EXPECT_TRUE(read_bytes(entry.path()) == read_bytes(scenes_folder / name)) << name;
        names.insert(name);
    }
    for (const auto& folder : fs::directory_iterator(made.path())) {
        const fs::path name = folder.path().filename();
        if (fs::exists(scenes_folder / name / "scene.json")) kept.insert(name / "scene.json");
        if (!fs::exists(scenes_folder / name / "textures")) continue;
        for (const auto& entry : fs::directory_iterator(scenes_folder / name / "textures"))
            kept.insert(name / "textures" / entry.path().filename());
    }
    EXPECT_EQ(names, kept);
    EXPECT_EQ(names.size(), files);
}

/// The scene that was read equals the one that the program made, except for its file name.
inline void expect_same_scene(Scene read, const Scene& made) {
    EXPECT_TRUE(read.source.warnings.empty());
    read.source.file.clear();
    EXPECT_TRUE(read.nodes == made.nodes);
    EXPECT_TRUE(read.meshes == made.meshes);
    EXPECT_TRUE(read.cages == made.cages);
    EXPECT_TRUE(read.materials == made.materials);
    EXPECT_TRUE(read.images == made.images);
    EXPECT_TRUE(read == made);
}

}  // namespace aleph
