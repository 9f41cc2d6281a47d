// Output: values, names, sizes and threads that damage image files.

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <bit>
#include <chrono>
#include <thread>

#include "engine/base/parallel.h"
#include "engine/image/codec.h"
#include "engine/image/image_file.h"
#include "tests/engine/image/output_files.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

ChannelImage row_image(const std::string& name, std::vector<float> values) {
    Image<float> row(static_cast<int>(values.size()), 1);
    row.pixels = std::move(values);
    return {{{name, row}}, {}};
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
                              std::numeric_limits<float>::max(), float_infinity, -float_infinity, float_nan});
}

TEST(Output, NamesMayBeAsLongAsTheFileSystemAllows) {
    const ScratchFolder folder;
    for (const std::size_t length : {200u, 240u, 255u}) {
        const std::string name = std::string(length - 4, 'n') + ".exr";
        write_exr(folder / name, row_image("R", {1.0f}));
        EXPECT_EQ(read_image(folder / name).channels.size(), 1u) << length;
    }
    const std::string one = std::string(251, 'n') + ".exr", other = std::string(250, 'n') + "m.exr";
    EXPECT_NE(hidden_beside(one, "part"), hidden_beside(other, "part"));
    EXPECT_LE(hidden_beside(one, "checkpoint").string().size(), 255u);
    EXPECT_EQ(hidden_beside("a/b.exr", "lock"), std::filesystem::path("a/.b.exr.lock"));
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
    const std::vector<float> values{float_nan, float_infinity, -float_infinity, 300.0f, -0.01f, -0.0f,
                                    0.0f,      1.0f,           0.99999f,        0.5f,   0.18f,  0.00015f,
                                    0.00016f,  1e-42f,         0.0031308f,      0.75f};
    const std::vector<long> codes{0, 255, 0, 255, 0, 0, 0, 255, 255, 188, 118, 0, 1, 0, 10, 225};
    Image<Rgb> image(8, 2);
    for (std::size_t i = 0; i < values.size(); ++i) image.pixels[i] = {values[i], values[values.size() - 1 - i], 0.0f};
    write_png(folder / "a.png", image);
    const ChannelImage back = read_image(folder / "a.png");
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(std::lround(255.0f * back.find("R")->pixels[i]), codes[i]) << values[i];
        EXPECT_EQ(std::lround(255.0f * back.find("G")->pixels[i]), codes[values.size() - 1 - i]);
        EXPECT_EQ(back.find("B")->pixels[i], 0.0f);
    }
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
        EXPECT_EQ(read_bytes(folder / "a.exr"), one) << threads;
    }
}

TEST(Output, OU09_NoDateInTheFile) {
    const ScratchFolder folder;
    Image<Rgb> picture(16, 16, Rgb(0.5f));
    write_png(folder / "a.png", picture);
    write_exr(folder / "a.exr", noise_image(4, 4));
    const std::string png = read_bytes(folder / "a.png"), exr = read_bytes(folder / "a.exr");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    write_png(folder / "a.png", picture);
    write_exr(folder / "a.exr", noise_image(4, 4));
    EXPECT_EQ(read_bytes(folder / "a.png"), png);
    EXPECT_EQ(read_bytes(folder / "a.exr"), exr);
    EXPECT_EQ(png.find("tIME"), std::string::npos);
    EXPECT_EQ(exr.find("capDate"), std::string::npos);
}

}  // namespace
}  // namespace aleph
