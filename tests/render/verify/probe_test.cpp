// Probes: their places, what they are judged over, and their answers.

#include "render/verify/probe.h"
#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/verify/probe_reference.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Frames = std::vector<std::int64_t>;

TEST(ProbePlace, FirstProbesAreSpreadOverPictureAndFrames) {
    const Frames frames = {10, 11, 12, 13};
    std::map<std::int64_t, int> by_frame;
    std::map<int, int> by_column, by_row;
    for (std::size_t i = 0; i < 64; ++i) {
        const ProbePlace place = place_probe(i, frames, 64, 64);
        EXPECT_EQ(place.block.width, 16);
        EXPECT_EQ(place.block.height, 16);
        ++by_frame[place.frame];
        ++by_column[place.block.x];
        ++by_row[place.block.y];
    }
    for (const auto& [frame, count] : by_frame) EXPECT_NEAR(count, 16, 2) << frame;
    for (const auto& counts : {by_column, by_row}) {
        ASSERT_EQ(counts.size(), 4u);
        for (const auto& [at, count] : counts) EXPECT_NEAR(count, 16, 3) << at;
    }
}

TEST(ProbePlace, BlocksCoverThePicture) {
    std::set<std::pair<int, int>> seen;
    for (std::size_t i = 0; i < 400; ++i) {
        const PictureArea block = place_probe(i, Frames{0}, 45, 20).block;
        EXPECT_LE(block.x + block.width, 45);
        EXPECT_LE(block.y + block.height, 20);
        for (int y = 0; y < block.height; ++y) {
            for (int x = 0; x < block.width; ++x) seen.insert({block.x + x, block.y + y});
        }
    }
    EXPECT_EQ(seen.size(), 45u * 20u);
}

TEST(ProbeWindow, EndsAtCutsAndTheShot) {
    const FrameRange range{0, 20};
    EXPECT_EQ(list_window(10, 2, range, Frames{}), (Frames{8, 9, 10, 11, 12}));
    EXPECT_EQ(list_window(10, 2, range, Frames{10}), (Frames{10, 11, 12}));
    EXPECT_EQ(list_window(10, 2, range, Frames{11}), (Frames{8, 9, 10}));
    EXPECT_EQ(list_window(10, 2, range, Frames{9}), (Frames{9, 10, 11, 12}));
    EXPECT_EQ(list_window(0, 2, range, Frames{}), (Frames{0, 1, 2}));
    EXPECT_EQ(list_window(20, 2, range, Frames{}), (Frames{18, 19, 20}));
    EXPECT_EQ(list_window(30, 2, range, Frames{}), (Frames{30}));
}

TEST(ContinuedError, IsEvenWhereItIsEvenInThePart) {
    PicturePart part(40, 30, std::uint8_t{0});
    Image<Rgb> error(40, 30, Rgb(7.0f));
    for (int y = 8; y < 20; ++y) {
        for (int x = 4; x < 18; ++x) part(x, y) = 1, error(x, y) = {0.25f, -0.5f, 1.0f};
    }
    error(6, 10).x = float_nan;
    const Image<Rgb> all = continue_error(error, part);
    for (const auto [x, y] : all_pixels(40, 30)) {
        EXPECT_NEAR(all(x, y).x, 0.25f, 1e-4f) << x << " " << y;
        EXPECT_NEAR(all(x, y).y, -0.5f, 1e-4f);
    }
    for (const Rgb& none : continue_error(error, PicturePart(40, 30, std::uint8_t{0})).pixels)
        EXPECT_EQ(none, Rgb(0.0f));
}

TEST(ProbeResults, AreSummedUp) {
    std::vector<ProbeResult> probes(3);
    const std::int64_t frames[] = {7, 7, 9};
    const std::size_t windows[] = {3, 5, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        probes[i].place.frame = frames[i];
        probes[i].window = windows[i];
        probes[i].noise = settled_noise * static_cast<double>(i);
        probes[i].pixels = 100.0;
        probes[i].beyond = 3.0;
    }
    const VerifiedStatistics all = sum_up(probes, 2.0);
    EXPECT_EQ(all.blocks, 3u);
    EXPECT_EQ(all.frames, 2u);
    EXPECT_EQ(all.window, 5u);
    EXPECT_EQ(all.unsettled, 1u) << "noise of just settled_noise is settled";
    EXPECT_DOUBLE_EQ(all.beyond.share, 0.03);
    EXPECT_DOUBLE_EQ(all.seen.share, 0.0);
}

TEST(PictureKeeper, DropsWhatWasNotUsedForLongest) {
    Frames made;
    PictureKeeper keeper(
        [&](std::int64_t frame) {
            made.push_back(frame);
            return Image<Rgb>(2, 2, Rgb(static_cast<float>(frame)));
        },
        2 * 4 * sizeof(Rgb));
    keeper.keep(1, Image<Rgb>(2, 2, Rgb(1.0f)));
    EXPECT_EQ(keeper.find(2)(0, 0), Rgb(2.0f));
    EXPECT_EQ(keeper.find(1)(0, 0), Rgb(1.0f));
    keeper.find(3);
    keeper.find(1);
    keeper.find(2);
    EXPECT_EQ(made, (Frames{2, 3, 2}));
}

/// A Cornell box at 8 frames per second: the instrument looks at one frame either way. Seen from afar, so that
/// references settle soon.
class Probes : public testing::Test {
  protected:
    Probes() : scene(load_scene((source_folder() / "scenes/cornell/scene.json").string())) {
        scene.film.frame_rate = {8, 1};
        scene.film.viewing.pixels_per_degree = 90.0;
    }

    static RenderSettings traced(int spp, std::uint32_t seed = 0) {
        RenderSettings settings = quick_settings(24, 18);
        settings.light.integrator = Integrator::path;
        settings.light.bounces = 16;
        settings.perception.guide = Guide::none;
        settings.sampling.spp = spp;
        settings.seed = seed;
        return settings;
    }

    Image<Rgb> render(const RenderSettings& settings, std::int64_t frame) const {
        return Sequence(scene, settings).render(frame).shaded.color;
    }

    std::vector<ProbeResult> measure(const RenderSettings& settings, std::size_t end, const Frames& frames,
                                     std::size_t first = 0) const {
        Sequence sequence(scene, settings);
        PictureKeeper pictures([&](std::int64_t frame) { return sequence.render(frame).shaded.color; }, 1 << 24);
        Prober prober(scene, settings, "", frames, pictures);
        std::vector<ProbeResult> results;
        for (std::size_t i = first; i < end; ++i) results.push_back(prober.measure(i));
        return results;
    }

    Scene scene;
};

TEST_F(Probes, PicturesThatAreTheReferenceHaveNoErrors) {
    const std::vector<ProbeResult> results = measure(traced(512), 4, {20, 21});
    const VerifiedStatistics all = sum_up(results, 1.0);
    EXPECT_LT(all.seen.share, 0.02);
    EXPECT_EQ(all.blocks, 4u);
    EXPECT_EQ(all.window, 3u);
    EXPECT_EQ(all.unsettled, 0u);
    for (const ProbeResult& each : results) EXPECT_LE(each.noise, settled_noise);
}

TEST_F(Probes, EndWithinAPictureWhenTheyAreStopped) {
    const RenderSettings settings = traced(16);
    PictureKeeper pictures([&](std::int64_t frame) { return render(settings, frame); }, 1 << 24);
    Prober prober(scene, settings, "", {20}, pictures);
    struct StoppedHere {};
    int reports = 0;
    const auto stop = [&](double, const char*) {
        if (++reports == 2) throw StoppedHere();
    };
    EXPECT_THROW(prober.measure(0, stop), StoppedHere);
    EXPECT_EQ(reports, 2);
}

TEST_F(Probes, SayOfBlocksWhatWholePicturesSay) {
    const RenderSettings settings = traced(16);
    VisibleDifference difference({scene.film.viewing, scene.film.frame_rate}, 20);
    Sequence motion(scene, traced_reference_settings(settings));
    std::vector<VisibleMaps> whole;
    for (const std::int64_t frame : {19, 20, 21}) {
        const Image<Rgb> one = render(traced(512, 71), frame), other = render(traced(513, 72), frame);
        PicturePair pair{render(settings, frame), one, one};
        for (std::size_t i = 0; i < one.size(); ++i) {
            pair.reference.pixels[i] = 0.5f * (one.pixels[i] + other.pixels[i]);
            pair.noise.pixels[i] = 0.5f * (one.pixels[i] - other.pixels[i]);
        }
        const std::vector<VisibleMaps> done = difference.add(frame, pair, read_maps(motion.find_motion(frame)));
        whole.insert(whole.end(), done.begin(), done.end());
    }
    difference.finish();
    ASSERT_EQ(whole.size(), 1u);

    std::map<std::pair<int, int>, ProbeResult> blocks;
    Sequence sequence(scene, settings);
    PictureKeeper pictures([&](std::int64_t frame) { return sequence.render(frame).shaded.color; }, 1 << 24);
    Prober prober(scene, settings, "", {20}, pictures);
    double probed = 0.0, compared = 0.0, pixels = 0.0;
    for (std::size_t i = 0; blocks.size() < 4 && i < 16; ++i) {
        const PictureArea place = place_probe(i, Frames{20}, 24, 18).block;
        if (blocks.contains({place.x, place.y})) continue;
        const ProbeResult result = blocks[{place.x, place.y}] = prober.measure(i);
        EXPECT_EQ(result.place.frame, 20);
        const Image<float> seen = crop(whole.front().seen, place);
        probed += result.seen;
        pixels += result.pixels;
        compared += static_cast<double>(std::ranges::count_if(seen.pixels, [](float value) { return value >= 1.0f; }));
    }
    EXPECT_EQ(pixels, 24.0 * 18.0) << "all blocks";
    EXPECT_GT(compared / pixels, 0.1);
    EXPECT_LT(compared / pixels, 0.97);
    EXPECT_NEAR(probed / pixels, compared / pixels, 0.06);
}

TEST_F(Probes, AreTheSameForAnyNumberOfThreadsAndProbesBefore) {
    const RenderSettings settings = quick_settings(24, 18);
    const auto with_threads = [&](int threads, std::size_t first) {
        const ThreadLimit limit(threads);
        return measure(settings, 2, {20, 21}, first);
    };
    EXPECT_EQ(with_threads(1, 0).back(), with_threads(4, 1).front());
}

TEST_F(Probes, JudgeASingleFrame) {
    scene.film.range = FrameRange{20, 20};
    const std::vector<ProbeResult> results = measure(traced(4), 1, {20});
    EXPECT_EQ(results.front().window, 1u);
    EXPECT_GT(results.front().seen, 0.0);
}

}  // namespace
}  // namespace aleph
