// Output: full disks, folders and targets that refuse a file, and programs that are killed while they write.

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <thread>

#include "engine/base/atomic_file.h"
#include "engine/base/sampling.h"
#include "engine/image/image_file.h"
#include "tests/engine/image/output_files.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// Limits the size of all files during its lifetime: a full disk without a disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        handler_ = ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        ::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    sighandler_t handler_;
};

TEST(Output, OU05_FullDiskIsAnErrorThatNamesTheFile) {
    const ScratchFolder folder;
    const ChannelImage large = noise_image(300, 200), small = noise_image(2, 2);
    Image<Rgb> picture(300, 200);
    RandomStream random({.seed = 2});
    for (Rgb& c : picture.pixels) c = {random.next(), random.next(), random.next()};
    const auto expect_failure = [&](const char* name, rlim_t limit, const auto& write) {
        const fs::path path = folder / name;
        std::string message;
        {
            const FileSizeLimit full(limit);
            message = output_error([&] { write(path); });
        }
        EXPECT_NE(message.find(path.string()), std::string::npos) << message;
        EXPECT_NE(message.find("cannot write: File too large"), std::string::npos) << message;
        EXPECT_EQ(entries_in(folder.path()), 0u);  // neither half a file nor a temporary one
    };
    expect_failure("large.exr", 100'000, [&](const fs::path& path) { write_exr(path, large); });
    expect_failure("small.exr", 100, [&](const fs::path& path) { write_exr(path, small); });
    expect_failure("none.exr", 0, [&](const fs::path& path) { write_exr(path, small); });
    expect_failure("large.png", 100'000, [&](const fs::path& path) { write_png(path, picture); });
    expect_failure("small.png", 40, [&](const fs::path& path) { write_png(path, Image<Rgb>(2, 2)); });
    expect_failure("stats.json", 10, [&](const fs::path& path) { write_file(path, "{\"frames\": []}"); });
}

TEST(Output, OU05_FailedWriteKeepsTheFileThatWasThere) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", noise_image(4, 4));
    const std::string before = read_bytes(folder / "a.exr");
    {
        const FileSizeLimit full(100'000);
        EXPECT_THROW(write_exr(folder / "a.exr", noise_image(300, 200)), OutputError);
    }
    EXPECT_EQ(read_bytes(folder / "a.exr"), before);
    EXPECT_EQ(entries_in(folder.path()), 1u);
}

TEST(Output, OU05_AnyFailureInsideRemovesTheTemporary) {
    const ScratchFolder folder;
    EXPECT_THROW(write_atomically(folder / "a.txt",
                                  [](const fs::path& temporary) {
                                      std::ofstream(temporary) << "half";
                                      throw std::runtime_error("stop");
                                  }),
                 std::runtime_error);
    // A writer that writes nothing, without an error, is a failure too.
    EXPECT_THROW(write_atomically(folder / "a.txt", [](const fs::path&) {}), OutputError);
    EXPECT_EQ(entries_in(folder.path()), 0u);
    write_file(folder / "empty.txt", "");
    EXPECT_EQ(fs::file_size(folder / "empty.txt"), 0u);
}

TEST(Output, OU07_LeftoversOfKilledProcessesGoAndFilesInUseStay) {
    const ScratchFolder folder;
    fs::create_symlink("a.txt", folder / "link.txt");
    const std::vector<std::string> left{".a.txt.1234567890123.part", ".a.txt.7.part"};
    const std::vector<std::string> kept{".a.txt.x1.part", ".b.txt.7.part", "a.txt.7.part"};
    for (const auto* names : {&left, &kept})
        for (const std::string& name : *names) std::ofstream(folder / name) << "part";
    write_atomically(folder / "link.txt", [&](const fs::path& temporary) {
        std::ofstream(temporary) << "whole";
        remove_leftovers(folder / "link.txt");
        EXPECT_EQ(read_bytes(temporary), "whole");
    });
    EXPECT_EQ(read_bytes(folder / "a.txt"), "whole");
    for (const std::string& name : left) EXPECT_FALSE(fs::exists(folder / name)) << name;
    for (const std::string& name : kept) EXPECT_TRUE(fs::exists(folder / name)) << name;
}

/// As scripts do that render in several threads: each file is whole, by one or the other.
TEST(Output, OU07_ThreadsWriteOneFileInTurn) {
    const ScratchFolder folder;
    const auto write_often = [&](char letter) {
        for (int i = 0; i < 50; ++i) {
            try_output(folder / "a.txt");
            write_file(folder / "a.txt", std::string(100'000, letter));
        }
    };
    std::future<void> one = std::async(std::launch::async, write_often, 'a'),
                      other = std::async(std::launch::async, write_often, 'b');
    EXPECT_NO_THROW(one.get());
    EXPECT_NO_THROW(other.get());
    const std::string found = read_bytes(folder / "a.txt");
    EXPECT_TRUE(found == std::string(100'000, found.front()));
}

TEST(Output, OU06_MissingFolderAndWrongKindsOfTarget) {
    const ScratchFolder folder;
    const ChannelImage image = noise_image(2, 2);
    const auto error_for = [&](const fs::path& path) { return output_error([&] { write_exr(path, image); }); };
    const std::string missing = (folder / "no").string();
    EXPECT_EQ(error_for(folder / "no/a.exr"), missing + "/a.exr: the folder '" + missing + "' does not exist");
    EXPECT_EQ(error_for(folder.path()), folder.path().string() + ": this is a folder");
    EXPECT_NE(error_for(folder / "").find("this is a folder"), std::string::npos);
    EXPECT_EQ(error_for("/dev/null"), "/dev/null: exists and is not a regular file");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    std::ofstream(folder / "file") << "x";
    EXPECT_NE(error_for(folder / "file/a.exr").find("file/a.exr"), std::string::npos);
    EXPECT_NE(error_for(folder / (std::string(260, 'n') + ".exr")).find("name too long"), std::string::npos);
    EXPECT_EQ(entries_in(folder.path()), 1u);
}

TEST(Output, OU06_ReadOnlyFolderAndFile) {
    const ScratchFolder folder;
    fs::create_directory(folder / "sealed");
    std::ofstream(folder / "sealed/kept.exr") << "old";
    std::ofstream(folder / "kept.exr") << "old";
    ::chmod(folder.path().c_str(), 0777);
    ::chmod((folder / "kept.exr").c_str(), 0444);
    ::chmod((folder / "sealed").c_str(), 0555);
    const uid_t user = ::geteuid();
    ASSERT_EQ(::seteuid(user == 0 ? 65534 : user), 0);  // root may write anywhere: another user is needed
    const std::string in_sealed = output_error([&] { write_file(folder / "sealed/new.exr", "new"); });
    const std::string over_kept = output_error([&] { write_file(folder / "kept.exr", "new"); });
    ASSERT_EQ(::seteuid(user), 0);
    EXPECT_EQ(in_sealed,
              (folder / "sealed/new.exr").string() + ": cannot create a file in this folder: Permission denied");
    EXPECT_EQ(over_kept, (folder / "kept.exr").string() + ": cannot replace the existing file: Permission denied");
    EXPECT_EQ(read_bytes(folder / "kept.exr"), "old");
    ::chmod((folder / "sealed").c_str(), 0755);
}

TEST(Output, OU06_ExistingFileIsReplacedAndLinksAreFollowed) {
    const ScratchFolder folder;
    write_file(folder / "a.txt", "one");
    write_file(folder / "a.txt", "two");
    EXPECT_EQ(read_bytes(folder / "a.txt"), "two");
    fs::create_symlink("a.txt", folder / "link.txt");
    write_file(folder / "link.txt", "three");
    EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
    EXPECT_EQ(read_bytes(folder / "a.txt"), "three");
    fs::create_symlink("new.txt", folder / "dangling.txt");
    write_file(folder / "dangling.txt", "four");
    EXPECT_TRUE(fs::is_symlink(folder / "dangling.txt"));
    EXPECT_EQ(read_bytes(folder / "new.txt"), "four");
    fs::create_symlink("round.txt", folder / "round.txt");
    EXPECT_NE(output_error([&] { write_file(folder / "round.txt", "five"); }).find("cannot follow the link"),
              std::string::npos);
}

TEST(Output, OU06_WhatCannotBeWrittenIsFoundBefore) {
    const ScratchFolder folder;
    try_output(folder / "new/deep/a.exr");
    EXPECT_TRUE(fs::is_empty(folder / "new/deep"));
    std::ofstream(folder / "file") << "x";
    fs::create_directory(folder / "new/b.exr");
    for (const fs::path& path : {folder / "file/a.exr", folder / "new/b.exr", folder / (std::string(260, 'n') + ".exr"),
                                 fs::path("/dev/null/a.exr")})
        EXPECT_THROW(try_output(path), OutputError) << path;
}

constexpr std::size_t big = std::size_t{16} << 20;

/// Not a test: the program that the next test runs and kills.
TEST(Output, DISABLED_WriteForever) {
    const char* target = std::getenv("ALEPH_TEST_TARGET");
    ASSERT_NE(target, nullptr);
    for (char c = 'a';; c = c == 'a' ? 'b' : 'a') write_file(target, std::string(big, c));
}

TEST(Output, OU07_KilledWhileWritingLeavesAWholeFile) {
    const ScratchFolder folder;
    const fs::path target = folder / "frame.0001.exr";
    ::setenv("ALEPH_TEST_TARGET", target.c_str(), 1);
    for (int round = 0; round < 8; ++round) {
        write_file(target, std::string(big, 'a'));
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
            ::execl("/proc/self/exe", "writer", "--gtest_also_run_disabled_tests",
                    "--gtest_filter=Output.DISABLED_WriteForever", nullptr);
            ::_exit(127);
        }
        int status = 0;
        do {  // stops it, until it stands still in the middle of a file
            ::kill(child, SIGCONT);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ::kill(child, SIGSTOP);
            ::waitpid(child, &status, WUNTRACED);
            ASSERT_TRUE(WIFSTOPPED(status)) << "the writer ended by itself";
        } while (entries_in(folder.path()) < 2);
        ::kill(child, round % 3 == 0 ? SIGINT : round % 3 == 1 ? SIGTERM : SIGKILL);
        ::kill(child, SIGCONT);
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status));
        const std::string content = read_bytes(target);
        ASSERT_EQ(content.size(), big);
        EXPECT_EQ(content.find_first_not_of(content[0]), std::string::npos) << "two writes are mixed";
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            if (entry.path() == target) continue;
            EXPECT_TRUE(entry.path().filename().string().starts_with(".frame.0001.exr.")) << entry.path();
            EXPECT_EQ(entry.path().extension(), ".part");
            fs::remove(entry.path());
        }
    }
    ::unsetenv("ALEPH_TEST_TARGET");
}

}  // namespace
}  // namespace aleph
