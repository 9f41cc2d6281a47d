// Output: values, names and disk errors that damage image files.

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/sampling.h"
#include "engine/image/codec.h"
#include "engine/image/image_file.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::size_t entries_in(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Noise that does not compress.
ChannelImage noise_image(int width, int height, const std::vector<std::string>& names = {"R", "G", "B"}) {
    ChannelImage image;
    RandomStream random({.seed = 1});
    for (const std::string& name : names) {
        image.channels.push_back({name, Image<float>(width, height)});
        for (float& v : image.channels.back().values.pixels) v = random.next();
    }
    return image;
}

ChannelImage row_image(const std::string& name, std::vector<float> values) {
    Image<float> row(static_cast<int>(values.size()), 1);
    row.pixels = std::move(values);
    return {{{name, row}}, {}};
}

std::string output_error(const std::function<void()>& write) {
    try {
        write();
    } catch (const OutputError& e) {
        return e.what();
    }
    return "(no error)";
}

void expect_bits_survive(const std::string& channel, const std::vector<float>& values) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", row_image(channel, values));
    const ChannelImage back = read_image(folder / "a.exr");
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(back.channels[0].values.pixels[i]),
                  std::bit_cast<std::uint32_t>(values[i]))
            << values[i];
    }
}

TEST(Output, OU01_ValuesBeyondHalfSurvive) {
    expect_bits_survive("R", {0.0f, -0.0f, 65504.0f, 65519.0f, 65520.0f, 1e6f, -1e6f, 1e-8f, 1.1e-6f, 6.1e-5f,
                              std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::min(),
                              std::numeric_limits<float>::max(), infinity, -infinity, nan_value});
}

TEST(Output, OU02_EveryChannelIs32BitFloat) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", noise_image(4, 4, {"R", "forward.u", "aleph.Y", "objectId.X", "Z"}));
    const Imf::InputFile file((folder / "a.exr").c_str());
    int count = 0;
    for (auto it = file.header().channels().begin(); it != file.header().channels().end(); ++it, ++count) {
        EXPECT_EQ(it.channel().type, Imf::FLOAT) << it.name();
    }
    EXPECT_EQ(count, 5);
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
}

TEST(Output, OU02_SmallMotionLargeIdsAndBackgroundDepthAreBitEqual) {
    expect_bits_survive("forward.u", {1e-12f, -3.7e-9f, 0.1f, 1234.5678f, 12345.679f});
    expect_bits_survive("objectId.X", {-1.0f, 2048.0f, 2049.0f, 16777215.0f});
    expect_bits_survive("Z", {1e30f, 0.1f, 1e6f + 0.0625f});
}

TEST(Output, OU04_EightBitGoldenBytes) {
    const ScratchFolder folder;
    // 0.0001517635 is half a code (0.5 / 255 / 12.92): below it 0, above it 1. sRGB by hand: 0.18 -> 117.6.
    const std::vector<float> values{nan_value, infinity, -infinity, 300.0f, -0.01f,   -0.0f,    0.0f,
                                    1.0f,      0.99999f, 0.5f,      0.18f,  0.00015f, 0.00016f, 1e-42f};
    const std::vector<long> codes{0, 255, 0, 255, 0, 0, 0, 255, 255, 188, 118, 0, 1, 0};
    Image<Rgb> image(static_cast<int>(values.size()), 1);
    for (std::size_t i = 0; i < values.size(); ++i) image.pixels[i] = {values[i], values[values.size() - 1 - i], 0.0f};
    write_png(folder / "a.png", image);
    const ChannelImage back = read_image(folder / "a.png");
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(std::lround(255.0f * back.find("R")->pixels[i]), codes[i]) << values[i];
        EXPECT_EQ(std::lround(255.0f * back.find("G")->pixels[i]), codes[values.size() - 1 - i]);
    }
}

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
    const std::string before = text_of(folder / "a.exr");
    {
        const FileSizeLimit full(100'000);
        EXPECT_THROW(write_exr(folder / "a.exr", noise_image(300, 200)), OutputError);
    }
    EXPECT_EQ(text_of(folder / "a.exr"), before);
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
    EXPECT_NE(error_for(folder / (std::string(250, 'n') + ".exr")).find("name too long"), std::string::npos);
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
    EXPECT_EQ(text_of(folder / "kept.exr"), "old");
    ::chmod((folder / "sealed").c_str(), 0755);
}

TEST(Output, OU06_ExistingFileIsReplacedAndLinksAreFollowed) {
    const ScratchFolder folder;
    write_file(folder / "a.txt", "one");
    write_file(folder / "a.txt", "two");
    EXPECT_EQ(text_of(folder / "a.txt"), "two");
    fs::create_symlink("a.txt", folder / "link.txt");
    write_file(folder / "link.txt", "three");
    EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
    EXPECT_EQ(text_of(folder / "a.txt"), "three");
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
    std::size_t half_files = 0;
    for (int round = 0; round < 8; ++round) {
        write_file(target, std::string(big, 'a'));
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            ::setenv("ALEPH_TEST_TARGET", target.c_str(), 1);
            std::ignore = ::freopen("/dev/null", "w", stdout);
            ::execl("/proc/self/exe", "writer", "--gtest_also_run_disabled_tests",
                    "--gtest_filter=Output.DISABLED_WriteForever", nullptr);
            ::_exit(127);
        }
        for (int wait = 0; wait < 10'000 && entries_in(folder.path()) < 2; ++wait) {  // until it writes
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2 * round));
        ::kill(child, round % 3 == 0 ? SIGINT : round % 3 == 1 ? SIGTERM : SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
        const std::string content = text_of(target);
        ASSERT_EQ(content.size(), big);
        EXPECT_EQ(content.find_first_not_of(content[0]), std::string::npos) << "two writes are mixed";
        for (const auto& entry : fs::directory_iterator(folder.path())) {
            if (entry.path() == target) continue;
            EXPECT_TRUE(entry.path().filename().string().starts_with(".frame.0001.exr.")) << entry.path();
            EXPECT_EQ(entry.path().extension(), ".part");
            ++half_files;
            fs::remove(entry.path());
        }
    }
    EXPECT_GT(half_files, 0u) << "no write was interrupted, so nothing was tested";
}

TEST(Output, OU08_SizesAndChannels) {
    const ScratchFolder folder;
    const auto error_for = [&](const ChannelImage& image) {
        return output_error([&] { write_exr(folder / "a.exr", image); });
    };
    const auto sized = [](int width, int height) { return ChannelImage{{{"Z", Image<float>(width, height)}}, {}}; };
    const std::string name = (folder / "a.exr").string() + ": ";
    EXPECT_EQ(error_for({}), name + "there is no channel to write");
    EXPECT_EQ(error_for(sized(0, 5)), name + "the picture is empty (0x5)");
    EXPECT_EQ(error_for(sized(5, 0)), name + "the picture is empty (5x0)");
    ChannelImage uneven = sized(3, 2);
    uneven.channels.push_back({"N.X", Image<float>(2, 3)});
    EXPECT_EQ(error_for(uneven), name + "channel 'N.X': is 2x3, the first channel is 3x2");
    ChannelImage twice = sized(3, 2);
    twice.channels.push_back(twice.channels[0]);
    EXPECT_EQ(error_for(twice), name + "channel 'Z': is there twice");
    ChannelImage reserved = sized(3, 2);
    reserved.metadata["compression"] = std::string("none");
    EXPECT_EQ(error_for(reserved), name + "metadata 'compression': this name is not free");
    EXPECT_NE(output_error([&] { write_png(folder / "a.png", Image<Rgb>(0, 5)); }).find("empty (0x5)"),
              std::string::npos);
    EXPECT_EQ(entries_in(folder.path()), 0u);
    for (const auto& [width, height] : {std::pair{1, 1}, {65536, 1}, {1, 65536}, {65536, 3}}) {
        write_exr(folder / "a.exr", noise_image(width, height, {"Z"}));
        EXPECT_EQ(read_image(folder / "a.exr").channels[0].values,
                  noise_image(width, height, {"Z"}).channels[0].values);
        write_png(folder / "a.png", Image<Rgb>(width, height, Rgb(1.0f)));
        EXPECT_EQ(read_image(folder / "a.png").channels[2].values, Image<float>(width, height, 1.0f));
    }
}

TEST(Output, OU09_EqualBytesFromAnyNumberOfThreads) {
    ChannelImage image = noise_image(320, 240, {"R", "G", "B", "A", "Z", "forward.u", "forward.v"});
    image.metadata = {{"software", std::string("aleph")}, {"seed", 3.0}};
    const std::string one = encode_exr(image, 1);
    for (const int threads : {2, 4, 8}) EXPECT_EQ(encode_exr(image, threads), one) << threads;
    const ScratchFolder folder;
    for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        write_exr(folder / "a.exr", image);
        EXPECT_EQ(text_of(folder / "a.exr"), one) << threads;
    }
}

TEST(Output, OU09_NoDateInTheFile) {
    const ScratchFolder folder;
    Image<Rgb> picture(16, 16, Rgb(0.5f));
    write_png(folder / "a.png", picture);
    write_exr(folder / "a.exr", noise_image(4, 4));
    const std::string png = text_of(folder / "a.png"), exr = text_of(folder / "a.exr");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    write_png(folder / "a.png", picture);
    write_exr(folder / "a.exr", noise_image(4, 4));
    EXPECT_EQ(text_of(folder / "a.png"), png);
    EXPECT_EQ(text_of(folder / "a.exr"), exr);
    EXPECT_EQ(png.find("tIME"), std::string::npos);
    EXPECT_EQ(exr.find("capDate"), std::string::npos);
}

}  // namespace
}  // namespace aleph
