// The times of an open shutter at which indirect light is computed, from what a few paths measure.

#include "render/time/shutter_keys.h"

#include <cmath>
#include <numbers>

#include "tests/render/time/plate.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// The times for a shutter of one frame, of which so many cycles of the light pass: it goes from half to one and a
/// half.
ShutterTimes choose_for_cycles(double cycles, const std::vector<double>& jumps = {}) {
    Plate plate;
    plate.scene.nodes[2].transform.translation = move_between({8.0, 1.0, 0.0}, {8.1, 1.0, 0.0});
    std::vector<std::unique_ptr<Stage>> stages;
    const auto stage_at = [&](double at) -> const Stage& {
        return *stages.emplace_back(std::make_unique<Stage>(plate.scene, 32, 24, at));
    };
    const Stage& center = stage_at(0.5);
    const SampleHits hits = cast_centers(center.rays, center.view, nullptr);
    const Image<float> accuracy(32, 24, 0.15f);
    ShutterPlaces places{{}, center.shading, accuracy};
    for (int x = 12; x < 20; ++x)
        for (int y = 9; y < 15; ++y)
            places.surfaces.push_back(make_pixel_surface(center.shading, center.view, hits, x, y));
    const auto probe = [&](double at) {
        const double light = 1.0 + 0.5 * std::cos(2.0 * std::numbers::pi * cycles * (at - 0.5));
        return ProbedLight(places.surfaces.size(), static_cast<float>(light));
    };
    places.probed = probe(0.5);
    const PoseAt pose = [&](double at) {
        const auto key = std::make_shared<KeyPose>();
        key->shading = stage_at(at).shading;
        key->probed = probe(at);
        return key;
    };
    ShutterTimes times = choose_times({0.0, 1.0}, jumps, places, pose, 8);
    for (KeySpan& span : times.spans) span.first.pose = span.last.pose = nullptr;  // the stages end here
    return times;
}

TEST(ShutterKeys, MC27_LightThatHardlyChangesIsThatOfTheCenter) {
    const ShutterTimes times = choose_for_cycles(0.0);
    EXPECT_TRUE(times.spans.empty());
    EXPECT_EQ(times.from_center.largest(), 0.0f);
}

TEST(ShutterKeys, MC27_AFanThatIsTheSameAtBothEndsAndInTheMiddleIsSeenBetweenThem) {
    EXPECT_GE(choose_for_cycles(2.0).spans.size(), 4);
    EXPECT_GE(choose_for_cycles(2.0, {0.3}).spans.size(), 4) << "light may jump, too";
}

TEST(ShutterKeys, MC27_AFanInStepWithEvenTimesIsSeen) {
    for (const double cycles : {4.0, 8.0, 16.0}) {
        const ShutterTimes times = choose_for_cycles(cycles);
        EXPECT_GT(times.from_center.largest(), 0.15f) << cycles;
        EXPECT_TRUE(times.spans.empty() || times.spans.size() == 8) << cycles << ": " << times.spans.size();
    }
}

}  // namespace
}  // namespace aleph
