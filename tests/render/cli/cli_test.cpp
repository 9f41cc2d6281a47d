// Options, progress and exit codes, without starting the program.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "render/cli/commands.h"
#include "render/cli/scene_options.h"
#include "render/cli/support/options.h"
#include "render/cli/support/progress.h"
#include "render/settings/setting_table.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Options, NumbersAreReadWhole) {
    EXPECT_EQ(parse_value<double>("0.5", "--x"), 0.5);
    EXPECT_EQ(parse_value<double>("-1e-3", "--x"), -0.001);
    EXPECT_EQ(parse_value<int>("-12", "--x"), -12);
    EXPECT_EQ(parse_value<int>("010", "--x"), 10);  // not octal
    EXPECT_EQ(parse_value<std::uint32_t>("4294967295", "--x"), 4294967295u);
    for (const char* text : {"", "0,5", "1 ", " 1", "1e999", "nan", "inf", "0x1p3", "one"}) {
        EXPECT_THROW(parse_value<double>(text, "--x"), CLI::ConversionError) << text;
    }
    for (const char* text : {"", "1.0", "2147483648", "-", "0x10", "+1"}) {
        EXPECT_THROW(parse_value<int>(text, "--x"), CLI::ConversionError) << text;
    }
    EXPECT_THROW(parse_value<std::uint32_t>("-1", "--x"), CLI::ConversionError);
}

TEST(Options, SetTakesTheViewingConditions) {
    Scene scene;
    SettingMap settings = {{"viewing.persistence", 0.1}, {"viewing.display_white", 200.0}, {"spp", 4.0}};
    set_scene_numbers(scene, settings, "--set");
    EXPECT_EQ(scene.film.viewing, (ViewingConditions{31.0, 200.0, 0.1}));
    EXPECT_EQ(settings, (SettingMap{{"spp", 4.0}}));
    for (const double bad : {2.0, 0.0, -1.0}) {
        settings = {{"viewing.persistence", bad}};
        EXPECT_THROW(set_scene_numbers(scene, settings, "--set"), InputError) << bad;
    }
}

/// Runs a program with options of every kind and a frame list that starts with a minus.
struct Program {
    CLI::App app{"test"};
    double number = 0.25;
    int whole = 3;
    std::string frames, file;
    bool flag = false;
    Command command;
    std::ostringstream errors;

    Program() {
        CLI::App* go = app.add_subcommand("go");
        add_value(*go, "--number", number, "a number");
        add_value(*go, "-w,--whole", whole, "a whole number");
        go->add_option("--frames", frames, "frames");
        go->add_option("-o,--output", file, "a file");
        go->add_flag("-q,--quiet", flag, "say nothing");
        app.require_subcommand(0, 1);
        go->callback([this] { command = [] { return 0; }; });
    }
    int run(std::vector<const char*> arguments) {
        arguments.insert(arguments.begin(), "aleph");
        return run_program(app, command, static_cast<int>(arguments.size()), arguments.data(), errors);
    }
};

TEST(Options, ReachTheirVariables) {
    Program program;
    EXPECT_EQ(program.run({"go", "--number", "-0.5", "-w", "7", "--frames", "-3-5"}), 0);
    EXPECT_EQ(program.number, -0.5);
    EXPECT_EQ(program.whole, 7);
    EXPECT_EQ(program.frames, "-3-5");
    EXPECT_EQ(program.errors.str(), "");
    Program other;
    EXPECT_EQ(other.run({"go", "--frames=-5--1"}), 0);
    EXPECT_EQ(other.number, 0.25);
    EXPECT_EQ(other.frames, "-5--1");
}

TEST(Options, BadUsageIsOneLineAndExitCode2) {
    for (const std::vector<const char*>& arguments : {std::vector<const char*>{},
                                                      {"fly"},
                                                      {"go", "--speed"},
                                                      {"go", "--number"},
                                                      {"go", "--number", "0,5"},
                                                      {"go", "--whole", "1.5"},
                                                      {"go", "extra"},
                                                      {"go", "--number", "line\nbreak"}}) {
        Program program;
        EXPECT_EQ(program.run(arguments), 2);
        const std::string message = program.errors.str();
        EXPECT_TRUE(message.starts_with("aleph: error: ")) << message;
        EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
        EXPECT_THAT(message, HasSubstr("--help"));
    }
}

TEST(Options, OfSeveralValuesTheLastCounts) {
    Program program;
    EXPECT_EQ(program.run({"go", "--number", "1", "-w", "5", "--number", "2", "--whole", "6"}), 0);
    EXPECT_EQ(program.number, 2.0);
    EXPECT_EQ(program.whole, 6);
}

TEST(Options, UnknownOnesNameTheNearest) {
    for (const auto& [argument, part] : {std::pair{"--numbr", "--numbr; did you mean \"--number\"?"},
                                         {"--frame=3", "--frame; did you mean \"--frames\"?"},
                                         {"--colour", "no option --colour (aleph go --help"},
                                         {"extra", "'extra' is one argument too many"}}) {
        Program program;
        EXPECT_EQ(program.run({"go", argument}), 2);
        EXPECT_THAT(program.errors.str(), HasSubstr(part));
    }
    Program program;
    EXPECT_EQ(program.run({"goo"}), 2);
    EXPECT_THAT(program.errors.str(), HasSubstr("no command goo; did you mean \"go\"?"));
}

TEST(Options, HelpShowsTheDefaultAndTheRangeOfEverySetting) {
    for (const auto add : {add_render_command, add_maps_command}) {
        CLI::App app{"test"};
        Command command;
        add(app, command);
        CLI::App& chosen = *app.get_subcommands([](CLI::App*) { return true; }).front();
        const std::string usual = chosen.help();
        EXPECT_THROW(app.parse(chosen.get_name() + " --help-all"), CLI::CallForHelp);
        const std::string help = chosen.help();
        for (const Setting& setting : setting_table()) {
            std::string option = "  --" + setting.key + " ";
            std::replace(option.begin(), option.end(), '_', '-');
            const std::size_t at = help.find(option);
            ASSERT_NE(at, std::string::npos) << option;
            EXPECT_EQ(usual.find(option) == std::string::npos, setting.rare) << option;
            const std::string text = help.substr(at, help.find("\n  --", at) - at);
            const SettingValue value = setting.get(RenderSettings());
            for (const std::string& choice : setting.choices) EXPECT_THAT(text, HasSubstr(choice));
            if (value == SettingValue(std::string())) continue;  // an empty list of names
            EXPECT_THAT(text, HasSubstr(std::visit([](const auto& v) { return fmt::format("={}", v); }, value)));
            if (setting.type == SettingType::number || setting.type == SettingType::whole_number) {
                EXPECT_THAT(text, HasSubstr(fmt::format(" to {}", setting.type == SettingType::number
                                                                      ? fmt::format("{:g}", setting.max)
                                                                      : fmt::format("{:.0f}", setting.max))));
            }
        }
    }
}

TEST(Options, AnOptionIsNoValueOfAnother) {
    for (const char* taken : {"--quiet", "-q", "--other", "--"}) {
        Program program;
        EXPECT_EQ(program.run({"go", "--output", taken}), 2) << taken;
        EXPECT_THAT(program.errors.str(), HasSubstr("--output: "));
    }
    Program program;
    EXPECT_EQ(program.run({"go", "-q", "-o", "./--quiet"}), 0);
    EXPECT_EQ(program.file, "./--quiet");
    EXPECT_EQ(program.run({"go", "-o", "-x.png"}), 0) << program.errors.str();
}

TEST(Options, ErrorsBecomeExitCodes) {
    std::ostringstream errors;
    const auto code_of = [&](const Command& command) {
        errors.str("");
        return run_command(command, errors);
    };
    EXPECT_EQ(code_of([] { return 75; }), 75);
    EXPECT_EQ(code_of([]() -> int { throw InputError("a.json", "/nodes/0", "is wrong"); }), 2);
    EXPECT_EQ(errors.str(), "aleph: error: a.json: /nodes/0: is wrong\n");
    EXPECT_EQ(code_of([]() -> int { throw OutputError("a.exr", "disk full"); }), 1);
    EXPECT_EQ(errors.str(), "aleph: error: a.exr: disk full\n");
    EXPECT_EQ(code_of([]() -> int { throw std::bad_alloc(); }), 1);
    EXPECT_EQ(errors.str(), "aleph: error: out of memory\n");
    EXPECT_EQ(code_of([]() -> int { throw std::logic_error("ours"); }), 1);
}

TEST(Progress, Durations) {
    EXPECT_EQ(format_duration(0.0), "0.0s");
    EXPECT_EQ(format_duration(59.94), "59.9s");
    EXPECT_EQ(format_duration(59.96), "1m00s");
    EXPECT_EQ(format_duration(65.0), "1m05s");
    EXPECT_EQ(format_duration(7380.0), "2h03m");
    EXPECT_EQ(format_duration(-1.0), "?");
    EXPECT_EQ(format_duration(0.0 / 0.0), "?");
}

TEST(Progress, Percents) {
    EXPECT_EQ(format_percent(7.5e-18), "0");
    EXPECT_EQ(format_percent(1.04e-6), "0.0001");
    EXPECT_EQ(format_percent(0.0994), "9.9");
    EXPECT_EQ(format_percent(0.0996), "10");
}

/// Returns the text that a Progress of ten frames writes, at one frame a second.
std::string progress_text(const ProgressLook& look) {
    const ScratchFolder folder;
    const auto path = folder / "log";
    std::FILE* out = std::fopen(path.c_str(), "w");
    double now = 100.0;
    {
        Progress progress("render", 10, look, out, [&] { return now; });
        for (int frame = 0; frame < 10; ++frame) {
            now += 1.0;
            progress.update(frame + 1, "frame " + std::to_string(frame));
        }
    }
    std::fclose(out);
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

TEST(Progress, QuietSaysNothing) {
    EXPECT_EQ(progress_text({}), "");
}

TEST(Progress, PlainLinesComeAtGrowingIntervalsAndEndComplete) {
    // Intervals .25, .5, 1, 2, 4, 5: lines after 1, 2, 3, 5, 9 s, and the last state.
    EXPECT_EQ(progress_text({ProgressStyle::lines, false, 80}),
              "render  10% (1.0s|9.0s) frame 0\n"
              "render  20% (2.0s|8.0s) frame 1\n"
              "render  30% (3.0s|7.0s) frame 2\n"
              "render  50% (5.0s|5.0s) frame 4\n"
              "render  90% (9.0s|1.0s) frame 8\n"
              "render 100% (10.0s|0.0s) frame 9\n");
}

TEST(Progress, LinesOfJsonAreObjects) {
    std::stringstream text(progress_text({ProgressStyle::json, false, 80}));
    std::vector<nlohmann::json> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
    ASSERT_EQ(lines.size(), 6u);
    EXPECT_EQ(lines[3], nlohmann::json::parse(R"({"progress": "render", "share": 0.5, "elapsed": 5.0, "remaining": 5.0,
                                                  "what": "frame 4"})"));
    EXPECT_EQ(lines.back().at("share"), 1.0);
}

TEST(Progress, BarIsDrawnOnOneLineAndFits) {
    const std::string text = progress_text({ProgressStyle::bar, false, 60});
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    EXPECT_EQ(text.back(), '\n');
    EXPECT_THAT(text, Not(HasSubstr("\x1b[3")));  // no colour
    std::stringstream drawings(text);
    std::string drawing;
    std::size_t count = 0;
    while (std::getline(drawings, drawing, '\r')) {
        EXPECT_LE(drawing.size(), 60u + 4u) << drawing;  // the escape that clears the rest, the last line's end
        ++count;
    }
    EXPECT_EQ(count, 11u);
    EXPECT_THAT(text, HasSubstr("[=============="));
    EXPECT_THAT(progress_text({ProgressStyle::bar, true, 60}), HasSubstr("\x1b[32m"));
    EXPECT_NO_THROW(progress_text({ProgressStyle::bar, false, 1}));
}

TEST(Progress, LookFollowsTheSituation) {
    EXPECT_EQ(progress_look(true).style, ProgressStyle::none);
    EXPECT_NE(progress_look(false).style, ProgressStyle::none);
    EXPECT_EQ(progress_look(false, "json").style, ProgressStyle::json);
    EXPECT_EQ(progress_look(true, "json").style, ProgressStyle::none);
}

}  // namespace
}  // namespace aleph
