// The file that keeps the light of key moments: damaged, of something else, written twice.

#include "render/cache_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/atomic_file.h"
#include "engine/base/errors.h"
#include "engine/scene/scene_hash.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/shot_scenes.h"

namespace aleph {
namespace {

RenderSettings file_settings() {
    RenderSettings settings = shot_settings(10);
    settings.width = 24;
    settings.height = 18;
    settings.gather = 16;
    return settings;
}

/// Renders frame 3 with the file. @return the frame's bytes
std::string render_with(const std::filesystem::path& file, const Scene& scene, const RenderSettings& settings) {
    Sequence sequence(scene, settings);
    sequence.load_light(file);
    const std::string bytes = frame_bytes(sequence, scene, settings, 3);
    sequence.save_light(file);
    return bytes;
}

/// Why the file is refused.
std::string refusal(const std::filesystem::path& file, const Scene& scene, const RenderSettings& settings) {
    try {
        Sequence(scene, settings).load_light(file);
    } catch (const InputError& e) {
        EXPECT_EQ(e.file(), file.string());
        return e.reason();
    }
    ADD_FAILURE() << "the file was taken";
    return {};
}

TEST(CacheFile, IC22_FramesAreEqualWithAndWithoutIt) {
    const ScratchFolder folder;
    const Scene scene = make_shot_with_mover();
    const RenderSettings settings = file_settings();
    Sequence plain(scene, settings);
    const std::string expected = frame_bytes(plain, scene, settings, 3);
    EXPECT_TRUE(render_with(folder / "light", scene, settings) == expected) << "there was no file";
    const std::string written = read_bytes(folder / "light");
    EXPECT_TRUE(render_with(folder / "light", scene, settings) == expected) << "from the file";
    EXPECT_TRUE(read_bytes(folder / "light") == written) << "nothing was added";
    EXPECT_TRUE(render_with(folder / "other", scene, settings) == expected);
    EXPECT_TRUE(read_bytes(folder / "other") == written) << "by another process";

    Sequence loaded(scene, settings);
    loaded.load_light(folder / "light");
    EXPECT_TRUE(loaded.render(3).statistics.moments.empty()) << "computed again";
    RenderSettings more_samples = settings;
    more_samples.light_samples = 7;
    EXPECT_NO_THROW(Sequence(scene, more_samples).load_light(folder / "light"));
}

TEST(CacheFile, IC22_OtherScenesSettingsAndBuildsAreRefused) {
    const ScratchFolder folder;
    const Scene scene = make_shot_with_mover();
    const RenderSettings settings = file_settings();
    render_with(folder / "light", scene, settings);
    RenderSettings other = settings;
    other.seed = 7;
    EXPECT_THAT(refusal(folder / "light", scene, other), testing::HasSubstr("setting seed is 0, here 7"));
    other = settings;
    other.width = 32;
    EXPECT_THAT(refusal(folder / "light", scene, other), testing::HasSubstr("setting size is 24x18, here 32x18"));
    Scene changed = scene;
    changed.meshes[0].positions[0].x += 1e-6f;
    EXPECT_THAT(refusal(folder / "light", changed, settings), testing::HasSubstr("another scene"));
    changed = scene;
    changed.nodes[1].translation = glm::dvec3(0.0, 1.5, -2.9);
    EXPECT_THAT(refusal(folder / "light", changed, settings), testing::HasSubstr("another scene"));

    CacheFingerprint fingerprint = make_cache_fingerprint(scene, settings, {{0, 0}});
    fingerprint.build += "x";
    write_cache_file(folder / "light", fingerprint, {});
    EXPECT_THAT(refusal(folder / "light", scene, settings), testing::HasSubstr("another build"));
}

TEST(CacheFile, IC22_DamagedFilesAreRefused) {
    const ScratchFolder folder;
    const Scene scene = make_shot_with_mover();
    const RenderSettings settings = file_settings();
    render_with(folder / "light", scene, settings);
    const std::string good = read_bytes(folder / "light");
    for (const std::size_t size : {std::size_t{9}, std::size_t{60}, good.size() / 2, good.size() - 1}) {
        write_file(folder / "cut", good.substr(0, size));
        EXPECT_THAT(refusal(folder / "cut", scene, settings), testing::HasSubstr("damaged or not complete")) << size;
    }
    for (const std::size_t place : {std::size_t{8}, std::size_t{30}, good.size() / 2, good.size() - 1}) {
        std::string bad = good;
        bad[place] = static_cast<char>(bad[place] ^ 4);
        write_file(folder / "bad", bad);
        EXPECT_THAT(refusal(folder / "bad", scene, settings), testing::HasSubstr("damaged or not complete")) << place;
    }
    for (const std::string& text : {std::string(), std::string("{}"), std::string(200, 'x')}) {
        write_file(folder / "text", text);
        EXPECT_THAT(refusal(folder / "text", scene, settings), testing::HasSubstr("not a cache file"));
    }
    std::filesystem::create_directory(folder / "folder");
    refusal(folder / "folder", scene, settings);
}

/// Sizes inside the file cannot ask for memory that its length does not back, even if its checksum is right.
TEST(CacheFile, IC22_SizesAreCheckedBeforeMemoryIsTaken) {
    const ScratchFolder folder;
    const CacheFingerprint fingerprint{"b", "s", {}};
    write_cache_file(folder / "light", fingerprint, {{5, {IrradianceRecord{}}}});
    EXPECT_EQ(read_cache_file(folder / "light", fingerprint).at(5).size(), 1u);
    const std::string good = read_bytes(folder / "light");
    for (std::size_t place = 8; place < good.size() - 40; place += 8) {
        std::string bad = good.substr(0, good.size() - 40);
        bad[place + 7 < bad.size() ? place + 7 : place] = '\x7f';
        bad += hash_bytes(bad);
        write_file(folder / "bad", bad);
        try {
            read_cache_file(folder / "bad", fingerprint);  // a changed record is no damage
        } catch (const InputError&) {
        }
    }
}

TEST(CacheFile, IC22_NeedsKeyMoments) {
    RenderSettings settings = file_settings();
    settings.light_step = 0;
    EXPECT_THAT(refusal("light", make_shot(), settings), testing::HasSubstr("needs key moments"));
    EXPECT_THROW(Sequence(make_shot(), file_settings()).save_light("light"), std::logic_error);
}

}  // namespace
}  // namespace aleph
