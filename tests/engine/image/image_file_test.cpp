// Image files that are written and read again, and files that are refused.

#include "engine/image/image_file.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

void save_bytes(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

ChannelImage small_image() {
    ChannelImage image;
    for (const char* name : {"R", "G", "B", "forward.u", "objectId.X"}) {
        Channel channel{name, Image<float>(7, 5)};
        for (std::size_t i = 0; i < channel.values.size(); ++i) {
            channel.values.pixels[i] = static_cast<float>(i) * 0.37f - 3.0f;
        }
        image.channels.push_back(channel);
    }
    return image;
}

std::string input_error(const fs::path& path) {
    const Refusal found = find_refusal([&] { read_image(path); });
    EXPECT_EQ(found.file, path.string());
    return found.reason;
}

TEST(ImageIo, ExrKeepsEveryChannelByName) {
    const ScratchFolder folder;
    ChannelImage image = small_image();
    image.channels[3].values(6, 4) = 42.5f;
    write_exr(folder / "a.exr", image);
    const ChannelImage back = read_image(folder / "a.exr");
    ASSERT_EQ(back.channels.size(), image.channels.size());
    for (const Channel& channel : image.channels) {
        const Image<float>* values = back.find(channel.name);
        ASSERT_NE(values, nullptr) << channel.name;
        EXPECT_EQ(*values, channel.values) << channel.name;
    }
    EXPECT_EQ(back.find("nope"), nullptr);
}

TEST(ImageIo, ExrKeepsMetadata) {
    const ScratchFolder folder;
    ChannelImage image = small_image();
    image.metadata = {{"software", std::string("aleph")},
                      {"motion:definition", std::string("next - current, y up, \"pixels\"")},
                      {"exposure", 0.1},
                      {"whiteLuminance", 100.0},
                      {"framesPerSecond", std::array{30000, 1001}}};
    write_exr(folder / "a.exr", image);
    EXPECT_EQ(read_image(folder / "a.exr").metadata, image.metadata);
}

TEST(ImageIo, TexturesKeepTheirPrecision) {
    const ScratchFolder folder;
    Image<Rgb> image(2, 1, Rgb(0.5f));
    write_png(folder / "a.png", image);
    const DecodedTexture png = decode_texture(read_numbers(folder / "a.png"), "a.png");
    EXPECT_TRUE(png.floats.empty());
    ASSERT_EQ(png.bytes.size(), 2u);
    EXPECT_EQ(png.bytes(1, 0), glm::u8vec4(188, 188, 188, 255));

    write_exr(folder / "a.exr", small_image());
    const DecodedTexture exr = decode_texture(read_numbers(folder / "a.exr"), "a.exr");
    EXPECT_TRUE(exr.bytes.empty());
    ASSERT_EQ(exr.floats.width, 7);
    EXPECT_EQ(exr.floats(1, 0)[0], 0.37f - 3.0f);
    EXPECT_EQ(exr.floats(1, 0)[3], 1.0f);

    ChannelImage grey{{{"Y", Image<float>(1, 1, 7.0f)}}, {}};
    write_exr(folder / "grey.exr", grey);
    EXPECT_EQ(decode_texture(read_numbers(folder / "grey.exr"), "g").floats(0, 0), glm::vec4(7.0f, 7.0f, 7.0f, 1.0f));
}

TEST(ImageIo, RefusesWhatIsNoPicture) {
    const ScratchFolder folder;
    EXPECT_EQ(input_error(folder / "missing.exr"), "file not found");
    EXPECT_NE(input_error(folder.path()).find("not a regular file"), std::string::npos);
    save_bytes(folder / "empty.png", {});
    EXPECT_EQ(input_error(folder / "empty.png"), "the file is empty");
    const std::string text = "P6 1 1 255 abc";
    save_bytes(folder / "real.ppm", {text.begin(), text.end()});
    EXPECT_EQ(input_error(folder / "real.ppm"), "this is not a PNG, JPEG, EXR or HDR picture");
    EXPECT_THROW(decode_texture({1, 2, 3}, "texture 4"), InputError);
}

TEST(ImageIo, RefusesACutFileAtEveryLength) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", small_image());
    write_png(folder / "a.png", Image<Rgb>(9, 4, Rgb(0.3f)));
    for (const char* name : {"a.exr", "a.png"}) {
        const auto whole = read_numbers(folder / name);
        for (std::size_t length = 0; length < whole.size(); ++length) {
            const std::vector<std::uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
            EXPECT_THROW(decode_texture(cut, name), InputError) << name << " cut to " << length;
        }
    }
}

TEST(ImageIo, DamagedBytesNeverCrash) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", small_image());
    write_png(folder / "a.png", Image<Rgb>(9, 4, Rgb(0.3f)));
    int refused = 0;
    for (const char* name : {"a.exr", "a.png"}) {
        const auto whole = read_numbers(folder / name);
        for (std::size_t at = 0; at < whole.size(); ++at) {
            for (const std::uint8_t flip : {0x01, 0x80, 0xff}) {
                auto damaged = whole;
                damaged[at] ^= flip;
                if (!find_refusal([&] { decode_texture(damaged, name); }).message.empty()) ++refused;
            }
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(ImageIo, DamagedPngIsOneClearError) {
    const ScratchFolder folder;
    write_png(folder / "a.png", Image<Rgb>(9, 4, Rgb(0.3f)));
    auto bytes = read_numbers(folder / "a.png");
    const std::string type = "IDAT";
    const auto data = std::search(bytes.begin(), bytes.end(), type.begin(), type.end());
    ASSERT_NE(data, bytes.end());
    data[8] ^= 0x10;
    save_bytes(folder / "damaged.png", bytes);
    testing::internal::CaptureStderr();
    EXPECT_EQ(input_error(folder / "damaged.png"), "the PNG is damaged (wrong checksum in IDAT)");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageIo, RefusesHugePicturesFromTheHeader) {
    const ScratchFolder folder;
    write_png(folder / "a.png", Image<Rgb>(9, 4, Rgb(0.3f)));
    auto bytes = read_numbers(folder / "a.png");
    bytes[16] = bytes[20] = 0x40;  // the high bytes of width and height in IHDR
    save_bytes(folder / "huge.png", bytes);
    EXPECT_NE(input_error(folder / "huge.png").find("too large"), std::string::npos);
    const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n";
    save_bytes(folder / "huge.hdr", {hdr.begin(), hdr.end()});
    EXPECT_NE(input_error(folder / "huge.hdr").find("too large"), std::string::npos);
}

TEST(ImageIo, RefusesDeepAndMultiPartExr) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", small_image());
    auto bytes = read_numbers(folder / "a.exr");
    bytes[5] |= 0x10;
    save_bytes(folder / "multi.exr", bytes);
    EXPECT_NE(input_error(folder / "multi.exr").find("multi-part"), std::string::npos);
    bytes[5] = static_cast<std::uint8_t>((bytes[5] & ~0x10) | 0x08);
    save_bytes(folder / "deep.exr", bytes);
    EXPECT_NE(input_error(folder / "deep.exr").find("deep"), std::string::npos);
}

/// Imf::InputFile would take the memory first: an attribute of 2 GB in a file of 400 bytes.
TEST(ImageIo, RefusesAttributesLongerThanTheFile) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", small_image());
    const auto bytes = read_numbers(folder / "a.exr");
    const std::string type = "chlist";
    const auto size = std::search(bytes.begin(), bytes.end(), type.begin(), type.end()) - bytes.begin() + 7;
    const auto refuse = [&](int byte, std::uint8_t value) {
        auto changed = bytes;
        changed[size + byte] = value;
        return find_refusal([&] { decode_texture(changed, "a.exr"); });
    };
    for (const std::uint8_t high : {0x7f, 0xff}) {
        EXPECT_EQ(refuse(3, high).place, "attribute 'channels'");
        EXPECT_EQ(refuse(3, high).reason, "is longer than the file");
    }
    // Imf::InputFile would read on after the list, and take its rest for attributes.
    EXPECT_EQ(refuse(0, bytes[size] + 9).place, "attribute 'channels'");
    EXPECT_EQ(refuse(0, bytes[size] + 9).reason, "is longer than its chlist");
}

TEST(ImageIo, ReadsRadianceHdr) {
    const ScratchFolder folder;
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    std::vector<std::uint8_t> bytes(header.begin(), header.end());
    // RGBE (Ward 1991): mantissa / 256 * 2^(e - 128). 128, 64, 32 with e = 130 -> 2, 1, .5
    for (const int b : {128, 64, 32, 130, 0, 0, 0, 0}) bytes.push_back(static_cast<std::uint8_t>(b));
    save_bytes(folder / "a.hdr", bytes);
    const ChannelImage image = read_image(folder / "a.hdr");
    EXPECT_NEAR((*image.find("R"))(0, 0), 2.0f, 0.02f);
    EXPECT_NEAR((*image.find("G"))(0, 0), 1.0f, 0.01f);
    EXPECT_NEAR((*image.find("B"))(0, 0), 0.5f, 0.01f);
    EXPECT_EQ((*image.find("R"))(1, 0), 0.0f);
}

/// All factors together have been applied; a radiance is the value without them.
TEST(ImageIo, ValuesOfAnHdrAreWithoutItsExposure) {
    const auto decode = [](const std::string& lines) {
        const std::string text = "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x82";
        const glm::vec4 pixel = decode_texture({text.begin(), text.end()}, "a.hdr").floats(0, 0);
        EXPECT_EQ(pixel.w, 1.0f);
        return Rgb(pixel);
    };
    const Rgb given = decode("");
    EXPECT_EQ(decode("EXPOSURE=4\n"), given / 4.0f);
    EXPECT_EQ(decode("EXPOSURE= 4.0e0\nVIEW= -vp 1 2 3\nEXPOSURE=\t.5\n"), given / 2.0f);
    EXPECT_EQ(decode("COLORCORR= 2 4 .5\nEXPOSURE=2\n"), given / Rgb(4.0f, 8.0f, 1.0f));
    for (const char* nothing : {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=nan\n", "EXPOSURE=inf\n", "EXPOSURE=\n",
                                "\tEXPOSURE=4\n", "COLORCORR=2 2\n", "# EXPOSURE=4\n"})
        EXPECT_EQ(decode(nothing), given) << nothing;
}

TEST(ImageIo, OtherOrdersOfHdrAreRefused) {
    const auto decode = [](const std::string& resolution) {
        const std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n" + std::string(8, '\x80');
        return decode_texture({text.begin(), text.end()}, "a.hdr");
    };
    EXPECT_EQ(decode("-Y 2 +X 1").floats.height, 2);
    for (const char* order : {"+Y 2 +X 1", "-Y 2 -X 1", "+X 1 -Y 2", "-X 2 +Y 1"}) {
        EXPECT_EQ(
            find_refusal([&] { decode(order); }).reason,
            fmt::format("its pixels are in the order \"{}\"; rows from the top left (-Y, +X) can be read", order));
    }
}

/// Some programs store only the rectangle that is not empty, or more than the picture.
TEST(ImageIo, PixelsOfAnExrTextureLieInTheWholePicture) {
    const ScratchFolder folder;
    const auto decode = [&](const PictureArea& whole, bool has_alpha) {
        ChannelImage image;
        image.whole = whole;
        for (const char* name : {"R", "G", "B", "A"}) {
            if (*name != 'A' || has_alpha) image.channels.push_back({name, Image<float>(2, 1, 0.5f)});
        }
        image.channels[0].values(1, 0) = 0.25f;
        write_exr(folder / "a.exr", image);
        return decode_texture(read_numbers(folder / "a.exr"), "a.exr").floats;
    };
    const Image<glm::vec4> large = decode({-1, -2, 4, 3}, true);
    ASSERT_EQ(large.width, 4);
    ASSERT_EQ(large.height, 3);
    EXPECT_EQ(large(1, 2), glm::vec4(0.5f));
    EXPECT_EQ(large(2, 2), glm::vec4(0.25f, 0.5f, 0.5f, 0.5f));
    EXPECT_EQ(std::ranges::count(large.pixels, glm::vec4(0.0f)), 10);
    EXPECT_EQ(decode({-1, -2, 4, 3}, false)(0, 0), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    const Image<glm::vec4> small = decode({1, 0, 1, 1}, false);
    EXPECT_EQ(small.pixels, (std::vector<glm::vec4>{{0.25f, 0.5f, 0.5f, 1.0f}}));
    EXPECT_EQ(find_refusal([&] {
                  decode({0, 0, 1 << 20, 1 << 20}, false);
              }).reason.substr(0, 24),
              "the picture is too large");
}

}  // namespace
}  // namespace aleph
