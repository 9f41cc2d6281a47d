// Frames have the same bytes for any number of threads, in any order, and in any floating-point mode of the caller.

#include <bit>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/base/parallel.h"
#include "motion/velocity.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/test.h"

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
        std::condition_variable arrived;
        std::set<std::thread::id> seen;
        const auto least = static_cast<std::size_t>(std::min(threads, 2));
        with_threads(threads, [&] {
            parallel_for(64, 1, [&](std::size_t, std::size_t) {
                std::unique_lock lock(mutex);
                seen.insert(std::this_thread::get_id());
                arrived.notify_all();
                arrived.wait(lock, [&] { return seen.size() >= least; });  // without a second thread, for ever
            });
        });
        EXPECT_LE(seen.size(), static_cast<std::size_t>(threads));
        EXPECT_GE(seen.size(), least);
    }
}

TEST(Determinism, DT01_FilesAreEqualForAnyNumberOfThreads) {
    const Scene& scene = pool_scene();
    const RenderSettings settings = small_settings();
    const auto one = frame_bytes(1, scene, settings, {12});
    ASSERT_GT(one[0].size(), 80u * 60u);
    for (const int threads : {2, 3, 4, 8}) {
        EXPECT_TRUE(frame_bytes(threads, scene, settings, {12}) == one) << threads << " threads";
    }
}

TEST(Determinism, DT01_UnguidedAndDenseFilesToo) {
    const Scene& scene = pool_scene();
    for (const double accuracy : {0.0, 0.3}) {
        RenderSettings settings = small_settings();
        settings.perception.guide = Guide::none;
        settings.cache.accuracy = accuracy;
        settings.cache.gather = 16;
        EXPECT_TRUE(frame_bytes(1, scene, settings, {40}) == frame_bytes(4, scene, settings, {40}))
            << "accuracy " << accuracy;
    }
}

/// Samples of a pixel that the cache did not cover are finished by one thread, whose sums are then in one order.
TEST(Determinism, DT01_ManySamplesOfAPixelWaitForRecords) {
    RenderSettings settings = small_settings();
    set_size(settings, 40, 30);
    settings.sampling.spp = 32;
    settings.cache.accuracy = 0.05;
    settings.perception.grid = SaliencyGrid::center;  // other tests: full
    const std::string one = frame_bytes(1, pool_scene(), settings, {21}).back();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame_bytes(3, pool_scene(), settings, {21}).back() == one);
}

TEST(Determinism, DT01_DT04_EveryRuleOfStopping) {
    const Scene& scene = pool_scene();
    for (const Sampling rule : {Sampling::consecutive, Sampling::variance, Sampling::protocol, Sampling::threshold}) {
        RenderSettings settings = small_settings();
        follow_error(settings, 1.0);
        settings.sampling.rule = rule;
        settings.sampling.spp = 32;
        set_size(settings, 40, 30);
        const std::string one = frame_bytes(1, scene, settings, {21}).back();
        EXPECT_TRUE(frame_bytes(3, scene, settings, {21}).back() == one) << static_cast<int>(rule);
        EXPECT_TRUE(frame_bytes(2, scene, settings, {20, 21}).back() == one) << static_cast<int>(rule);
    }
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
    // Nor does a frame depend on a later one that was rendered before it.
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

}  // namespace
}  // namespace aleph
