// `aleph preview`: film and sheet of a long shot, lines of motion, and what is left without ffmpeg.
// Sheets of pictures and maps, read back from their files.

#include "engine/image/image_file.h"
#include "render/output/sheet.h"
#include "tests/render/cli/answers.h"
#include "tests/support/film_programs.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int caption = 26;  // pixels above a picture

class Preview : public ProgramTest {
  protected:
    Preview() {
        write_sliding_box(folder_ / "scene.json");
        std::string text = read_bytes(folder_ / "scene.json");
        text.insert(1, R"("settings": {"size": "32x24"}, )");
        std::ofstream(folder_ / "scene.json") << text;
        fs::create_directory(folder_ / "out");
    }
    Ended run(const std::string& output, const Words& more = {}) const {
        const Words words{"preview", folder_ / "scene.json", "-t", "2", "-o", folder_ / "out" / output};
        return ProgramTest::run(joined(words, more));
    }
};

TEST_F(Preview, OfALongShotHasEvenlySpreadFramesAndTheirSheet) {
    expect_answer(run("p.mp4"), 0, "preview of 60 of 5000 frames\n");
    EXPECT_EQ(names_in(folder_ / "out"), (Words{"p.mp4", "p.png"}));
    EXPECT_EQ(probe_film(folder_ / "out/p.mp4", "width,height,r_frame_rate,nb_read_frames"), "32,24,5/14,60");
    const ChannelImage sheet = read_image(folder_ / "out/p.png");
    ASSERT_EQ(sheet.find("R")->width, 4 * 32);
    ASSERT_EQ(sheet.find("R")->height, 3 * (24 + caption));
    const std::vector<ChannelImage> frames = decode_film(folder_ / "out/p.mp4");
    ASSERT_EQ(frames.size(), 60u);
    for (const auto& [panel, frame] : {std::pair(0, 0), std::pair(5, 26), std::pair(11, 59)}) {
        const int left = panel % 4 * 32, top = panel / 4 * (24 + caption) + caption;
        for (const int half : {0, 16}) {
            EXPECT_NEAR((PicturePartMeans{left + half, left + half + 16, top, top + 24}.mean(sheet, "G")),
                        (PicturePartMeans{half, half + 16, 0, 24}.mean(frames[static_cast<std::size_t>(frame)], "G")),
                        2.0)
                << panel;
        }
    }
}

TEST_F(Preview, TheSheetAloneNeedsNoFfmpeg) {
    const ScopedPath path(folder_.path());
    EXPECT_EQ(run("p.png", {"--frames", "7"}).code, 0);
    EXPECT_EQ(names_in(folder_ / "out"), Words{"p.png"});
    EXPECT_EQ(read_image(folder_ / "out/p.png").find("R")->width, 32);
    expect_answer(run("p.mp4", {"--frames", "7"}), 1, "ffmpeg, which is not in PATH");
    expect_answer(run("p.exr"), 2, "a preview is a film");
    // Where no name is given, the sheet is made.
    const fs::path before = fs::current_path();
    fs::current_path(folder_ / "out");
    const Ended unnamed = ProgramTest::run({"preview", folder_ / "scene.json", "--frames", "7"});
    fs::current_path(before);
    expect_answer(unnamed, 0, "warning: the sheet of frames is made, and no film");
    const Words names = names_in(folder_ / "out");
    ASSERT_EQ(names.size(), 2u);
    EXPECT_TRUE(names[0].ends_with(".preview.png")) << names[0];
}

TEST_F(Preview, HasTheSizeThatIsAskedFor) {
    ASSERT_EQ(run("p.mp4", {"--frames", "7,8", "--size", "300x200"}).code, 0);
    EXPECT_EQ(probe_film(folder_ / "out/p.mp4", "width,height"), "300,200");
    EXPECT_EQ(read_image(folder_ / "out/p.png").find("R")->width, 2 * 300);
    expect_answer(run("p.png", {"--size", "wide"}), 2, "--size: ");
}

TEST_F(Preview, AStopLeavesNothingAndOffersNothing) {
    const fs::path frames = folder_ / "out/.p.mp4.frames";
    fs::create_directory(frames);
    FolderEvents events(frames);
    StartedProgram program({"preview", folder_ / "scene.json", "-o", folder_ / "out/p.mp4"}, folder_ / "log");
    ASSERT_TRUE(events.wait(IN_MOVED_TO, 1, program));
    program.send(SIGTERM);
    const Ended ended = program.wait();
    expect_answer(ended, 143, "stopped by SIGTERM: ");
    EXPECT_THAT(ended.err, Not(HasSubstr("--resume")));
    EXPECT_EQ(names_in(folder_ / "out"), Words{});
}

TEST_F(Preview, MotionIsDrawnOnTheFrames) {
    // 2500 frames of the way in one: the box moves by pixels.
    std::string text = read_bytes(folder_ / "scene.json");
    text.replace(text.find("[5000, [1, 0.5, 0]]"), 19, "[4, [1, 0.5, 0]]");
    text.replace(text.find("32x24"), 5, "96x72");
    std::ofstream(folder_ / "scene.json") << text;
    ASSERT_EQ(run("plain.png", {"--frames", "2"}).code, 0);
    ASSERT_EQ(run("motion.png", {"--frames", "2", "--motion"}).code, 0);
    EXPECT_FALSE(read_bytes(folder_ / "out/plain.png") == read_bytes(folder_ / "out/motion.png"));
}

TEST(MotionLines, LeadFromAPixelToWhereItGoes) {
    Image<Rgb> picture(40, 30, Rgb(0.0f));
    MotionField motion;
    motion.displacement = Image<glm::dvec2>(40, 30, glm::dvec2(0.0));
    motion.displacement(18, 6) = glm::dvec2(2.0, 1.0);
    motion.displacement(17, 6) = glm::dvec2(0.0, 5.0);   // no line begins here
    motion.displacement(6, 18) = glm::dvec2(-9.0, 0.0);  // beyond the picture
    draw_motion(picture, motion);
    for (const auto [x, y] : all_pixels(picture)) {
        const bool on_first = x >= 18 && x <= 26 && y >= 6 && y <= 10 && std::abs(y - 6 - 0.5 * (x - 18)) <= 1.0;
        const bool on_second = x <= 7 && (y == 18 || y == 19);
        if (picture(x, y) != Rgb(0.0f)) {
            EXPECT_TRUE(on_first || on_second) << x << ", " << y;
        }
    }
    for (const glm::ivec2 p : {glm::ivec2(18, 6), glm::ivec2(22, 8), glm::ivec2(26, 10), glm::ivec2(0, 18)})
        EXPECT_NE(picture(p.x, p.y), Rgb(0.0f)) << p.x << ", " << p.y;
}

Rgb pixel_of(const ChannelImage& image, int x, int y) {
    return {(*image.find("R"))(x, y), (*image.find("G"))(x, y), (*image.find("B"))(x, y)};
}

void expect_color(const Rgb& found, const Rgb& expected) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.012f) << c;
}

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

TEST(Sheet, APanelReachesNoOther) {
    const ScratchFolder folder;
    for (const auto& [width, height] : {std::pair(1, 1), {2, 1}, {3, 3}, {1, 64}, {80, 60}, {101, 2}, {140, 10}}) {
        SCOPED_TRACE(width);
        const Panel plain{"a caption that is long", Image<Rgb>(width, height, Rgb(0.5f))};
        const Panel map = map_panel("threshold, cd/m2", Image<float>(width, height, 1.0f), {0.1, 100.0, true});
        write_sheet(folder / "plain.png", {plain, plain}, 2, width);
        write_sheet(folder / "map.png", {plain, map}, 2, width);
        const ChannelImage plain_sheet = read_image(folder / "plain.png"), sheet = read_image(folder / "map.png");
        ASSERT_EQ(sheet.find("R")->width, 2 * width);
        int different = 0;
        for (int y = 0; y < sheet.find("R")->height; ++y)
            for (int x = 0; x < width; ++x) different += pixel_of(sheet, x, y) != pixel_of(plain_sheet, x, y) ? 1 : 0;
        EXPECT_EQ(different, 0);
    }
}

TEST(Sheet, AScaleDoesNotCoverTheCaption) {
    const ScratchFolder folder;
    for (const int width : {140, 160, 200, 320}) {
        SCOPED_TRACE(width);
        const Panel map = map_panel("threshold, cd/m2", Image<float>(width, 2, 1.0f), {0.1, 100.0, true});
        const Panel name{map.caption, map.display};
        write_sheet(folder / "map.png", {map, name}, 2, width);
        const ChannelImage sheet = read_image(folder / "map.png");
        // The caption fits beside the scale, or it is all there is.
        int different = 0;
        for (int y = 0; y < caption; ++y)
            for (int x = 0; x < width; ++x) different += pixel_of(sheet, x, y) != pixel_of(sheet, width + x, y) ? 1 : 0;
        EXPECT_EQ(different > 0, width >= 320);
    }
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
