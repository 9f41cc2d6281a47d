// `aleph preview`: film and sheet of a long shot, lines of motion, and what is left without ffmpeg.

#include "render/output/sheet.h"
#include "tests/render/cli/answers.h"
#include "tests/support/film_programs.h"

namespace aleph {
namespace {

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
    const int caption = 26;
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
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const bool on_first = x >= 18 && x <= 26 && y >= 6 && y <= 10 && std::abs(y - 6 - 0.5 * (x - 18)) <= 1.0;
            const bool on_second = x <= 7 && (y == 18 || y == 19);
            if (picture(x, y) != Rgb(0.0f)) {
                EXPECT_TRUE(on_first || on_second) << x << ", " << y;
            }
        }
    }
    for (const glm::ivec2 p : {glm::ivec2(18, 6), glm::ivec2(22, 8), glm::ivec2(26, 10), glm::ivec2(0, 18)})
        EXPECT_NE(picture(p.x, p.y), Rgb(0.0f)) << p.x << ", " << p.y;
}

}  // namespace
}  // namespace aleph
