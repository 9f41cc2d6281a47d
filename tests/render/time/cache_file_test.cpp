// The file that keeps the light of lighting keyframes: damaged, of something else, written twice.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>

#include "engine/base/atomic_file.h"
#include "engine/scene/scene_hash.h"
#include "render/time/cache_file.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

RenderSettings file_settings() {
    RenderSettings settings = shot_settings(10);
    set_size(settings, 24, 18);
    settings.cache.gather = 16;
    return settings;
}

/// Renders a frame with the file. @return the frame's bytes
std::string render_with(const std::filesystem::path& file, const Scene& scene, const RenderSettings& settings,
                        std::int64_t frame = 3) {
    Sequence sequence(scene, settings);
    sequence.load_light(file);
    const std::string bytes = frame_bytes(sequence, scene, settings, frame);
    sequence.save_light();
    return bytes;
}

/// Why the file is refused.
std::string refusal(const std::filesystem::path& file, const Scene& scene, const RenderSettings& settings) {
    const Refusal found = find_refusal([&] { Sequence(scene, settings).load_light(file); });
    EXPECT_EQ(found.file, file.string()) << found.message;
    return found.reason;
}

struct CacheFile : testing::Test {
    const ScratchFolder folder;
    const Scene scene = make_shot_with_mover();
    const RenderSettings settings = file_settings();
};

TEST_F(CacheFile, IC22_FramesAreEqualWithAndWithoutIt) {
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
    EXPECT_TRUE(loaded.render(3).statistics.keyframes.empty()) << "computed again";
    RenderSettings more_samples = settings;
    more_samples.light.light_samples = 7;
    EXPECT_NO_THROW(Sequence(scene, more_samples).load_light(folder / "light"));
    RenderSettings exact = settings;
    exact.effects.force.add(Effect::caustics);
    EXPECT_THROW(Sequence(scene, exact).load_light(folder / "light"), InputError) << "its caustics are blurred";
}

TEST_F(CacheFile, IC22_AFileThatCannotBeWrittenServesWhatItHas) {
    const Fingerprint print = make_cache_fingerprint(scene, settings, list_camera_shots(scene, ""));
    std::filesystem::create_directory(folder / "sealed");
    write_cache_file(folder / "sealed/light", print, {{3, {}}});
    ::chmod(folder.path().c_str(), 0755);
    ::chmod((folder / "sealed/light").c_str(), 0444);
    ::chmod((folder / "sealed").c_str(), 0555);
    LightStore store(folder / "sealed/light", print);
    const uid_t user = ::geteuid();
    ASSERT_EQ(::seteuid(user == 0 ? 65534 : user), 0);  // root may write anywhere
    std::string missing;
    try {
        EXPECT_TRUE(store.find(3).has_value());
        store.save();
        store.find(4);
    } catch (const OutputError& e) {
        missing = e.what();
    }
    ASSERT_EQ(::seteuid(user), 0);
    EXPECT_THAT(missing, testing::HasSubstr("Permission denied")) << "before the keyframe is computed";
    ::chmod((folder / "sealed").c_str(), 0755);
}

TEST_F(CacheFile, IC22_ItKeepsLightOfFurtherBounces) {
    const Scene walk = make_shot_with_moving_camera();
    RenderSettings several = settings;
    several.light.bounces = 3;
    Sequence plain(walk, several);
    const std::string expected = frame_bytes(plain, walk, several, 3);
    EXPECT_TRUE(render_with(folder / "light", walk, several) == expected) << "there was no file";
    EXPECT_TRUE(render_with(folder / "light", walk, several) == expected) << "from the file";
}

TEST_F(CacheFile, IC22_AFolderKeepsAFileForEachKeyframe) {
    Sequence plain(scene, settings);
    const std::string expected = frame_bytes(plain, scene, settings, 3);
    const std::filesystem::path light = folder / "some/light/";
    EXPECT_TRUE(render_with(light, scene, settings) == expected) << "there was no folder";
    const auto count = [&] {
        return std::distance(std::filesystem::directory_iterator(light), std::filesystem::directory_iterator());
    };
    const auto files = count();
    EXPECT_GE(files, 2);
    Sequence loaded(scene, settings);
    loaded.load_light(light);
    EXPECT_TRUE(frame_bytes(loaded, scene, settings, 3) == expected);
    EXPECT_TRUE(loaded.render(3).statistics.keyframes.empty()) << "computed again";
    RenderSettings other = settings;
    other.cache.gather = 24;
    EXPECT_NO_THROW(render_with(light, scene, other)) << "beside it";
    EXPECT_EQ(count(), 2 * files);
    const auto file = *std::filesystem::directory_iterator(light);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
    const auto use = [&](const RenderSettings& with) { render_with(light, scene, with); };
    const Refusal cut = find_refusal([&] { use(settings), use(other); });
    EXPECT_EQ(cut.file, file.path().string());
}

/// Not a test: a process that renders a frame with the file again and again, and writes its letter to descriptor 3 each
/// time, until nobody reads it.
TEST_F(CacheFile, DISABLED_RenderForever) {
    const char* job = std::getenv("ALEPH_TEST_JOB");  // letter, frame, path
    ASSERT_NE(job, nullptr);
    ::signal(SIGPIPE, SIG_IGN);
    do render_with(job + 4, scene, settings, std::atoi(job + 1));
    while (::write(3, job, 1) == 1);
}

/// Another process of this program, at its work until the pipe closes.
pid_t start_rendering(const std::string& job, int pipe_end) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::setenv("ALEPH_TEST_JOB", job.c_str(), 1);
        ::dup2(pipe_end, 3);
        ::execl("/proc/self/exe", "writer", "--gtest_also_run_disabled_tests", "--gtest_brief=1",
                "--gtest_filter=CacheFile.DISABLED_RenderForever", nullptr);
        ::_exit(127);
    }
    return child;
}

/// Both add their own keyframes to one file. No process ever finds it damaged, and no frame changes.
TEST_F(CacheFile, IC22_TwoProcessesWriteOneFile) {
    const std::filesystem::path file = folder / "light";
    const std::string early = render_with(folder / "early", scene, settings),
                      late = render_with(folder / "late", scene, settings, 13);
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    const pid_t writers[2] = {start_rendering("a 3 " + file.string(), ends[1]),
                              start_rendering("b13 " + file.string(), ends[1])};
    ::close(ends[1]);
    int rounds[2] = {0, 0};
    for (char letter = 0; (rounds[0] < 20 || rounds[1] < 20) && ::read(ends[0], &letter, 1) == 1;) {
        ++rounds[letter - 'a'];
        EXPECT_NO_THROW(Sequence(scene, settings).load_light(file));
    }
    ::close(ends[0]);
    for (const pid_t writer : writers) {
        int status = -1;
        ::waitpid(writer, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_GE(std::min(rounds[0], rounds[1]), 20);
    EXPECT_TRUE(render_with(file, scene, settings) == early);
    EXPECT_TRUE(render_with(file, scene, settings, 13) == late);
    const auto files = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 3) << "temporary files are left";
}

TEST_F(CacheFile, IC22_OtherScenesSettingsAndBuildsAreRefused) {
    render_with(folder / "light", scene, settings);
    RenderSettings other = settings;
    other.seed = 7;
    EXPECT_THAT(refusal(folder / "light", scene, other), testing::HasSubstr("setting seed is 0, here 7"));
    other = settings;
    other.picture.width = 32;
    EXPECT_THAT(refusal(folder / "light", scene, other), testing::HasSubstr("setting size is 24x18, here 32x18"));
    Scene changed = scene;
    changed.meshes[0].positions[0].x += 1e-6f;
    EXPECT_THAT(refusal(folder / "light", changed, settings), testing::HasSubstr("another scene"));
    changed = scene;
    changed.nodes[1].transform.translation = glm::dvec3(0.0, 1.5, -2.9);
    EXPECT_THAT(refusal(folder / "light", changed, settings), testing::HasSubstr("another scene"));

    Fingerprint fingerprint = make_cache_fingerprint(scene, settings, {{0, 0}});
    fingerprint.build += "x";
    write_cache_file(folder / "light", fingerprint, {});
    EXPECT_THAT(refusal(folder / "light", scene, settings), testing::HasSubstr("another build"));
}

TEST_F(CacheFile, IC22_DamagedFilesAreRefused) {
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
}

/// Sizes inside the file cannot ask for memory that its length does not back, even if its checksum is right.
TEST_F(CacheFile, IC22_SizesAreCheckedBeforeMemoryIsTaken) {
    const Fingerprint fingerprint{"b", "s", {}};
    write_cache_file(folder / "light", fingerprint, {{5, {{IrradianceRecord{}}, {IrradianceRecord{}}}}});
    EXPECT_EQ(read_cache_file(folder / "light", fingerprint).at(5).seen.size(), 1u);
    const std::string good = read_bytes(folder / "light");
    for (std::size_t place = 8; place < good.size() - 40; place += 8) {
        std::string bad = good.substr(0, good.size() - 40);
        bad[place + 7 < bad.size() ? place + 7 : place] = '\x7f';
        bad += hash_bytes(bad);
        write_file(folder / "bad", bad);
        find_refusal([&] { read_cache_file(folder / "bad", fingerprint); });  // a changed record is no damage
    }
}

TEST_F(CacheFile, IC22_NeedsKeyMoments) {
    RenderSettings without = settings;
    without.cache.light_step = 0;
    EXPECT_THAT(refusal("light", scene, without), testing::HasSubstr("needs lighting keyframes"));
    EXPECT_THROW(Sequence(scene, settings).save_light(), std::logic_error);
}

}  // namespace
}  // namespace aleph
