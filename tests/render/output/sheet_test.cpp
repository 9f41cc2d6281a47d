// Sheets of pictures and maps, read back from their files.

#include "render/output/sheet.h"
#include "engine/image/image_file.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Rgb pixel_of(const ChannelImage& image, int x, int y) {
    return {(*image.find("R"))(x, y), (*image.find("G"))(x, y), (*image.find("B"))(x, y)};
}

void expect_color(const Rgb& found, const Rgb& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.012f) << c;
}

constexpr int caption = 26;  // pixels above a picture

TEST(Sheet, PanelsStandInRowsBelowTheirCaptions) {
    const ScratchFolder folder;
    const std::vector<Rgb> colors{{0.8f, 0.1f, 0.1f}, {0.1f, 0.7f, 0.1f}, {0.1f, 0.2f, 0.9f}};
    std::vector<Panel> panels;
    for (const Rgb& color : colors) panels.push_back({"name", Image<Rgb>(20, 15, color)});
    write_sheet(folder / "sheet.png", panels, 2, 40);
    const ChannelImage sheet = read_image(folder / "sheet.png");
    ASSERT_EQ(sheet.find("R")->width, 80);
    ASSERT_EQ(sheet.find("R")->height, 2 * (30 + caption));
    for (int i = 0; i < 3; ++i)
        for (const int x : {2, 37})
            for (const int y : {2, 27})
                expect_color(pixel_of(sheet, i % 2 * 40 + x, i / 2 * (30 + caption) + caption + y), colors[i]);
    const Rgb empty = pixel_of(sheet, 60, 30 + 2 * caption + 15);
    expect_color(empty, Rgb(0.10f));  // the ground, as the fourth place has no panel
}

TEST(Sheet, ColoursAreClampedAndInvalidOnesBlack) {
    Image<Rgb> picture(3, 1);
    picture(0, 0) = Rgb(7.0f, -2.0f, 0.5f);
    picture(1, 0) = Rgb(float_nan, float_infinity, 0.0031308f);
    picture(2, 0) = Rgb(0.18f);
    const Panel panel = color_panel("", picture);
    EXPECT_FLOAT_EQ(panel.display(0, 0).x, 1.0f);
    EXPECT_EQ(panel.display(0, 0).y, 0.0f);
    EXPECT_NEAR(panel.display(0, 0).z, 0.735357f, 1e-5f);  // IEC 61966-2-1
    EXPECT_EQ(panel.display(1, 0).x, 0.0f);
    EXPECT_EQ(panel.display(1, 0).y, 0.0f);
    EXPECT_NEAR(panel.display(1, 0).z, 0.04045f, 1e-5f);
    EXPECT_NEAR(panel.display(2, 0).x, 0.461356f, 1e-5f);
}

TEST(Sheet, AMapRunsFromBlackOverRedToYellow) {
    Image<float> map(5, 1);
    for (int i = 0; i < 5; ++i) map(i, 0) = std::pow(10.0f, static_cast<float>(i - 2));  // .01 to 100
    const Panel steps = map_panel("", map, {0.1, 10.0, true});
    EXPECT_EQ(steps.low, "0.1");
    EXPECT_EQ(steps.high, "10");
    expect_color(steps.display(0, 0), steps.display(1, 0));
    expect_color(steps.display(4, 0), steps.display(3, 0));
    // Matplotlib's "inferno" at 0, .5 and 1.
    expect_color(steps.display(1, 0), {0.001f, 0.000f, 0.014f});
    expect_color(steps.display(2, 0), {0.736f, 0.216f, 0.330f});
    expect_color(steps.display(3, 0), {0.988f, 0.998f, 0.645f});
    Image<float> linear(4, 1);
    linear(0, 0) = 2.0f, linear(1, 0) = 4.0f, linear(2, 0) = 3.0f, linear(3, 0) = float_nan;
    const Panel middle = map_panel("", linear, {2.0, 4.0, false});
    for (int i = 0; i < 3; ++i) expect_color(middle.display(i, 0), steps.display(std::array{1, 3, 2}[i], 0));
    EXPECT_EQ(middle.display(3, 0), middle.display(0, 0));
}

TEST(MapPreview, HoldsTheMapsThatTheFrameHas) {
    const ScratchFolder folder;
    FrameOutput output;
    output.estimate = Image<Rgb>(40, 20, Rgb(0.25f));
    output.velocity = Image<float>(40, 20, 100.0f);
    output.perception.saliency = Image<float>(40, 20, 0.0f);
    output.perception.aleph = Image<float>(40, 20, 250.6f);
    write_map_preview(folder / "few.png", output);
    const ChannelImage few = read_image(folder / "few.png");
    ASSERT_EQ(few.find("R")->width, 120);
    ASSERT_EQ(few.find("R")->height, 2 * (20 + caption));
    const auto middle = [](const ChannelImage& sheet, int column, int row) {
        return pixel_of(sheet, column * 40 + 20, row * (20 + caption) + caption + 10);
    };
    const Rgb least{0.001f, 0.000f, 0.014f}, most{0.988f, 0.998f, 0.645f};
    expect_color(middle(few, 0, 0), Rgb(0.537f));  // sRGB of .25
    expect_color(middle(few, 1, 0), most);
    expect_color(middle(few, 2, 0), least);
    expect_color(middle(few, 0, 1), most);
    output.limits.threshold = Image<float>(40, 20, 0.1f);
    output.limits.alpha = Image<float>(40, 20, 1.0f);
    write_map_preview(folder / "all.png", output);
    const ChannelImage all = read_image(folder / "all.png");
    expect_color(middle(all, 1, 1), least);
    expect_color(middle(all, 2, 1), most);
}

}  // namespace
}  // namespace aleph
