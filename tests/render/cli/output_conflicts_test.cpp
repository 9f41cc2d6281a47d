// No output replaces a file that the same command reads, or another output.

#include "render/cli/support/output_conflicts.h"
#include "engine/image/image_file.h"
#include "tests/render/cli/answers.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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
