// A render that is killed: the frames before it stay whole, and a second run completes the shot.
// Standard output and standard error that cannot be written.

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// A box that slides for longer than a test takes.
void write_scene(const fs::path& path) {
    std::ofstream(path) << R"({"aleph": 1, "exposure": 1, "frames": [1, 5000], "nodes": [
        {"translation": [0, 1, 5], "camera": {"fov": 40}}, {"translation": [0, 3, 1], "light": {"type": "point", "intensity": 30}},
        {"shape": {"type": "quad", "size": [9, 9]}, "rotation": {"axis": [1, 0, 0], "degrees": -90}},
        {"shape": {"type": "box", "size": [1, 1, 1]}, "translation": {"keys": [[1, [-1, 0.5, 0]], [5000, [1, 0.5, 0]]]}}]})";
}

/// Starts a render of these frames into the folder.
/// @param alive  a descriptor that the program keeps open until it ends
pid_t start_render(const fs::path& scene, const fs::path& folder, const std::string& frames, int alive = -1) {
    const std::string program = program_path("aleph"), output = folder / "f.######.exr";
    const pid_t child = ::fork();
    if (child == 0) {
        if (alive >= 0) ::fcntl(alive, F_SETFD, 0);
        ::execl(program.c_str(), "aleph", "render", scene.c_str(), "--frames", frames.c_str(), "-o", output.c_str(),
                "--size", "32x24", "--spp", "1", "--gather", "16", "-q", nullptr);
        ::_exit(127);
    }
    return child;
}

int wait_for(pid_t child) {
    int status = -1;
    ::waitpid(child, &status, 0);
    return status;
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

/// Events of a folder: files that a program writes into it.
class FolderEvents {
  public:
    explicit FolderEvents(const fs::path& folder) : file_(::inotify_init1(IN_CLOEXEC)) {
        ::inotify_add_watch(file_, folder.c_str(), IN_CREATE | IN_MOVED_TO);
    }
    ~FolderEvents() { ::close(file_); }
    FolderEvents(const FolderEvents&) = delete;
    FolderEvents& operator=(const FolderEvents&) = delete;

    /// Waits until a temporary file has appeared, or has got its final name, so many times.
    /// @param alive  closed where the program has ended, which is a failure
    void wait(std::uint32_t kind, int times, int alive) {
        alignas(inotify_event) char buffer[4096];
        while (times > 0) {
            pollfd ready[2] = {{file_, POLLIN, 0}, {alive, POLLIN, 0}};
            ::poll(ready, 2, -1);
            ASSERT_TRUE((ready[0].revents & POLLIN) != 0) << "no such file appeared";
            const ssize_t size = ::read(file_, buffer, sizeof buffer);
            ASSERT_GT(size, 0);
            for (ssize_t at = 0; at < size;) {
                const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
                if ((event->mask & kind) != 0) --times;
                at += static_cast<ssize_t>(sizeof(inotify_event)) + event->len;
            }
        }
    }

  private:
    int file_;
};

TEST(KilledRender, OU07_EarlierFramesStayWholeAndASecondRunCompletesThem) {
    const ScratchFolder folder;
    write_scene(folder / "scene.json");
    const struct {
        int signal;
        std::uint32_t kind;
        int times;
    } kills[] = {{SIGINT, IN_MOVED_TO, 0}, {SIGTERM, IN_MOVED_TO, 2}, {SIGINT, IN_CREATE, 1}, {SIGTERM, IN_CREATE, 2}};
    for (const auto& [signal, kind, times] : kills) {
        SCOPED_TRACE(signal);
        const ScratchFolder output, again;
        FolderEvents events(output.path());
        int alive[2];
        ASSERT_EQ(::pipe2(alive, O_CLOEXEC), 0);
        const pid_t child = start_render(folder / "scene.json", output.path(), "1-5000", alive[1]);
        ::close(alive[1]);
        events.wait(IN_MOVED_TO, 1, alive[0]);
        events.wait(kind, times, alive[0]);
        ::close(alive[0]);
        ::kill(child, signal);
        const int status = wait_for(child);
        ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself";
        ASSERT_EQ(WTERMSIG(status), signal);

        std::vector<std::string> finished;
        for (const std::string& name : names_in(output.path())) {
            if (name.starts_with(".f.")) {
                EXPECT_TRUE(name.ends_with(".part")) << name;
            } else {
                finished.push_back(name);
            }
        }
        ASSERT_GE(finished.size(), 1u);
        const std::string frames = "1-" + std::to_string(finished.size() + 1);
        ASSERT_EQ(wait_for(start_render(folder / "scene.json", again.path(), frames)), 0);
        const auto expect_equal = [&](const std::string& name) {
            EXPECT_TRUE(read_bytes(output / name) == read_bytes(again / name)) << name;
        };
        for (const std::string& name : finished) expect_equal(name);
        EXPECT_FALSE(fs::exists(output / names_in(again.path()).back()));
        ASSERT_EQ(wait_for(start_render(folder / "scene.json", output.path(), frames)), 0);
        for (const std::string& name : names_in(again.path())) expect_equal(name);
    }
}

TEST(LostOutput, HelpThatIsLostIsAFailure) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    for (const char* words : {"--help", "--version", "render --help", "study --help"}) {
        const std::string command = "'" + program_path("aleph") + "' " + words + " >/dev/full 2>/dev/null";
        EXPECT_EQ(WEXITSTATUS(::system(command.c_str())), 1) << words;
    }
}

TEST(LostOutput, ProgressThatIsLostDoesNotEndARender) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const ScratchFolder folder;
    const std::string command =
        "'" + program_path("aleph") + "' render '" + (source_folder() / "scenes/cornell/scene.json").string() +
        "' --frames 0-2 --size 16x12 --spp 1 -o '" + folder.path().string() + "/' 2>/dev/full >/dev/null";
    EXPECT_EQ(WEXITSTATUS(::system(command.c_str())), 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "cornell.0002.exr"));
}

}  // namespace
}  // namespace aleph
