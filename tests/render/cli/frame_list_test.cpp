// Frame lists and output names. No output replaces a file that the same command reads, or another output.

#include <climits>

#include "engine/image/image_file.h"
#include "render/cli/support/output_path.h"
#include "render/settings/frame_list.h"
#include "tests/render/cli/answers.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Frames = std::vector<int>;

std::string refusal(std::string_view text) {
    const Refusal found = find_refusal([&] { parse_frame_list(text); });
    EXPECT_EQ(found.place, "--frames");
    return found.reason;
}

TEST(FrameList, ReadsNumbersRangesAndSteps) {
    EXPECT_EQ(parse_frame_list("7"), (Frames{7}));
    EXPECT_EQ(parse_frame_list("1-4"), (Frames{1, 2, 3, 4}));
    EXPECT_EQ(parse_frame_list("1-3,20-26x2"), (Frames{1, 2, 3, 20, 22, 24, 26}));
    EXPECT_EQ(parse_frame_list("1-10x4"), (Frames{1, 5, 9}));
    EXPECT_EQ(parse_frame_list("5-5"), (Frames{5}));
    EXPECT_EQ(parse_frame_list(" 1 , 2-3 "), (Frames{1, 2, 3}));
    EXPECT_EQ(parse_frame_list("9,1-3,2,9,0"), (Frames{9, 1, 2, 3, 0})) << "without repeats";
}

TEST(FrameList, NegativeFramesAndEdgesOf32Bits) {
    EXPECT_EQ(parse_frame_list("-3"), (Frames{-3}));
    EXPECT_EQ(parse_frame_list("-2-1"), (Frames{-2, -1, 0, 1}));
    EXPECT_EQ(parse_frame_list("-5--1x2"), (Frames{-5, -3, -1}));
    EXPECT_EQ(parse_frame_list("2147483646-2147483647"), (Frames{INT_MAX - 1, INT_MAX}));
    EXPECT_EQ(parse_frame_list("-2147483648-2147483647x2147483647"), (Frames{INT_MIN, -1, INT_MAX - 1}));
}

TEST(FrameList, RefusesWithAReason) {
    for (const char* text : {"", ",", "1,", ",1", "1,,2", " "}) {
        EXPECT_THAT(refusal(text), HasSubstr("a frame is missing")) << text;
    }
    for (const char* text : {"a", "1-", "1x2", "1-5x", "1-5y2", "1 2", "1.5", "1-5x2x2", "--5", "+1", "0x10", "1-b"}) {
        EXPECT_THAT(refusal(text), HasSubstr("expected N, A-B or A-BxS")) << text;
    }
    EXPECT_THAT(refusal("10-1"), HasSubstr("before the first"));
    EXPECT_THAT(refusal("-1--5"), HasSubstr("before the first"));
    EXPECT_THAT(refusal("1-5x0"), HasSubstr("step"));
    EXPECT_THAT(refusal("1-5x-1"), HasSubstr("step"));
    EXPECT_THAT(refusal("2147483648"), HasSubstr("too large"));
    EXPECT_THAT(refusal("1-99999999999999999999"), HasSubstr("too large"));
    EXPECT_THAT(refusal("1-20:2"), AllOf(HasSubstr("step to Slurm"), HasSubstr("stagger to Fileseq")));
}

TEST(FrameList, TenMillionFramesAndNoMore) {
    EXPECT_EQ(parse_frame_list("1-10000000").size(), 10'000'000u);
    EXPECT_THAT(refusal("0-10000000"), HasSubstr("more than"));
    EXPECT_THAT(refusal("1-6000000,1-6000000"), HasSubstr("more than"));
    EXPECT_THAT(refusal("-2147483648-2147483647"), HasSubstr("more than"));
}

TEST(OutputPath, PutsTheNumberIn) {
    EXPECT_EQ(output_path("a.####.exr", "pool", 7), "a.0007.exr");
    EXPECT_EQ(output_path("a.%04d.exr", "pool", 7), "a.0007.exr");
    EXPECT_EQ(output_path("a.%d.exr", "pool", 7), "a.7.exr");
    EXPECT_EQ(output_path("a.#.exr", "pool", 12), "a.12.exr");
    EXPECT_EQ(output_path("x/y/a_######.png", "pool", 12), "x/y/a_000012.png");
    EXPECT_EQ(output_path("a.####.exr", "pool", 123456), "a.123456.exr");
    EXPECT_EQ(output_path("still.exr", "pool", 5), "still.exr");
}

TEST(OutputPath, NegativeFramesCountTheirSign) {
    EXPECT_EQ(output_path("a.####.exr", "pool", -3), "a.-003.exr");
    EXPECT_EQ(output_path("a.%04d.exr", "pool", -3), "a.-003.exr");
    EXPECT_EQ(output_path("a.#.exr", "pool", INT_MIN), "a.-2147483648.exr");
}

TEST(OutputPath, Folders) {
    const ScratchFolder folder;
    EXPECT_EQ(output_path("", "pool", 3), "pool.0003.exr");
    EXPECT_EQ(output_path("out/", "pool", 3), "out/pool.0003.exr");
    EXPECT_EQ(output_path("new", "pool", 3), "new/pool.0003.exr");
    EXPECT_EQ(output_path(".", "pool", 3), "./pool.0003.exr");
    std::filesystem::create_directory(folder / "v1.2");
    EXPECT_EQ(output_path((folder / "v1.2").string(), "pool", 3), folder / "v1.2" / "pool.0003.exr");
    EXPECT_EQ(output_path("take#1/a.##.exr", "pool", 3), "take#1/a.03.exr");
}

TEST(OutputPath, RefusesPatternsWithTwoMeanings) {
    for (const char* pattern : {"a.##.##.exr", "a.%d.%d.exr", "a.#.%04d.exr", "a.%s.exr", "a.%.exr", "a%", "a.%0d.exr",
                                "a.%012d.exr", "100%.exr"}) {
        EXPECT_THROW(output_path(pattern, "pool", 1), InputError) << pattern;
    }
}

std::string refused_pattern(const std::string& pattern) {
    return find_refusal([&] { output_path(pattern, "pool", 1); }).message;
}

TEST(OutputPath, RefusesOtherFormatsAndStandardOutput) {
    for (const char* pattern : {"x.jpg", "out.with.dots", "a.####.jpeg", "shots/v1.2", "a.####", "a_%04d"}) {
        EXPECT_THAT(refused_pattern(pattern), HasSubstr("possible are .exr and .png, or a folder")) << pattern;
    }
    EXPECT_THAT(refused_pattern("x.jpg"), HasSubstr("the extension .jpg is not known"));
    EXPECT_THAT(refused_pattern("-"), HasSubstr("standard output"));
    for (const char* pattern : {"x.EXR", "x.Png", "./-", "out.with.dots/", "shots.v1/x.png"}) {
        EXPECT_EQ(refused_pattern(pattern), "") << pattern;
    }
    EXPECT_EQ(output_format("x.EXR"), OutputFormat::exr);
    EXPECT_EQ(output_format("x.Png"), OutputFormat::png);
}

TEST(OutputPath, OU03_NoRadiancePicturesAreWritten) {
    for (const char* pattern : {"x.hdr", "x.HDR", "a.####.hdr", "shots/x.hdr"}) {
        EXPECT_THAT(refused_pattern(pattern), HasSubstr("possible are .exr and .png, or a folder")) << pattern;
    }
}

TEST(OutputPath, SeveralFramesNeedANumber) {
    EXPECT_THAT(output_paths("a.#.exr", "pool", {1, 2}), ElementsAre("a.1.exr", "a.2.exr"));
    EXPECT_THAT(output_paths("a.exr", "pool", {1}), ElementsAre("a.exr"));
    EXPECT_THAT(find_refusal([&] {
                    output_paths("a.exr", "pool", {1, 2});
                }).message,
                HasSubstr("2 frames need a number in the name"));
}

constexpr const char* scene_text = R"({"aleph": 1, "include": ["part.gltf"], "exposure": 1, "camera": "eye",
  "images": {"tex": "tex.png"}, "materials": {"m": {"base_color_texture": "tex"}}, "environment": [1, 1, 1],
  "cameras": {"lens": {"fov": 50}},
  "nodes": [{"name": "eye", "translation": [0, 0, 3], "camera": "lens"},
            {"name": "wall", "shape": {"type": "box", "size": [1, 1, 1]}, "material": "m"}]})";

class Conflicts : public testing::Test {
  protected:
    void SetUp() override {
        write_text(folder_ / "sc.json", scene_text);
        write_png(folder_ / "tex.png", Image<Rgb>(4, 4));
        write_png(folder_ / "other.png", Image<Rgb>(4, 4));
        GltfDraft draft = triangle_draft();
        draft.json["buffers"] = {{{"byteLength", draft.buffer.size()}, {"uri", "part.bin"}}};
        write_text(folder_ / "part.bin", std::string(draft.buffer.begin(), draft.buffer.end()));
        write_text(folder_ / "part.gltf", draft.json.dump());
        fs::create_symlink("sc.json", folder_ / "soft.json");
        fs::create_hard_link(folder_ / "tex.png", folder_ / "hard.png");
        fs::create_symlink("new.json", folder_ / "dangling.json");
    }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    /// The command is refused, its message has the text, and every file is as before.
    void expect_refused(const Words& words, const std::string& text) const {
        const auto before = contents();
        const Ran ran = run_command(words);
        expect_answer(ran, exit_bad_input, text);
        EXPECT_THAT(ran.errors, HasSubstr("give another name"));
        EXPECT_EQ(contents(), before) << text;
    }

    void expect_render_refused(const Words& more, const std::string& text) const {
        expect_refused(joined({"render", file("sc.json"), "-q", "--size", "8x8", "--frames", "0"}, more), text);
    }

    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> files;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_.path())) {
            const bool is_file = entry.is_regular_file();
            files[entry.path().string()] = is_file ? read_bytes(entry.path()) : "";
        }
        return files;
    }

    ScratchFolder folder_;
};

TEST_F(Conflicts, NoOutputReplacesAFileOfTheScene) {
    const std::string out = file("out/a.exr");
    expect_render_refused({"-o", out, "--stats", file("sc.json")}, "--stats");
    expect_render_refused({"-o", out, "--stats", file("./out/../sc.json")}, "--stats");
    expect_render_refused({"-o", out, "--stats", file("soft.json")}, "--stats");
    expect_render_refused({"-o", out, "--stats", file("part.gltf")}, "--stats");
    expect_render_refused({"-o", out, "--stats", file("part.bin")}, "--stats");
    expect_render_refused({"-o", out, "--cache", file("sc.json")}, "--cache");
    expect_render_refused({"-o", file("tex.png")}, "tex.png");
    expect_render_refused({"-o", file("hard.png")}, "hard.png");
}

TEST_F(Conflicts, FramesAreComparedByTheirOwnNames) {
    fs::rename(folder_ / "tex.png", folder_ / "t.0000.png");
    std::string text = scene_text;
    text.replace(text.find("tex.png"), 7, "t.0000.png");
    write_text(folder_ / "sc.json", text);
    expect_render_refused({"-o", file("t.####.png")}, "t.0000.png");
}

TEST_F(Conflicts, NoFileIsWrittenTwice) {
    const std::string out = file("a.exr");
    expect_render_refused({"-o", out, "--stats", out}, "written twice");
    expect_render_refused({"-o", out, "--stats", file("x"), "--cache", file("./x")}, "written twice");
    expect_render_refused({"-o", out, "--stats", file("new.json"), "--cache", file("dangling.json")}, "written twice");
}

TEST_F(Conflicts, ANumberIsMissingInTheNameOfSeveralFrames) {
    expect_answer(run_command({"render", file("sc.json"), "--frames", "1-2", "-o", file("a.exr")}), 2,
                  "2 frames need a number in the name");
}

TEST_F(Conflicts, NoPictureThatIsComparedIsReplaced) {
    const std::string a = file("tex.png"), b = file("other.png");
    expect_refused({"compare", a, b, "--diff", a}, "--diff");
    expect_refused({"compare", a, b, "--diff", file("./other.png")}, "--diff");
    expect_refused({"compare", b, b, "--diff", file("hard.png"), "--threshold", a}, "--diff");
    fs::rename(a, file("f.0001.png"));
    fs::rename(b, file("g.0001.png"));
    expect_refused({"compare", file("f.####.png"), file("g.####.png"), "--diff", file("g.%04d.png")}, "g.0001.png");
}

TEST_F(Conflicts, AStudyDoesNotReplaceItsOwnFile) {
    write_text(folder_ / "study.json",
               R"({"title": "t", "scenes": [{"scene": "sc.json", "frames": "0"}], "sweep": {"error": [1, 2]}})");
    expect_refused({"study", file("study.json"), "-q", "--frames", "0", "-o", folder_.path().string()}, "study.json");
}

TEST_F(Conflicts, OutputsThatAreHardLinksOfEachOtherAreTwoFiles) {
    EXPECT_NO_THROW(refuse_overwriting({file("sc.json")}, {{file("tex.png"), "--output"}, {file("hard.png"), "--o"}}));
}

}  // namespace
}  // namespace aleph
