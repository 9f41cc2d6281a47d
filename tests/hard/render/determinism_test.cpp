// HARD_CASES, section 9: the same bytes for any number of threads, any order of frames, any run, and whatever the
// floating-point mode that the caller left behind.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "engine/base/parallel.h"
#include "engine/rays/first_hits.h"
#include "motion/velocity.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "render/compare.h"
#include "render/estimate.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/paths.h"
#include "tests/support/with_threads.h"

namespace aleph {
namespace {

bool same_bits(const Image<float>& a, const Image<float>& b) {
    return a.width == b.width && a.height == b.height &&
           std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), [](float x, float y) {
               return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
           });
}

TEST(Determinism, TheseTestsReallyUseSeveralThreads) {
    for (const int threads : {1, 3, 8}) {
        std::mutex mutex;
        std::set<std::thread::id> seen;
        with_threads(threads, [&] {
            parallel_for(64, 1, [&](std::size_t, std::size_t) {
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
                const std::lock_guard lock(mutex);
                seen.insert(std::this_thread::get_id());
            });
        });
        EXPECT_LE(seen.size(), static_cast<std::size_t>(threads));
        EXPECT_GE(seen.size(), static_cast<std::size_t>(std::min(threads, 2)));
    }
}

TEST(Determinism, DT01_FilesAreEqualForAnyNumberOfThreads) {
    const Scene& scene = pool_scene();
    const RenderSettings settings = small_settings();
    const auto render = [&](int threads) {
        return with_threads(threads, [&] {
            Sequence sequence(scene, settings);
            return frame_bytes(sequence, scene, settings, 12);
        });
    };
    const std::string one = render(1);
    ASSERT_GT(one.size(), 160u * 120u);
    for (const int threads : {2, 3, 4, 8}) EXPECT_TRUE(render(threads) == one) << threads << " threads";
}

TEST(Determinism, DT01_UnguidedAndDenseFilesToo) {
    const Scene& scene = pool_scene();
    for (const double accuracy : {0.0, 0.3}) {
        RenderSettings settings = small_settings();
        settings.perception.guide = Guide::none;
        settings.accuracy = accuracy;
        settings.width = 80;
        settings.height = 60;
        settings.gather = 16;
        const auto render = [&](int threads) {
            return with_threads(threads, [&] {
                Sequence sequence(scene, settings);
                return frame_bytes(sequence, scene, settings, 40);
            });
        };
        EXPECT_TRUE(render(1) == render(4)) << "accuracy " << accuracy;
    }
}

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
    const double one = with_threads(1, [&] { return compute_exposure(image); });
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
    Node node;
    node.name = "waves";
    node.meshes = {0};
    scene.nodes.push_back(node);
    return scene;
}

TEST(Determinism, DT03_FirstHitsAreEqualForAnyNumberOfBuildThreads) {
    const Scene scene = make_triangle_scene();
    ASSERT_EQ(scene.meshes[0].triangles.size(), 200000u);
    CameraView view;
    view.width = 320;
    view.height = 240;
    view.pixels_per_unit = 300.0;
    view.position = glm::dvec3(0.0, 3.0, 0.0);
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

TEST(Determinism, DT04_IC14_AFrameAloneOrInASequence) {
    const Scene& scene = pool_scene();
    const RenderSettings settings = small_settings();
    std::vector<std::string> forward(10);
    Sequence sequence(scene, settings);
    for (int frame = 0; frame < 10; ++frame) forward[frame] = frame_bytes(sequence, scene, settings, frame);
    for (int frame = 5; frame <= 7; ++frame) {
        Sequence alone(scene, settings);
        EXPECT_TRUE(frame_bytes(alone, scene, settings, frame) == forward[frame]) << "frame " << frame << " alone";
    }
    Sequence some(scene, settings);
    for (int frame = 5; frame <= 7; ++frame) {
        EXPECT_TRUE(frame_bytes(some, scene, settings, frame) == forward[frame]) << "frame " << frame << " of 5-7";
    }
    // What was left behind by a later frame must not matter either.
    for (const int frame : {7, 0}) {
        EXPECT_TRUE(frame_bytes(sequence, scene, settings, frame) == forward[frame]) << "frame " << frame << " again";
    }
    EXPECT_FALSE(forward[5] == forward[6]);
}

/// Runs work() as a caller would whose thread flushes denormals.
template <class Work>
auto with_flushing(bool flush, const Work& work) {
    if (!flush) return work();
    const FlushDenormals mode;
    return work();
}

TEST(Determinism, DT06_FilesAreEqualWhateverTheCallersFloatingPointMode) {
    const Scene& scene = pool_scene();
    const RenderSettings settings = small_settings();
    const auto render = [&](bool flush, int threads) {
        return with_threads(threads, [&] {
            return with_flushing(flush, [&] {
                Sequence sequence(scene, settings);
                return frame_bytes(sequence, scene, settings, 20);
            });
        });
    };
    const std::string plain = render(false, 1);
    EXPECT_TRUE(render(true, 1) == plain) << "calling thread";
    EXPECT_TRUE(render(false, 4) == plain) << "pool threads";
    EXPECT_TRUE(render(true, 4) == plain) << "both";
}

/// Everything that perception makes of an estimate and its motion.
struct Maps {
    PerceptionMaps maps;
    Image<float> velocity, threshold;
    SanitizeCounts counts;
};

TEST(Determinism, DT06_DenormalPixelsAndSpeeds) {
    std::mt19937 engine(11);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    Image<Rgb> estimate(96, 64);
    MotionField motion{Image<glm::dvec2>(96, 64), Image<double>(96, 64),
                       Image<MotionValidity>(96, 64, MotionValidity::valid)};
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        const bool dark = i % 96 > 48;
        estimate.pixels[i] = Rgb(dark ? std::numeric_limits<float>::min() * share(engine) : share(engine));
        motion.path_length.pixels[i] = dark ? 1e-42 * share(engine) : share(engine);
        motion.displacement.pixels[i] = {motion.path_length.pixels[i], 0.0};
    }
    const ViewingConditions viewing;
    const auto perceive = [&](bool flush, int threads) {
        return with_threads(threads, [&] {
            return with_flushing(flush, [&] {
                Maps out;
                Image<Rgb> sane = estimate;
                out.counts = sanitize_estimate(sane);
                out.velocity = compute_image_velocity(motion, viewing, {});
                out.maps = compute_perception(sane, out.velocity, viewing, {}, {},
                                              {.retinal_velocity = true, .conspicuity = true});
                out.threshold = compute_threshold(out.maps.aleph, compute_adaptation_luminance(sane, viewing));
                return out;
            });
        });
    };
    const Maps plain = perceive(false, 1);
    EXPECT_LT(*std::min_element(plain.maps.aleph.pixels.begin(), plain.maps.aleph.pixels.end()), 250.0f);
    for (const auto& [flush, threads] : {std::pair{true, 1}, {false, 4}, {true, 4}}) {
        const Maps other = perceive(flush, threads);
        EXPECT_TRUE(same_bits(other.maps.aleph, plain.maps.aleph)) << flush << threads;
        EXPECT_TRUE(same_bits(other.maps.saliency, plain.maps.saliency)) << flush << threads;
        EXPECT_TRUE(same_bits(other.maps.conspicuity_motion, plain.maps.conspicuity_motion)) << flush << threads;
        EXPECT_TRUE(same_bits(other.maps.retinal_velocity, plain.maps.retinal_velocity)) << flush << threads;
        EXPECT_TRUE(same_bits(other.velocity, plain.velocity)) << flush << threads;
        EXPECT_TRUE(same_bits(other.threshold, plain.threshold)) << flush << threads;
        EXPECT_EQ(other.counts.clamped, plain.counts.clamped);
    }
}

/// Starts the program; its standard output and error go into the folder, too.
void run_program(const std::string& arguments, const std::filesystem::path& folder) {
    const std::string log = (folder / "log").string();
    const std::string command = std::string("'") + program_path("aleph") + "' " + arguments + " -o '" +
                                (folder / "####.exr").string() + "' >'" + log + "' 2>&1";
    ASSERT_EQ(::system(command.c_str()), 0) << read_bytes(log);
}

TEST(Determinism, DT10_TwoRunsOfTheProgram) {
    const std::string scene =
        std::string("'") + source_folder().string() + "/scenes/pool/scene.json' -q --frames 8,30 --size 160x120";
    for (const std::string& arguments :
         {"maps " + scene, "render " + scene + " --aovs --spp 2 --gather 32 --accuracy .4"}) {
        const ScratchFolder first, second;
        run_program(arguments, first.path());
        run_program(arguments, second.path());
        for (const char* name : {"0008.exr", "0030.exr"}) {
            EXPECT_TRUE(read_bytes(first / name) == read_bytes(second / name)) << arguments << ": " << name;
        }
        EXPECT_FALSE(read_bytes(first / "0008.exr") == read_bytes(first / "0030.exr"));
    }
}

}  // namespace
}  // namespace aleph
