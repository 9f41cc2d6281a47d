// `aleph compare` of sequences, without starting the program.

#include <nlohmann/json.hpp>

#include "engine/image/image_file.h"
#include "render/settings/frame_pattern.h"
#include "tests/render/cli/answers.h"
#include "tests/support/grey_image.h"

namespace aleph {
namespace {

ChannelImage grey(float value, int width = 6, int height = 5) {
    return grey_image(width, height, value);
}

/// Two sequences and the maps of the second. The first is brighter by `steps`.
struct Sequences {
    ScratchFolder folder;
    std::string a = folder / "a", b = folder / "b", maps = folder / "maps";
    std::string pattern_a = a + "/new.####.exr", pattern_b = b + "/old.####.exr", pattern_maps = maps + "/m.####.exr";

    Sequences(const std::vector<int>& frames, const std::vector<float>& steps) {
        for (const std::string& each : {a, b, maps}) fs::create_directory(each);
        const auto flat = [](const char* name, float value) { return Channel{name, Image<float>(6, 5, value)}; };
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const std::string number = fmt::format("{:04}", frames[i]);
            write_exr(a + "/new." + number + ".exr", grey(0.5f + steps[i]));
            write_exr(b + "/old." + number + ".exr", grey(0.5f));
            write_exr(maps + "/m." + number + ".exr", {{flat("forward.u", 0.0f), flat("forward.v", 0.0f),
                                                        flat("motion.valid", 1.0f), flat("threshold.Y", 1.0f)},
                                                       {}});
        }
    }
};

TEST(CompareFrames, PatternsAndFoldersArePairedByNumber) {
    const Sequences s({8, 9, 10}, {0.0f, 0.25f, 0.0f});
    for (const auto& [first, second] : {std::pair{s.pattern_a, s.pattern_b}, {s.a, s.b}, {s.a, s.pattern_b}}) {
        const Ran outcome = run_command({"compare"}, {first, second});
        EXPECT_EQ(outcome.code, 1) << outcome.errors;
        EXPECT_THAT(outcome.out, HasSubstr("1 of 3 frames differ; the largest difference is in frame 9"));
        EXPECT_TRUE(outcome.out.ends_with("different\n"));
    }
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "--tolerance", "0.25"}).code, 0);
    EXPECT_THAT(run_command({"compare"}, {s.b, s.b}).out, HasSubstr("0 of 3 frames differ\n"));
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "--tolerance", "0.25", "--max-rms", "0.2"}).code, 1);
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "-q"}).out, "");
    const Ran limits = run_command({"compare"}, {s.a, s.b, "--share", "100", "--max-error", "0.2"});
    EXPECT_THAT(limits.out, HasSubstr("different (--max-error)"));
}

TEST(CompareFrames, ResultsAsJunit) {
    const Sequences s({8, 9, 10}, {0.0f, 0.25f, 0.0f});
    const std::string file = s.folder / "results.xml";
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "-q", "--junit", file}).code, 1);
    const std::string text = read_bytes(file);
    EXPECT_TRUE(text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"3\" failures=\"1\">"))
        << text;
    EXPECT_THAT(
        text,
        HasSubstr("new.0009.exr\">\n      <failure message=\"100 % of the pixels are beyond the tolerance, allowed 0 "
                  "%; largest difference 0.25 in B at 0,0\"/>"));
    EXPECT_THAT(text, HasSubstr("new.0010.exr\"/>"));
    EXPECT_EQ(run_command({"compare"}, {s.a + "/new.0008.exr", s.b + "/old.0008.exr", "-q", "--junit", file}).code, 0);
    EXPECT_THAT(read_bytes(file), HasSubstr("tests=\"1\" failures=\"0\""));
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "-q", "--junit", s.a + "/new.0008.exr"}).code, 2) << "an input";
    // Folders are made, and a file that cannot be written is no difference.
    EXPECT_EQ(run_command({"compare"}, {s.b, s.b, "-q", "--junit", s.folder / "new/folder/results.xml"}).code, 0);
    EXPECT_TRUE(fs::exists(s.folder / "new/folder/results.xml"));
    expect_answer(run_command({"compare"}, {s.b, s.b, "--junit", file + "/below.xml"}), 2, "below.xml");
    expect_answer(run_command({"compare"}, {s.b, s.b, "--diff", file + "/below.####.png"}), 2, "below.0008.png");
    // A speck on one pixel, which a viewer sees.
    ChannelImage speck = grey(0.9f);
    for (Channel& channel : speck.channels) channel.values(3, 2) = 0.1f;
    write_exr(s.a + "/new.0009.exr", speck);
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "-q", "--seen", s.maps, "--share", "1", "--junit", file}).code, 1);
    EXPECT_THAT(read_bytes(file), HasSubstr("100 % of the pixels are seen to differ, allowed 1 %"));
    // A file that cannot be compared is a failure, too.
    std::ofstream(s.b + "/old.0009.exr") << "none";
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "-q", "--junit", file}).code, 2);
    EXPECT_THAT(read_bytes(file), HasSubstr("tests=\"2\" failures=\"1\""));
    EXPECT_THAT(read_bytes(file), HasSubstr("new.0009.exr\">\n      <failure message=\""));
}

TEST(CompareFrames, MissingPartnersAreNamed) {
    const Sequences s({1, 2, 3, 4, 5, 6}, {0, 0, 0, 0, 0, 0});
    for (const char* gone : {"a/new.0005.exr", "b/old.0001.exr", "b/old.0002.exr", "b/old.0004.exr", "maps/m.0003.exr"})
        fs::remove(s.folder / gone);
    const Ran outcome = run_command({"compare"}, {s.a, s.b});
    expect_answer(outcome, 2, "b' has no frame 1-2,4; '");
    EXPECT_THAT(outcome.errors, HasSubstr("a' has no frame 5"));
    EXPECT_EQ(outcome.out, "");
    expect_answer(run_command({"compare"}, {s.b, s.b, "--threshold", s.pattern_maps}), 2, "m.####.exr' has no frame 3");
}

TEST(CompareFrames, VisibleDifferencesAsJsonTextAndPictures) {
    const Sequences s({3, 4, 6}, {0.0f, 0.25f, 0.25f});
    ChannelImage dark = grey(0.9f);
    for (Channel& channel : dark.channels) channel.values(3, 2) = 0.1f;
    write_exr(s.a + "/new.0004.exr", dark);
    const Ran outcome =
        run_command({"compare"}, {s.a, s.b, "--seen", s.maps, "--json", "--seen-out", s.folder / "seen.####.exr"});
    EXPECT_EQ(outcome.code, 1) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(json["frames"].size(), 3u);
    EXPECT_EQ(json["frames"][1]["same"], false);
    EXPECT_EQ(json["frames"][1]["visible"]["seen"], 100.0);
    EXPECT_TRUE(json["frames"][1]["visible"]["noticed"].is_null());
    EXPECT_GT(json["all"]["visible"]["flicker"].get<double>(), 0.0);
    const ChannelImage seen = read_image(s.folder / "seen.0004.exr");
    EXPECT_GT(seen.find("seen.Y")->operator()(3, 2), 1.0f);
    EXPECT_NE(seen.find("flicker.Y"), nullptr);
    EXPECT_NE(seen.find("lasting.Y"), nullptr);
    const Ran text = run_command({"compare"}, {s.a, s.b, "--seen", s.maps});
    EXPECT_THAT(text.out, HasSubstr("seen   flicker   lasting   noticed"));
    EXPECT_EQ(run_command({"compare"}, {s.a, s.b, "--seen", s.maps, "--share", "100"}).code, 0);
    const std::string a = s.a + "/new.0004.exr", b = s.b + "/old.0004.exr", maps = s.maps + "/m.0004.exr";
    const Ran one = run_command({"compare"}, {a, b, "--seen", maps, "--seen-out", s.folder / "seen.png"});
    EXPECT_EQ(one.code, 1);
    EXPECT_THAT(one.out, HasSubstr("a difference is seen in  100 % of the pixels"));
    EXPECT_TRUE(fs::exists(s.folder / "seen.png"));
}

TEST(CompareFrames, CutsThatAreNoFramesGiveAWarning) {
    const Sequences s({3, 4, 6}, {0.0f, 0.0f, 0.0f});
    const auto warning_of = [&](const std::vector<std::string>& options) {
        testing::internal::CaptureStderr();
        EXPECT_EQ(run_command({"compare", s.a, s.b, "--cuts"}, options).code, 0);
        return testing::internal::GetCapturedStderr();
    };
    const std::string range = " lies outside the shot, which has the frames 3 to 6\n";
    EXPECT_EQ(warning_of({"-5,4"}), "aleph: warning: --cuts: frame -5" + range);
    EXPECT_EQ(warning_of({"4,7"}), "aleph: warning: --cuts: frame 7" + range);
    EXPECT_EQ(warning_of({"4,7", "-q"}), "");
    EXPECT_EQ(warning_of({"3-6"}), "");
}

TEST(CompareFrames, WrongKindsAreRefused) {
    const Sequences s({1, 2}, {0.0f, 0.0f});
    const std::string picture = s.a + "/new.0001.exr", maps = s.maps + "/m.0001.exr";
    std::ofstream(s.b + "/notes.txt") << "no picture";
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{s.a, picture}, "is a sequence and '"},
        {{"nowhere/", s.b}, "there is no file or folder 'nowhere/'"},
        {{s.a, s.folder / "none.exr"}, "there is no file or folder '"},
        {{s.a, s.b, "--seen", s.b}, "old.0001.exr: --seen: has no channel 'forward.u'"},
        {{picture, picture, "--seen", picture}, "--seen: has no channel 'forward.u'"},
        {{s.a, s.b, "--threshold", maps}, "one file cannot serve several frames"},
        {{s.a, s.b, "--seen", maps}, "one file cannot serve several frames"},
        {{s.a, s.b, "--diff", s.folder / "diff.png"}, "diff.####.png"},
        {{s.a, s.b, "--seen", s.maps, "--seen-out", s.folder / "seen.png"}, "--seen-out"},
        {{s.a, s.b, "--seen-out", s.folder / "seen.####.png"}, "needs --seen"},
        {{picture, picture, "--diff", s.folder / "where.exr"}, "expected a name that ends in .png"},
        {{picture, picture, "--seen", maps, "--seen-out", s.folder / "seen.jpg"}, "ends in .png or .exr"},
        {{picture, picture, "--seen", maps, "--seen-out", s.folder / "seen"}, "ends in .png or .exr"},
        {{picture, picture, "--seen", s.maps}, "one picture: name the file of its maps"},
        {{picture, picture, "--threshold", s.pattern_maps}, "one picture: name the file of its maps"},
        {{s.a, s.b, "--cuts", "x"}, "--cuts"},
        {{picture, picture, "--cuts", "2"}, "--cuts"},
        {{s.a, s.folder / "none.####.exr"}, "no file fits"},
        {{s.a, s.folder.path().string()}, "holds no numbered pictures"},
        {{s.a, s.b, "--max-rms", "-1"}, "--max-rms"},
        {{s.a, s.b, "--share", "101"}, "--share: lies in 0 to 100"},
        {{s.a, s.b, "--tolerance", "-1"}, "--tolerance: must not be negative"},
        {{s.a, s.b, "--threshold", s.b}, "old.0001.exr: --threshold: has no channel 'threshold.Y'"},
        {{picture, s.b + "/notes.txt"}, "notes.txt"},
        {{s.a, s.b, "--standard-errors", "3"}, "variance.Y"},
        {{s.a, s.b, "--standard-errors", "3", "--seen", s.maps}, "give one of them"}};
    for (const auto& [arguments, part] : cases) {
        expect_answer(run_command({"compare"}, arguments), 2, part);
    }
    write_exr(s.b + "/old.0002.exr", grey(0.5f, 7, 5));
    expect_answer(run_command({"compare"}, {s.a, s.b}), 2, "new.0002.exr: the pictures differ in size");
}

TEST(CompareFrames, ExistingFilesArePicturesWhateverTheirName) {
    const ScratchFolder folder;
    const std::string odd = folder / "take #2.exr";
    write_exr(odd, grey(0.5f));
    const Ran outcome = run_command({"compare"}, {odd, odd});
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    EXPECT_THAT(outcome.out, Not(HasSubstr("frames")));
}

TEST(CompareFrames, DifferencesOfEveryFrame) {
    const Sequences s({1, 2}, {0.0f, 0.25f});
    run_command({"compare"}, {s.a, s.b, "-q", "--diff", s.folder / "diff.##.png"});
    EXPECT_TRUE(fs::exists(s.folder / "diff.01.png"));
    EXPECT_TRUE(fs::exists(s.folder / "diff.02.png"));
}

TEST(CompareFrames, NoiseOfTheReferenceIsPrinted) {
    const ScratchFolder folder;
    ChannelImage reference = grey(0.5f);
    reference.channels.push_back({"variance.Y", Image<float>(6, 5, 4e-4f)});  // a standard error of 2 cd/m2
    write_exr(folder / "b.exr", reference);
    write_exr(folder / "a.exr", grey(0.52f));
    write_exr(folder / "maps.exr", {{{"threshold.Y", Image<float>(6, 5, 1.0f)}}, {}});
    const Ran outcome =
        run_command({"compare"}, {folder / "a.exr", folder / "b.exr", "--threshold", folder / "maps.exr"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("0 % by more than 3 standard errors; by noise alone 61.7"));
    EXPECT_THAT(outcome.out, HasSubstr("bias 4 %"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("tolerance"))) << "it does not count";
    EXPECT_EQ(run_command({"compare"}, {folder / "a.exr", folder / "b.exr", "--standard-errors", "2"}).code, 0);
}

TEST(FramePattern, FoldersHoldOneSequence) {
    const ScratchFolder folder;
    const auto touch = [&](const char* name) { std::ofstream(folder / name) << "x"; };
    const std::string path = folder.path().string();
    EXPECT_THROW(find_folder_frames(path, "first"), InputError);
    for (const char* name : {"s.-003.exr", "s.0001.exr", "s.12345.exr", "stats.json", "readme.txt"}) touch(name);
    const auto files = find_folder_frames(path, "first");
    ASSERT_EQ(files.size(), 3u);
    EXPECT_EQ(files.at(-3).filename(), "s.-003.exr");
    EXPECT_EQ(files.at(12345).filename(), "s.12345.exr");
    touch("s.1.exr");
    EXPECT_THROW(find_folder_frames(path, "first"), InputError);
    fs::remove(folder / "s.1.exr");
    touch("t.0001.exr");
    const std::string message = find_refusal([&] { find_folder_frames(path, "first"); }).message;
    EXPECT_THAT(message, HasSubstr("s.#.exr and t.#.exr"));
    const ScratchFolder dashes;
    std::ofstream(dashes / "shot-0007.png") << "x";
    EXPECT_EQ(find_folder_frames(dashes.path().string(), "first").begin()->first, 7);
}

}  // namespace
}  // namespace aleph
