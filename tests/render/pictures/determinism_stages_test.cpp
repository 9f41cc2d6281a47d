// Single stages give the same bits for any number of threads: exposure, comparison, first hits.
// A locale whose decimal point is a comma changes no number that is read or written.

#include "engine/base/parallel.h"
#include "render/compare/compare.h"
#include "render/estimate/estimate.h"
#include "tests/support/first_hits.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/german_locale.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Log-normal, so that the order of a single-precision sum would show (722093.8 or 722104.4 for 722104.5).
Image<Rgb> make_log_normal_image(int width, int height) {
    std::mt19937 engine(5);
    std::normal_distribution<float> normal(0.0f, 2.0f);
    Image<Rgb> image(width, height);
    for (Rgb& pixel : image.pixels)
        pixel = Rgb(std::exp(normal(engine)), std::exp(normal(engine)), std::exp(normal(engine)));
    return image;
}

TEST(Determinism, DT02_ExposureIsAFixedOrderSumInDouble) {
    const Image<Rgb> image = make_log_normal_image(400, 250);
    long double sum = 0.0L;
    for (const Rgb& pixel : image.pixels) sum += std::log(static_cast<long double>(luminance(pixel)));
    const double truth = static_cast<double>(0.18L / std::exp(sum / 100000.0L));
    const double one = with_threads(1, [&] { return compute_exposure(image).value(); });
    EXPECT_NEAR(one, truth, 1e-12 * truth);
    for (const int threads : {2, 3, 8}) {
        EXPECT_EQ(with_threads(threads, [&] { return compute_exposure(image); }), one) << threads << " threads";
    }
}

TEST(Determinism, DT02_ErrorSumsOfAComparison) {
    const Image<Rgb> values = make_log_normal_image(400, 250);
    ChannelImage a, zero;
    a.channels.push_back({"V", Image<float>(400, 250)});
    zero.channels.push_back({"V", Image<float>(400, 250, 0.0f)});
    long double squares = 0.0L;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float v = values.pixels[i].x;
        a.channels[0].values.pixels[i] = v;
        squares += static_cast<long double>(v) * v;
    }
    const double truth = static_cast<double>(std::sqrt(squares / 100000.0L));
    const double one = with_threads(1, [&] { return compare_images(a, zero).all.rms; });
    EXPECT_NEAR(one, truth, 1e-12 * truth);
    EXPECT_EQ(with_threads(4, [&] { return compare_images(a, zero).all.rms; }), one);
}

/// 2e5 triangles: a wavy grid with long, overlapping slivers above it.
Scene make_triangle_scene() {
    Scene scene;
    Mesh mesh;
    mesh.name = "waves";
    constexpr int cells = 312;
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const float u = static_cast<float>(x) / cells, v = static_cast<float>(y) / cells;
            mesh.positions.emplace_back(4.0f * u - 2.0f, 0.1f * std::sin(40.0f * u) * std::cos(31.0f * v),
                                        4.0f * v - 2.0f);
        }
    }
    constexpr std::uint32_t row = cells + 1;
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t i = y * row + x;
            mesh.triangles.emplace_back(i, i + row, i + 1);
            mesh.triangles.emplace_back(i + 1, i + row, i + row + 1);
        }
    }
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> place(-2.0f, 2.0f), length(-0.4f, 0.4f), thin(-0.005f, 0.005f);
    while (mesh.triangles.size() < 200000) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::vec3 corner(place(engine), 0.2f + 0.05f * place(engine), place(engine));
        mesh.positions.push_back(corner);
        mesh.positions.push_back(corner + glm::vec3(length(engine), length(engine), length(engine)));
        mesh.positions.push_back(corner + glm::vec3(thin(engine), thin(engine), thin(engine)));
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    scene.meshes.push_back(mesh);
    scene.nodes.push_back({.name = "waves", .meshes = {0}});
    return scene;
}

TEST(Determinism, DT03_FirstHitsAreEqualForAnyNumberOfBuildThreads) {
    const Scene scene = make_triangle_scene();
    ASSERT_EQ(scene.meshes[0].triangles.size(), 200000u);
    CameraView view{.width = 320, .height = 240, .position = glm::dvec3(0.0, 3.0, 0.0), .pixels_per_unit = 300.0};
    view.axes = glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0);  // looks straight down
    const ScenePose frame = pose(scene, 0.0);
    const auto cast = [&](int threads) {
        return with_threads(threads, [&] {
            RayScene rays(scene);
            rays.update(frame, compute_anchor(view));
            return cast_first_hits(rays, view).pixels;
        });
    };
    const std::vector<Hit> one = cast(1);
    const auto misses = std::count_if(one.begin(), one.end(), [](const Hit& hit) { return hit.instance == no_index; });
    EXPECT_EQ(misses, 0);
    for (const int threads : {2, 4}) EXPECT_TRUE(cast(threads) == one) << threads << " threads";
}

/// The part of a view that starts at a pixel.
CameraView crop(const CameraView& view, int x, int y, int width, int height) {
    CameraView part = view;
    part.width = std::min(width, view.width - x);
    part.height = std::min(height, view.height - y);
    part.axis_offset += 0.5 * glm::dvec2(view.width - part.width, view.height - part.height) - glm::dvec2(x, y);
    return part;
}

TEST(Determinism, DT05_FirstHitsOfTilesAreThoseOfTheWholePicture) {
    // Packets join other pixels at other places of their tile.
    const Scene scene = make_triangle_scene();
    CameraView view{.width = 150,
                    .height = 101,
                    .position = glm::dvec3(0.1, 3.0, 0.2),
                    .axes = glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0),
                    .pixels_per_unit = 140.0};
    RayScene rays(scene);
    rays.update(pose(scene, 0.0), compute_anchor(view));
    const Image<Hit> whole = cast_first_hits(rays, view);
    for (const int size : {8, 16, 64, 1000, 3}) {
        for (int y = 0; y < view.height; y += size) {
            for (int x = 0; x < view.width; x += size) {
                const Image<Hit> tile = cast_first_hits(rays, crop(view, x, y, size, size));
                for (int v = 0; v < tile.height; ++v)
                    for (int u = 0; u < tile.width; ++u) ASSERT_EQ(tile(u, v), whole(x + u, y + v)) << size;
            }
        }
    }
}

TEST(Determinism, DT05_ShadedTilesAreThoseOfTheWholePicture) {
    RenderSettings settings;
    set_size(settings, 90, 70);
    settings = traced_reference_settings(settings);
    settings.sampling.spp = 3;
    const PartSamples samples{settings.seed, settings.sampling.spp};
    const Scene scene = load_scene(source_folder() / "scenes/cornell/scene.json");
    const Image<Rgb> whole = Sequence(scene, settings).render(3).shaded.color;
    for (const int size : {8, 16, 64, 3}) {
        const PicturePart part = choose_part(whole.width, whole.height, 2, size);
        const Image<Rgb> tiles = Sequence(scene, settings).render_part(3, part, std::span(&samples, 1)).front();
        for (std::size_t i = 0; i < whole.size(); ++i)
            ASSERT_EQ(tiles.pixels[i], part.pixels[i] != 0 ? whole.pixels[i] : Rgb(0.0f)) << size << " " << i;
    }
}

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
    apply_settings(all.settings, all.scene.source.settings, "scene.json");
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
    all.statistics =
        format_statistics(format_frame_statistics(statistics), all.scene, all.settings, sequence.exposure());
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
