// Radiance pictures: what their 8 bits per channel change, and how much of that is counted.

#include "engine/base/sampling.h"
#include "engine/image/image_file.h"
#include "tests/engine/image/output_files.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct ReadBack {
    Image<Rgb> color;
    std::size_t changed = 0;
};

ReadBack write_and_read(const Image<Rgb>& image) {
    const ScratchFolder folder;
    ReadBack back;
    back.changed = write_hdr(folder / "a.hdr", image);
    EXPECT_EQ(entries_in(folder.path()), 1u);  // no half file beside it
    const ChannelImage file = read_image(folder / "a.hdr");
    EXPECT_EQ(file.channels.size(), 3u);
    EXPECT_FALSE(file.metadata.contains("encoding"));
    back.color = Image<Rgb>(image.width, image.height);
    for (int c = 0; c < 3; ++c) {
        const Image<float>* values = file.find(std::string(1, "RGB"[c]));
        if (values == nullptr || !same_size(*values, image)) {
            ADD_FAILURE() << "channel " << c;
            return back;
        }
        for (std::size_t i = 0; i < image.size(); ++i) back.color.pixels[i][c] = values->pixels[i];
    }
    return back;
}

Rgb write_and_read(const Rgb& pixel) {
    return write_and_read(Image<Rgb>(1, 1, pixel)).color.pixels[0];
}

TEST(Hdr, OU03_ValuesAreWithinTheirCode) {
    for (const auto& [width, height] : {std::pair(1, 1), {7, 5}, {8, 3}, {300, 2}}) {  // plain and run-length coded
        Image<Rgb> image(width, height);
        RandomStream random({.seed = 3});
        for (Rgb& p : image.pixels) {
            const float size = std::exp2(60.0f * (random.next() - 0.5f));
            p = Rgb(random.next(), random.next(), random.next()) * size;
        }
        const ReadBack back = write_and_read(image);
        EXPECT_EQ(back.changed, 0u);
        double sum = 0.0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const Rgb given = image.pixels[i], read = back.color.pixels[i];
            const float brightest = std::max({given.x, given.y, given.z});
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(read[c] / brightest, given[c] / brightest, 1.0 / 256.0) << i;
                sum += (read[c] - given[c]) / brightest;
            }
        }
        const double count = 3.0 * static_cast<double>(image.size());
        EXPECT_LT(std::abs(sum / count), 3.0 / 256.0 / std::sqrt(count));  // rounded, not cut
    }
}

TEST(Hdr, OU03_KnownValues) {
    // 1e6 is 244.1 steps of 2^12, and .7 179.2 of 2^-8.
    EXPECT_EQ(write_and_read(Rgb(1e6f)), Rgb(999424.0f));
    EXPECT_EQ(write_and_read(Rgb(0.0f)), Rgb(0.0f));
    EXPECT_EQ(write_and_read(Rgb(1.0f, 0.5f, 0.25f)), Rgb(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(write_and_read(Rgb(0.7f)), Rgb(179.0f / 256.0f));
    EXPECT_EQ(write_and_read(Rgb(0.999f)), Rgb(1.0f));                              // rounds up into the next exponent
    EXPECT_EQ(write_and_read(Rgb(1.0f, 0.003f, 0.01f)), Rgb(1.0f, 0.0f, 0x1p-7f));  // a small one beside a large one
    EXPECT_EQ(write_and_read(Rgb(0x1p-100f)), Rgb(0x1p-100f));
    EXPECT_EQ(write_and_read(Rgb(1e-37f)), Rgb(0.0f));
}

TEST(Hdr, OU03_ValuesWithoutACodeAreCounted) {
    constexpr float largest = 0xffp119f;  // 1.7e38
    const std::array<std::pair<float, float>, 9> cases{{{float_nan, 0.0f},
                                                        {-float_nan, 0.0f},
                                                        {-1.0f, 0.0f},
                                                        {-1e-30f, 0.0f},
                                                        {-float_infinity, 0.0f},
                                                        {float_infinity, largest},
                                                        {std::numeric_limits<float>::max(), largest},
                                                        {0x1p127f, largest},
                                                        {-std::numeric_limits<float>::denorm_min(), 0.0f}}};
    for (const auto& [value, expected] : cases) {
        for (int channel = 0; channel < 3; ++channel) {
            Image<Rgb> image(3, 1, Rgb(0.5f));
            image.pixels[1][channel] = value;
            const ReadBack back = write_and_read(image);
            EXPECT_EQ(back.changed, 1u) << value;
            EXPECT_EQ(back.color.pixels[1][channel], expected) << value;
            EXPECT_EQ(back.color.pixels[0], Rgb(0.5f));
            EXPECT_EQ(back.color.pixels[2], Rgb(0.5f));
        }
    }
    for (const float held : {0.0f, -0.0f, 1.6e38f, std::numeric_limits<float>::min()})
        EXPECT_EQ(write_and_read(Image<Rgb>(2, 2, Rgb(held))).changed, 0u) << held;
    EXPECT_EQ(write_and_read(Image<Rgb>(4, 2, Rgb(float_nan))).changed, 24u);
}

TEST(Hdr, OU03_FailuresNameTheFileAndLeaveNothing) {
    const ScratchFolder folder;
    EXPECT_NE(output_error([&] { write_hdr(folder / "none/a.hdr", Image<Rgb>(2, 2)); }).find("none/a.hdr"),
              std::string::npos);
    EXPECT_NE(output_error([&] { write_hdr(folder / "a.hdr", Image<Rgb>()); }).find("empty"), std::string::npos);
    EXPECT_EQ(entries_in(folder.path()), 0u);
    write_hdr(folder / "a.hdr", Image<Rgb>(9, 4, Rgb(0.3f)));
    write_hdr(folder / "b.hdr", Image<Rgb>(9, 4, Rgb(0.3f)));
    EXPECT_EQ(read_bytes(folder / "a.hdr"), read_bytes(folder / "b.hdr"));  // no date
}

}  // namespace
}  // namespace aleph
