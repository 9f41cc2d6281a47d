// Pictures that OpenImageIO has written: straight alpha, grey, JPEG; JPEG files that are refused; and what it reads of
// ours.

#include <OpenImageIO/imageio.h>

#include "engine/image/image_file.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// A picture written by OpenImageIO: `values` are codes, interleaved.
void save_codes(const fs::path& path, int width, int height, int channels, const std::vector<std::uint8_t>& values) {
    const auto output = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(output);
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", 100);
    ASSERT_TRUE(output->open(path.string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, values.data()));
    ASSERT_TRUE(output->close());
}

TEST(ImageIo, AlphaStaysStraightAndGreyBecomesColour) {
    const ScratchFolder folder;
    save_codes(folder / "rgba.png", 2, 1, 4, {200, 100, 50, 128, 10, 20, 30, 0});
    const DecodedTexture texture = decode_texture(read_numbers(folder / "rgba.png"), "rgba.png");
    EXPECT_EQ(texture.bytes(0, 0), glm::u8vec4(200, 100, 50, 128));
    EXPECT_EQ(texture.bytes(1, 0), glm::u8vec4(10, 20, 30, 0));
    const ChannelImage image = read_image(folder / "rgba.png");
    ASSERT_EQ(image.channels.size(), 4u);
    EXPECT_EQ(image.channels[3].name, "A");
    EXPECT_NEAR((*image.find("R"))(0, 0), 200.0f / 255.0f, 1e-6f);

    save_codes(folder / "grey.png", 1, 1, 1, {77});
    EXPECT_EQ(decode_texture(read_numbers(folder / "grey.png"), "g").bytes(0, 0), glm::u8vec4(77, 77, 77, 255));
    EXPECT_EQ(read_image(folder / "grey.png").channels.size(), 3u);
    save_codes(folder / "grey_alpha.png", 1, 1, 2, {77, 5});
    EXPECT_EQ(decode_texture(read_numbers(folder / "grey_alpha.png"), "g").bytes(0, 0), glm::u8vec4(77, 77, 77, 5));
}

std::vector<std::uint8_t> flat_jpeg(const ScratchFolder& folder) {
    std::vector<std::uint8_t> codes;
    for (int i = 0; i < 64; ++i) codes.insert(codes.end(), {180, 90, 30});
    save_codes(folder / "a.jpg", 8, 8, 3, codes);
    return read_numbers(folder / "a.jpg");
}

TEST(ImageIo, ReadsJpeg) {
    const ScratchFolder folder;
    const DecodedTexture texture = decode_texture(flat_jpeg(folder), "a.jpg");
    ASSERT_EQ(texture.bytes.width, 8);
    const auto pixel = texture.bytes(3, 3);
    EXPECT_NEAR(pixel[0], 180, 2);
    EXPECT_NEAR(pixel[1], 90, 2);
    EXPECT_NEAR(pixel[2], 30, 2);
    EXPECT_EQ(pixel[3], 255);
    EXPECT_EQ(read_image(folder / "a.jpg").channels.size(), 3u);
}

TEST(ImageIo, BrokenColourProfileInAJpegIsNeverParsed) {
    const ScratchFolder folder;
    const auto clean = flat_jpeg(folder);
    // A profile of 200 bytes with one tag: a text of 3 bytes, shorter than the 8 of its own head. OpenImageIO 2.4.7
    // crashes when it decodes this.
    std::vector<std::uint8_t> profile(200, 0);
    const auto put = [&](std::size_t at, const std::string& text) {
        std::copy(text.begin(), text.end(), &profile[at]);
    };
    profile[3] = 200;
    put(12, "mntrRGB ");
    put(36, "acsp");
    profile[131] = 1;
    put(132, "cprt");
    profile[139] = 144;
    profile[143] = 3;
    put(144, "text");
    std::vector<std::uint8_t> segment{0xff, 0xe2, 0, 216};  // APP2 and its length
    for (const char c : std::string("ICC_PROFILE")) segment.push_back(static_cast<std::uint8_t>(c));
    segment.insert(segment.end(), {0, 1, 1});
    segment.insert(segment.end(), profile.begin(), profile.end());
    auto damaged = clean;
    damaged.insert(damaged.begin() + 2, segment.begin(), segment.end());
    EXPECT_EQ(decode_texture(damaged, "icc.jpg").bytes, decode_texture(clean, "a.jpg").bytes);
}

TEST(ImageIo, CutAndOversizedJpegsAreRefused) {
    const ScratchFolder folder;
    const auto clean = flat_jpeg(folder);
    for (std::size_t length = 0; length + 2 < clean.size(); ++length) {
        const std::vector<std::uint8_t> cut(clean.begin(), clean.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_THROW(decode_texture(cut, "cut.jpg"), InputError) << length;
    }
    auto huge = clean;
    for (std::size_t at = 2; at + 9 < huge.size(); at += 2 + (huge[at + 2] << 8 | huge[at + 3])) {
        if (huge[at + 1] != 0xc0) continue;
        for (std::size_t k = 5; k < 9; ++k) huge[at + k] = 0xff;
        break;
    }
    const Refusal found = find_refusal([&] { decode_texture(huge, "huge.jpg"); });
    EXPECT_NE(found.reason.find("65535x65535"), std::string::npos) << found.message;
}

TEST(ImageIo, EXRKeepsThePlaceInAWholePicture) {
    const ScratchFolder folder;
    ChannelImage image{{{"R", Image<float>(7, 5, 0.5f)}}, {}};
    for (const PictureArea& whole : {PictureArea{-3, -2, 20, 10}, PictureArea{1, 1, 3, 2}}) {
        image.whole = whole;
        write_exr(folder / "a.exr", image);
        const ChannelImage back = read_image(folder / "a.exr");
        EXPECT_EQ(back.whole, whole);
        EXPECT_EQ(*back.find("R"), image.channels.front().values);
    }
    const auto input = OIIO::ImageInput::open(folder / "a.exr");
    EXPECT_EQ(input->spec().x, -1) << "the data window";
    EXPECT_EQ(input->spec().full_width, 3) << "the display window";
    image.whole.reset();
    write_exr(folder / "a.exr", image);
    EXPECT_EQ(read_image(folder / "a.exr").whole, std::nullopt);
}

}  // namespace
}  // namespace aleph
