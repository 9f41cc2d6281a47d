// A locale whose decimal point is a comma changes no number that is read or written.

#include <gtest/gtest.h>

#include "engine/base/parallel.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/german_locale.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

constexpr const char* scene_text = R"({
  "aleph": 1, "fps": "30000/1001", "frames": [0, 4], "exposure": 1.5,
  "settings": {"accuracy": 0.375, "size": "40x30", "gather": 16, "spp": 1},
  "viewing": {"pixels_per_degree": 30.5},
  "camera": "eye",
  "materials": {"wall": {"base_color": [0.25, 0.5, 0.125], "roughness": 0.75}},
  "nodes": [
    {"name": "eye", "translation": [0, 0.5, 2.5], "camera": {"fov": 42.5}},
    {"name": "box", "shape": {"type": "box", "size": [0.5, 0.75, 1.25]}, "material": "wall",
     "translation": {"keys": [[0, [0.125, 0, 0]], [4, [0.625, 0.25, 0]]]}},
    {"name": "lamp", "translation": [0.5, 2.5, 1.5], "light": {"type": "point", "intensity": 12.5}}
  ]
})";

/// Everything that becomes text or comes from text, of one scene.
struct Everything {
    Scene scene;
    RenderSettings settings;
    std::string saved, frame, statistics;
};

Everything do_everything(const std::filesystem::path& folder) {
    Everything all;
    all.scene = load_scene(folder / "scene.json");
    apply_settings(all.settings, all.scene.settings, "scene.json");
    SettingMap more;
    parse_setting("adapter_k=87.5", more);
    parse_setting("min_radius_pixels=11.25", more);
    apply_settings(all.settings, more, "--set");
    save_scene(all.scene, folder / "saved.json");
    all.saved = read_bytes(folder / "saved.json");
    Sequence sequence(all.scene, all.settings);
    all.frame = frame_bytes(sequence, all.scene, all.settings, 2);
    FrameStatistics statistics;
    statistics.frame = 2;
    statistics.seconds.fill = 0.125;
    statistics.peak_memory_mib = 12.5;
    all.statistics = format_statistics({statistics}, all.scene, all.settings, sequence.exposure());
    return all;
}

/// Makes `text` grow by a run of the program; fails the test if it does not end with 0.
std::string run_program(const std::filesystem::path& folder) {
    const std::string out = (folder / "run.exr").string(), log = (folder / "log").string();
    const std::string command =
        std::string("'") + program_path("aleph") + "' render '" + (folder / "scene.json").string() +
        "' -q --aovs --frames 1 --accuracy 0.25 --set min_radius_pixels=10.5 -o '" + out + "' >'" + log + "' 2>&1";
    EXPECT_EQ(::system(command.c_str()), 0) << read_bytes(log);
    return std::filesystem::exists(out) ? read_bytes(out) : "";
}

TEST(Locale, DT09_ACommaLocaleChangesNothing) {
    const ScratchFolder folder;
    std::ofstream(folder / "scene.json") << scene_text;
    const Everything plain = do_everything(folder.path());
    const std::string plain_run = run_program(folder.path());
    EXPECT_EQ(plain.settings.cache.accuracy, 0.375);
    EXPECT_EQ(plain.settings.guide.adapter_k, 87.5);
    EXPECT_NE(plain.statistics.find("\"fill\": 0.125"), std::string::npos) << plain.statistics;

    const GermanLocale german;
    if (!german.available()) GTEST_SKIP() << "no locale de_DE.UTF-8, and localedef cannot make one";
    const Everything comma = do_everything(folder.path());
    EXPECT_TRUE(comma.scene == plain.scene);
    EXPECT_TRUE(comma.settings == plain.settings);
    EXPECT_EQ(comma.saved, plain.saved);
    EXPECT_EQ(comma.statistics, plain.statistics);
    EXPECT_TRUE(comma.frame == plain.frame) << "pixels or metadata of the EXR file";
    EXPECT_TRUE(run_program(folder.path()) == plain_run) << "the program started in that locale";
    EXPECT_EQ(*::localeconv()->decimal_point, ',') << "the caller's locale has to stay";
}

}  // namespace
}  // namespace aleph
