// The built program: exit codes, messages, and the files it leaves.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "engine/base/sampling.h"
#include "engine/image/image_file.h"
#include "render/cli/support/options.h"
#include "tests/support/german_locale.h"
#include "tests/support/grey_image.h"
#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

struct Outcome {
    int code = -1;  ///< -1 if a signal ended it
    std::string out, err;
};

/// Runs the program. @param file_limit  largest size of a file it may write, bytes
Outcome run_aleph(std::vector<std::string> arguments, rlim_t file_limit = RLIM_INFINITY) {
    const ScratchFolder folder;
    const std::string out = folder / "out", err = folder / "err";
    arguments.insert(arguments.begin(), program_path("aleph"));
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        rlimit limit{};
        ::getrlimit(RLIMIT_FSIZE, &limit);
        limit.rlim_cur = std::min(limit.rlim_max, file_limit);
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::execv(argv.front(), argv.data());
        ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_bytes(out), read_bytes(err)};
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

void expect_one_error_line(const Outcome& outcome, const std::string& part) {
    EXPECT_TRUE(outcome.err.starts_with("aleph: error: ")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
}

TEST(CommandLine, EverySettingHasAnOptionThatCounts) {
    // In the settings of one name, in the fingerprint of a frame: as with --set, and not as without.
    const auto fingerprint = [](std::vector<std::string> words) {
        words.insert(words.begin(),
                     {"explain", (source_folder() / "scenes/cornell/scene.json").string(), "--fingerprint"});
        const Outcome outcome = run_aleph(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out;
    };
    const std::string plain = fingerprint({});
    for (const auto& [key, value] : {std::pair("stopping", "pixel"), std::pair("adapter_k", "3"), std::pair("spp", "7"),
                                     std::pair("forbid", "caustics")}) {
        std::string option = key;
        std::ranges::replace(option, '_', '-');
        const std::string given = fingerprint({"--" + option, value});
        EXPECT_NE(given, plain) << option;
        EXPECT_EQ(given, fingerprint({"--set", std::string(key) + "=" + value})) << option;
    }
}

TEST(CommandLine, HelpAndVersion) {
    const Outcome version = run_aleph({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_TRUE(version.out.starts_with("aleph ")) << version.out;
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"}, {"compare", "--help"}}) {
        const Outcome help = run_aleph(arguments);
        EXPECT_EQ(help.code, 0);
        EXPECT_NE(help.out.find("compare"), std::string::npos);
        EXPECT_EQ(help.err, "");
    }
}

TEST(CommandLine, BadUsageIsExitCode2) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{}, "farm; aleph --help"},
        {{"fly"}, "fly (commands: "},
        {{"compare", "a.exr", "b.exr", "--fast"}, "--fast (aleph compare --help"},
        {{"compare", "a.exr", "b.exr", "--share", "much"}, "--share: 'much' is not a number"},
        {{"compare", "a.exr", "b.exr", "--share", "101"}, "--share lies in 0 to 100"}};
    for (const auto& [arguments, part] : cases) {
        const Outcome outcome = run_aleph(arguments);
        EXPECT_EQ(outcome.code, 2);
        expect_one_error_line(outcome, part);
    }
}

TEST(CommandLine, CompareTellsSameFromDifferent) {
    const TwoPictures files(0.25f);
    const Outcome different = run_aleph({"compare", files.a, files.b});
    EXPECT_EQ(different.code, 1);
    EXPECT_NE(different.out.find("4,7"), std::string::npos) << different.out;
    EXPECT_TRUE(different.out.ends_with("different\n"));
    EXPECT_EQ(run_aleph({"compare", files.a, files.b, "--tolerance", "0.25"}).code, 0);
    EXPECT_EQ(run_aleph({"compare", files.a, files.b, "--relative", "0.49"}).code, 1);
    EXPECT_EQ(run_aleph({"compare", files.a, files.b, "--share", "0.5"}).code, 0);
    EXPECT_EQ(run_aleph({"compare", "--channels", "R,B", files.a, files.b}).code, 0);
    const Outcome quiet = run_aleph({"compare", "-q", files.a, files.b});
    EXPECT_EQ(quiet.code, 1);
    EXPECT_EQ(quiet.out, "");
}

TEST(CommandLine, CompareNeverPassesNan) {
    const ScratchFolder folder;
    ChannelImage image = grey_image(4, 4, 0.5f);
    write_exr(folder / "clean.exr", image);
    image.channels[0].values(1, 1) = float_nan;
    write_exr(folder / "nan.exr", image);
    const std::string clean = folder / "clean.exr", nan = folder / "nan.exr";
    for (const auto& [a, b] : {std::pair{nan, clean}, {nan, nan}}) {
        const Outcome outcome = run_aleph({"compare", a, b, "--share", "100"});
        EXPECT_EQ(outcome.code, 1);
        EXPECT_NE(outcome.out.find("NaN: "), std::string::npos);
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
    const Outcome outcome = run_aleph({"maps", "--images", pattern, "-o", folder / "maps/"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("warning: 2 pixels of the pictures, the first in frame 2, are NaN"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(run_aleph({"maps", "--images", pattern, "-q", "-o", folder / "maps/"}).err, "");
}

TEST(CommandLine, CompareOfOtherShapesIsExitCode2) {
    const ScratchFolder folder;
    write_exr(folder / "a.exr", grey_image(4, 4, 0.5f));
    write_exr(folder / "wide.exr", grey_image(5, 4, 0.5f));
    ChannelImage more = grey_image(4, 4, 0.5f);
    more.channels.push_back({"Z", Image<float>(4, 4)});
    write_exr(folder / "more.exr", more);
    std::ofstream(folder / "text.exr") << "no picture";
    const std::string a = folder / "a.exr";
    for (const char* other : {"wide.exr", "more.exr", "text.exr", "missing.exr"}) {
        const Outcome outcome = run_aleph({"compare", a, folder / other});
        EXPECT_EQ(outcome.code, 2) << other;
        expect_one_error_line(outcome, "");
    }
}

TEST(CommandLine, CompareAgainstAThresholdMapAsJson) {
    const TwoPictures files(0.02f);  // 1.43 cd/m2 at a white of 100
    const std::string map = files.folder / "maps.exr";
    write_exr(map, {{{"threshold.Y", Image<float>(20, 10, 1.0f)}}, {}});
    const Outcome outcome = run_aleph({"compare", files.a, files.b, "--threshold", map, "--json"});
    EXPECT_EQ(outcome.code, 1);
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["same"], false);
    EXPECT_EQ(json["threshold"]["pixels"], 1);
    EXPECT_DOUBLE_EQ(json["threshold"]["percent"], 0.5);
    EXPECT_NEAR(json["threshold"]["worst"].get<double>(), 1.43, 0.001);
    EXPECT_EQ(json["channels"].size(), 3u);
    EXPECT_EQ(json["size"], nlohmann::json({20, 10}));
    write_exr(map, {{{"threshold.Y", Image<float>(20, 10, 1.5f)}}, {}});
    EXPECT_EQ(run_aleph({"compare", files.a, files.b, "--threshold", map}).code, 0);
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
        const Outcome outcome = run_aleph(render);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const std::string warning = "warning: frame 0: the median luminance is " + said + " cd/m2, outside 1e-3 to 1e4";
        EXPECT_EQ(outcome.err.find("the median luminance") != std::string::npos, !said.empty()) << outcome.err;
        if (said.empty()) continue;
        EXPECT_NE(outcome.err.find(warning), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.find("median"), outcome.err.rfind("median")) << "once for both frames";
        render.emplace_back("-q");
        EXPECT_EQ(run_aleph(render).err, "");
    }
}

TEST(CommandLine, OU03_WhatHdrFilesCannotHoldIsCounted) {
    const ScratchFolder folder;
    // Red of 1e46, beyond single precision, in two frames of 48 pixels.
    std::ofstream(folder / "bright.json") << R"({"aleph": 1, "exposure": 1e18, "frames": [0, 1], "nodes": [
        {"translation": [0, 0, 5], "camera": {"fov": 40}},
        {"shape": {"type": "quad", "size": [100, 100]},
         "material": {"base_color": [0, 0, 0], "emission": [1e18, 1, 1], "emission_strength": 1e10}}]})";
    const std::vector<std::string> render{"render", folder / "bright.json", "--size", "8x6", "--spp", "1",
                                          "-o",     folder / "f.####.hdr"};
    const Outcome said = run_aleph(render);
    EXPECT_EQ(said.code, 0) << said.err;
    EXPECT_NE(said.err.find("warning: 96 values were"), std::string::npos) << said.err;
    const ChannelImage image = read_image(folder / "f.0001.hdr");
    EXPECT_EQ(image.find("R")->pixels[7], 0xffp119f);
    std::vector<std::string> quiet = render;
    quiet.emplace_back("-q");
    EXPECT_EQ(run_aleph(quiet).err, "");
    const Outcome refused = run_aleph({"maps", folder / "bright.json", "-o", folder / "m.####.hdr"});
    EXPECT_EQ(refused.code, 2);
    expect_one_error_line(refused, "write .exr");
}

TEST(CommandLine, OU05_FullDiskIsExitCode1AndLeavesNothing) {
    const ScratchFolder folder;
    ChannelImage a = grey_image(300, 200, 0.5f);
    RandomStream random({.seed = 3});
    for (Channel& channel : a.channels) {
        for (float& v : channel.values.pixels) v = random.next();
    }
    write_exr(folder / "a.exr", a);
    write_exr(folder / "b.exr", grey_image(300, 200, 0.5f));
    const std::string picture = folder / "diff.png";
    const Outcome outcome = run_aleph({"compare", "-q", folder / "a.exr", folder / "b.exr", "--diff", picture}, 20'000);
    EXPECT_EQ(outcome.code, 1);
    expect_one_error_line(outcome, picture + ": cannot write: File too large");
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().extension(), ".exr") << entry.path();
    }
}

TEST(CommandLine, OU05_ResultsThatCannotBePrintedAreAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
    const TwoPictures files(0.0f);
    const std::string command = std::string("'") + program_path("aleph") + "' compare '" + files.a + "' '" + files.a +
                                "' >/dev/full 2>/dev/null";
    EXPECT_EQ(WEXITSTATUS(::system(command.c_str())), 1);
}

TEST(CommandLine, OU06_DifferenceIntoAMissingFolder) {
    const TwoPictures files(0.25f);
    const Outcome outcome = run_aleph({"compare", "-q", files.a, files.b, "--diff", files.folder / "no/diff.png"});
    EXPECT_EQ(outcome.code, 1);
    expect_one_error_line(outcome, "does not exist");
}

TEST(CommandLine, DT09_NumbersDoNotFollowTheLocale) {
    const TwoPictures files(0.25f);
    const std::vector<std::string> arguments{"compare", files.a, files.b, "--json", "--relative", "0.75"};
    const Outcome plain = run_aleph(arguments);
    EXPECT_EQ(plain.code, 0) << plain.err;
    const Outcome plain_table = run_aleph({"compare", files.a, files.b});
    const GermanLocale german;
    if (!german.available()) GTEST_SKIP() << "no locale de_DE.UTF-8, and localedef cannot make one";
    EXPECT_EQ(parse_value<double>("0.5", "--x"), 0.5);
    EXPECT_THROW(parse_value<double>("0,5", "--x"), CLI::ConversionError);
    const Outcome outcome = run_aleph(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, plain.out);
    EXPECT_EQ(run_aleph({"compare", files.a, files.b}).out, plain_table.out);
    EXPECT_EQ(run_aleph({"compare", files.a, files.b, "--relative", "0,75"}).code, 2);
    // The same inside a program that has set its locale.
    ChannelImage image = read_image(files.a);
    image.metadata["exposure"] = 0.5;
    const std::string inside = files.folder / "inside.exr";
    write_exr(inside, image);
    EXPECT_EQ(std::get<double>(read_image(inside).metadata.at("exposure")), 0.5);
}

}  // namespace
}  // namespace aleph
