// The built program: exit codes, messages, and the files it leaves.

#include <nlohmann/json.hpp>

#include "engine/base/sampling.h"
#include "tests/render/cli/answers.h"
#include "tests/support/film_programs.h"
#include "tests/support/german_locale.h"
#include "tests/support/grey_image.h"

namespace aleph {
namespace {

Ended run_aleph(const Words& words) {
    const ScratchFolder folder;
    return StartedProgram(words, folder / "log").wait();
}

/// The standard output of the program. @param words  of the shell
std::string printed_by_aleph(const std::string& words) {
    return output_of(fmt::format("'{}' {}", program_path("aleph"), words));
}

/// Two pictures, .5 apart by `step` in one green pixel.
struct TwoPictures {
    ScratchFolder folder;
    std::string a = folder / "a.exr", b = folder / "b.exr";

    explicit TwoPictures(float step) {
        ChannelImage image = grey_image(20, 10, 0.5f);
        write_exr(b, image);
        image.channels[1].values(4, 7) += step;
        write_exr(a, image);
    }
};

void expect_one_error_line(const Ran& ran, int code, const std::string& part) {
    expect_answer(ran, code, part);
    EXPECT_TRUE(ran.errors.starts_with("aleph: error: ")) << ran.errors;
    EXPECT_EQ(std::ranges::count(ran.errors, '\n'), 1) << ran.errors;
    EXPECT_EQ(ran.out, "");
}

TEST(CommandLine, EverySettingHasAnOptionThatCounts) {
    // In the settings of one name, in the fingerprint of a frame: as with --set, and not as without.
    const auto fingerprint = [scene = source_folder() / "scenes/cornell/scene.json"](const std::string& words) {
        return printed_by_aleph(fmt::format("explain '{}' --fingerprint {}", scene.string(), words));
    };
    const std::string plain = fingerprint("");
    for (const auto& [key, value] : {std::pair("stopping", "pixel"), std::pair("adapter_k", "3"), std::pair("spp", "7"),
                                     std::pair("forbid", "caustics")}) {
        std::string option = key;
        std::ranges::replace(option, '_', '-');
        const std::string given = fingerprint(fmt::format("--{} {}", option, value));
        EXPECT_NE(given, plain) << option;
        EXPECT_EQ(given, fingerprint(fmt::format("--set {}={}", key, value))) << option;
    }
    const std::string scene = source_folder() / "scenes/cornell/scene.json";
    for (const Words& wrong : {Words{"--error", "x"}, {"--set", "error=x"}})
        expect_one_error_line(run_command({"explain", scene}, wrong), 2,
                              "aleph: error: --error: expected a number from 0 to 1000; found \"x\"");
}

TEST(CommandLine, HelpVersionAndUsage) {
    EXPECT_TRUE(printed_by_aleph("--version").starts_with("aleph "));
    for (const char* words : {"--help", "compare --help"}) EXPECT_THAT(printed_by_aleph(words), HasSubstr("compare"));
    expect_answer(run_aleph({}), 2, "farm; aleph --help");
    expect_answer(run_aleph({"fly"}), 2, "fly (commands: ");
    expect_answer(run_aleph({"render", "a.json", "--frames", ""}), 2, "--frames: its value is empty");
    expect_answer(run_aleph({"render", ""}), 2, "scene: its value is empty");
}

TEST(CommandLine, CompareTellsSameFromDifferent) {
    const TwoPictures files(0.25f);
    const Ran different = run_command({"compare", files.a, files.b});
    EXPECT_EQ(different.code, 1);
    EXPECT_THAT(different.out, HasSubstr("4,7"));
    EXPECT_TRUE(different.out.ends_with("different\n"));
    const std::vector<std::pair<Words, int>> cases{
        {{"--tolerance", "0.25"}, 0}, {{"--relative", "0.49"}, 1}, {{"--share", "0.5"}, 0}, {{"--channels", "R,B"}, 0}};
    for (const auto& [more, code] : cases) EXPECT_EQ(run_command({"compare", files.a, files.b}, more).code, code);
    const Ran quiet = run_command({"compare", "-q", files.a, files.b});
    EXPECT_EQ(quiet.code, 1);
    EXPECT_EQ(quiet.out, "");
}

TEST(CommandLine, CompareNeverPassesNan) {
    const ScratchFolder folder;
    ChannelImage image = grey_image(4, 4, 0.5f);
    write_exr(folder / "clean.exr", image);
    image.channels[0].values(1, 1) = float_nan;
    write_exr(folder / "nan.exr", image);
    for (const char* other : {"clean.exr", "nan.exr"}) {
        const Ran ran = run_command({"compare", folder / "nan.exr", folder / other, "--share", "100"});
        EXPECT_EQ(ran.code, 1);
        EXPECT_THAT(ran.out, HasSubstr("NaN: "));
    }
}

TEST(CommandLine, MapsOfPicturesWithNanWarnOnce) {
    const ScratchFolder folder;
    ChannelImage image = grey_image(40, 30, 0.5f);
    write_exr(folder / "f.0001.exr", image);
    image.channels[0].values(7, 8) = float_nan;
    write_exr(folder / "f.0002.exr", image);
    write_exr(folder / "f.0003.exr", image);
    const std::string pattern = folder / "f.####.exr";
    expect_answer(run_aleph({"maps", "--images", pattern, "-o", folder / "maps/"}), 0,
                  "warning: 2 pixels of the pictures, the first in frame 2, are NaN");
    EXPECT_EQ(run_aleph({"maps", "--images", pattern, "-q", "-o", folder / "maps/"}).err, "");
}

TEST(CommandLine, CompareAgainstAThresholdMapAsJson) {
    const TwoPictures files(0.02f);  // 1.43 cd/m2 at a white of 100
    const std::string map = files.folder / "maps.exr";
    write_exr(map, {{{"threshold.Y", Image<float>(20, 10, 1.0f)}}, {}});
    const Ran outcome = run_command({"compare", files.a, files.b, "--threshold", map, "--json"});
    EXPECT_EQ(outcome.code, 1);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["same"], false);
    EXPECT_EQ(json["threshold"]["pixels"], 1);
    EXPECT_DOUBLE_EQ(json["threshold"]["percent"], 0.5);
    EXPECT_NEAR(json["threshold"]["worst"].get<double>(), 1.43, 0.001);
    EXPECT_EQ(json["channels"].size(), 3u);
    EXPECT_EQ(json["size"], nlohmann::json({20, 10}));
    write_exr(map, {{{"threshold.Y", Image<float>(20, 10, 1.5f)}}, {}});
    EXPECT_EQ(run_command({"compare", files.a, files.b, "--threshold", map}).code, 0);
}

/// The median of the picture, cd/m2, where every threshold of vision is above it or below.
TEST(CommandLine, CS14_AnUnlikelyUnitOfLightGivesAWarning) {
    const ScratchFolder folder;
    const std::vector<std::pair<double, std::string>> cases{{0.0, ""}, {0.99e-3, "0.00099"}, {1.01e-3, ""},
                                                            {1.0, ""}, {0.99e4, ""},         {1.01e4, "1.01e+04"}};
    for (const auto& [median, said] : cases) {
        // More than half of the picture shines; the rest is a hundred times as bright.
        std::ofstream(folder / "lit.json") << R"({"aleph": 1, "exposure": 0.5, "frames": [0, 1], "nodes": [
            {"translation": [0, 0, 5], "camera": {"fov": 40}},
            {"translation": [51, 0, 1], "shape": {"type": "quad", "size": [100, 100]},
             "material": {"base_color": [0, 0, 0], "specular": 0, "emission": [1, 1, 1], "emission_strength": )"
                                           << median * 2.0 << R"(}},
            {"shape": {"type": "quad", "size": [100, 100]},
             "material": {"base_color": [0, 0, 0], "specular": 0, "emission": [1, 1, 1], "emission_strength": )"
                                           << median * 0.02 << "}}], \"viewing\": {\"display_white\": 100}}";
        std::vector<std::string> render{"render", folder / "lit.json",  "--size", "8x6", "--spp", "1",
                                        "-o",     folder / "f.####.exr"};
        const Ended outcome = run_aleph(render);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const std::string warning = "warning: frame 0: the median luminance is " + said + " cd/m2, outside 1e-3 to 1e4";
        EXPECT_EQ(outcome.err.find("the median luminance") != std::string::npos, !said.empty()) << outcome.err;
        if (said.empty()) continue;
        EXPECT_THAT(outcome.err, HasSubstr(warning));
        EXPECT_EQ(outcome.err.find("median"), outcome.err.rfind("median")) << "once for both frames";
        render.emplace_back("-q");
        EXPECT_EQ(run_aleph(render).err, "");
    }
}

TEST(CommandLine, OU05_FullDiskIsAnErrorAndLeavesNothing) {
    const ScratchFolder folder;
    ChannelImage a = grey_image(300, 200, 0.5f);
    RandomStream random({.seed = 3});
    for (Channel& channel : a.channels) {
        for (float& v : channel.values.pixels) v = random.next();
    }
    write_exr(folder / "a.exr", a);
    write_exr(folder / "b.exr", grey_image(300, 200, 0.5f));
    const std::string picture = folder / "diff.png";
    const std::string command =
        fmt::format("(ulimit -f 40; '{0}' compare -q '{1}/a.exr' '{1}/b.exr' --diff '{2}' 2>&1)", program_path("aleph"),
                    folder.path().string(), picture);
    EXPECT_EQ(output_of(command + "; [ $? = 2 ]"),
              fmt::format("aleph: error: {}: cannot write: File too large\n", picture));
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().extension(), ".exr") << entry.path();
    }
}

TEST(CommandLine, OU05_ResultsThatCannotBePrintedAreAnErrorProgressThatIsLostIsNone) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const TwoPictures files(0.0f);
    const std::string compare = fmt::format("compare '{0}' '{0}'", files.a);
    const auto code_of = [](const std::string& words) {
        return WEXITSTATUS(std::system(fmt::format("'{}' {}", program_path("aleph"), words).c_str()));
    };
    for (const std::string& words : Words{compare, "--help", "--version", "render --help", "study --help"})
        EXPECT_EQ(code_of(words + " >/dev/full 2>/dev/null"), 1) << words;
    EXPECT_EQ(
        code_of(fmt::format("render '{}' --frames 0-2 --size 16x12 --spp 1 -o '{}/' 2>/dev/full >/dev/null",
                            (source_folder() / "scenes/cornell/scene.json").string(), files.folder.path().string())),
        0);
    EXPECT_TRUE(fs::exists(files.folder / "cornell.0002.exr"));
}

TEST(CommandLine, OU06_DifferenceIntoAMissingFolder) {
    const TwoPictures files(0.25f);
    EXPECT_EQ(run_command({"compare", "-q", files.a, files.b, "--diff", files.folder / "no/diff.png"}).code, 1);
    EXPECT_TRUE(fs::exists(files.folder / "no/diff.png"));
    expect_one_error_line(run_command({"compare", "-q", files.a, files.b, "--diff", files.a + "/diff.png"}), 2,
                          "cannot create its folder");
}

TEST(CommandLine, DT09_NumbersDoNotFollowTheLocale) {
    const TwoPictures files(0.25f);
    const auto compare = [&](const std::string& more) {
        return printed_by_aleph(fmt::format("compare '{}' '{}' {}", files.a, files.b, more));
    };
    const std::string json = compare("--json --relative 0.75"), table = compare("--relative 0.75");
    const GermanLocale german;
    if (!german.available()) GTEST_SKIP() << "no locale de_DE.UTF-8, and localedef cannot make one";
    EXPECT_EQ(parse_value<double>("0.5", "--x"), 0.5);
    EXPECT_THROW(parse_value<double>("0,5", "--x"), CLI::ConversionError);
    EXPECT_EQ(compare("--json --relative 0.75"), json);
    EXPECT_EQ(compare("--relative 0.75"), table);
    EXPECT_EQ(run_aleph({"compare", files.a, files.b, "--relative", "0,75"}).code, 2);
    // The same inside a program that has set its locale.
    ChannelImage image = read_image(files.a);
    image.metadata["exposure"] = 0.5;
    const std::string inside = files.folder / "inside.exr";
    write_exr(inside, image);
    EXPECT_EQ(std::get<double>(read_image(inside).metadata.at("exposure")), 0.5);
}

/// Options that could not both have their way.
class TwoOptions : public ProgramTest {};

TEST_F(TwoOptions, OfWhichOneWouldBeIgnoredAreRefused) {
    const std::string model = folder_ / "cornell.glb", scene = (source_folder() / "scenes/cornell/scene.json").string();
    expect_answer(run({"explain", scene, "--at", ".5", "--json", "--fingerprint"}), 2, "--fingerprint excludes --at");
    ASSERT_EQ(run({"export", scene, "-q", "--bake", "-o", model}).code, 0);
    expect_answer(run({"export", model, "--bake", "-o", folder_ / "bake.json"}), 2,
                  "--bake: a .json includes other files");
    EXPECT_EQ(run({"export", model, "-q", "-o", folder_ / "bake.json"}).code, 0);
}

}  // namespace
}  // namespace aleph
