// `--crop`: files of a window, what reads them, and windows that are refused.

#include "engine/image/image_file.h"
#include "render/cli/scene_options.h"
#include "tests/render/cli/answers.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

class Crop : public RenderCommand {
  protected:
    /// Pixels that share no light.
    int render(const char* output, const Words& more) {
        return run({"--size", "16x12", "--integrator", "path", "--spp", "2", "--frames", "3", "-o", file(output)},
                   more);
    }
    Ran compare(const char* a, const char* b, const Words& more = {}) {
        return run_command({"compare", file(a), file(b)}, more);
    }
};

TEST_F(Crop, KeepsItsPlaceInEXRAndAloneIsThePNG) {
    ASSERT_EQ(render("part.exr", {"--crop", "4,13,2,7"}), exit_done) << errors;
    const ChannelImage part = read_image(file("part.exr"));
    EXPECT_EQ(part.whole, (PictureArea{-4, -2, 16, 12}));
    EXPECT_EQ(part.find("R")->width, 9);
    EXPECT_EQ(part.find("R")->height, 5);
    ASSERT_EQ(render("part.png", {"--crop", "4,13,2,7"}), exit_done) << errors;
    EXPECT_EQ(read_image(file("part.png")).find("R")->width, 9);
    EXPECT_EQ(read_image(file("part.png")).find("R")->height, 5);
}

TEST_F(Crop, OfMapsKeepsItsPlaceToo) {
    const std::string scene = (source_folder() / "scenes/cornell/scene.json").string();
    for (const Words& more : {Words{}, Words{"--importance"}}) {
        const Words words{"maps", scene, "-q", "--size", "16x12", "--frames", "3"};
        ASSERT_EQ(run_command(joined(words, more), {"-o", file("whole.exr")}).code, exit_done);
        ASSERT_EQ(run_command(joined(words, more), {"-o", file("part.exr"), "--crop", "4,13,2,7"}).code, exit_done);
        EXPECT_EQ(compare("whole.exr", "part.exr").code, exit_done);
        EXPECT_EQ(read_image(file("part.exr")).whole, (PictureArea{-4, -2, 16, 12}));
    }
    expect_answer(run_command({"maps", "--images", file("whole.exr"), "--crop", "0,4,0,4"}), exit_bad_input,
                  "--crop: this needs a scene");
}

TEST_F(Crop, IsComparedWhereBothHavePixels) {
    ASSERT_EQ(render("whole.exr", {"--aovs"}), exit_done) << errors;
    ASSERT_EQ(render("part.exr", {"--aovs", "--crop", "4,13,2,7"}), exit_done) << errors;
    ASSERT_EQ(render("beside.exr", {"--aovs", "--crop", "12,16,6,12"}), exit_done) << errors;
    ASSERT_EQ(render("apart.exr", {"--aovs", "--crop", "13,16,7,12"}), exit_done) << errors;
    EXPECT_EQ(compare("whole.exr", "part.exr").code, exit_done) << "every channel, byte for byte";
    EXPECT_EQ(compare("part.exr", "whole.exr", {"--threshold", file("whole.exr")}).code, exit_done);
    EXPECT_EQ(compare("part.exr", "beside.exr").code, exit_done) << "one pixel";
    expect_answer(compare("part.exr", "apart.exr"), exit_bad_input, "have no pixel in common");
    ASSERT_EQ(render("other.exr", {"--aovs", "--crop", "4,13,2,7", "--seed", "1"}), exit_done) << errors;
    EXPECT_EQ(compare("whole.exr", "other.exr").code, exit_different);
    ASSERT_EQ(render("small.exr", {"--aovs", "--size", "8x6"}), exit_done) << errors;
    expect_answer(compare("part.exr", "small.exr"), exit_bad_input, "differ in size: 9x5 and 8x6");
}

TEST_F(Crop, OfAnotherWindowIsMadeAgain) {
    ASSERT_EQ(render("a.exr", {"--crop", "0,4,0,4", "--resume"}), exit_done) << errors;
    const std::string first = read_bytes(file("a.exr"));
    const auto time = fs::last_write_time(file("a.exr"));
    ASSERT_EQ(render("a.exr", {"--crop", "0,4,0,4", "--resume"}), exit_done) << errors;
    EXPECT_EQ(fs::last_write_time(file("a.exr")), time) << "it was finished";
    ASSERT_EQ(render("a.exr", {"--crop", "0,4,0,5", "--resume"}), exit_done) << errors;
    EXPECT_EQ(read_image(file("a.exr")).find("R")->height, 5);
    ASSERT_EQ(render("a.exr", {"--resume"}), exit_done) << errors;
    EXPECT_EQ(read_image(file("a.exr")).whole, std::nullopt);
}

TEST_F(Crop, OutsideOrEmptyIsRefused) {
    for (const char* text : {"", "0,4,0", "0,4,0,4,5", "4,4,0,4", "5,4,0,4", "-1,4,0,4", "0,17,0,4", "0,4,0,13",
                             "0,4,12,13", "a,4,0,4", "0.5,4,0,4", "0,4,0,99999999999"}) {
        EXPECT_EQ(render("a.exr", {"--crop", text}), exit_bad_input) << text;
        EXPECT_THAT(errors, HasSubstr("--crop"));
        EXPECT_EQ(std::ranges::count(errors, '\n'), 1) << errors;
        EXPECT_FALSE(fs::exists(file("a.exr"))) << text;
    }
    EXPECT_EQ(render("a.exr", {"--crop", "0,17,0,4"}), exit_bad_input);
    EXPECT_THAT(errors, HasSubstr("within the picture of 16x12"));
    for (const Words& other : {Words{"--budget", "9"}, Words{"--verify", "1"}}) {
        const Words words = joined({"--crop", "0,4,0,4"}, other);
        EXPECT_EQ(run({"-o", file("a.exr")}, words), exit_bad_input);
        EXPECT_THAT(errors, HasSubstr("--crop: give one of the two"));
    }
}

}  // namespace
}  // namespace aleph
