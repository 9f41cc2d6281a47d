// The break shot of the scene `pool`: momentum is conserved, energy falls, balls do not overlap.

#include "scenes/pool/break.h"
#include "scenes/pool/simulation.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// The simulation behind the scene `pool`.
const PoolRun& break_run() {
    static const PoolRun run = simulate_pool(make_rack(PoolSettings{}), PoolSettings{}, 3.0, 120.0);
    return run;
}

TEST(PoolBreak, HasARackAndACueBallAndManyCollisions) {
    const PoolRun& run = break_run();
    EXPECT_EQ(run.samples.size(), 361u);
    EXPECT_EQ(run.samples.front().size(), 16u);
    const auto cushions =
        std::count_if(run.events.begin(), run.events.end(), [](auto& event) { return event.cushion; });
    EXPECT_GT(cushions, 12);
    EXPECT_GT(static_cast<long>(run.events.size()) - cushions, 6);
    EXPECT_EQ(run.events.front().balls.size(), 16u);  // the whole rack takes part in the first impact
    // Each ball moves by at least one radius.
    for (std::size_t i = 0; i < 16; ++i)
        EXPECT_GT(glm::distance(run.samples.front()[i].position, run.samples.back()[i].position), 0.028575) << i;
}

TEST(PoolBreak, MomentumIsConservedInEveryBallCollision) {
    for (const PoolEvent& event : break_run().events) {
        if (event.cushion) continue;
        const double size = std::max(glm::length(event.momentum_before), 1e-3);
        EXPECT_LE(glm::length(event.momentum_after - event.momentum_before), 1e-15 * size)
            << event.balls.size() << " balls at " << event.seconds;
    }
}

TEST(PoolBreak, EnergyNeverRises) {
    const PoolSettings settings;
    const PoolRun& run = break_run();
    for (const PoolEvent& event : run.events)
        EXPECT_LE(event.energy_after, event.energy_before * (1.0 + 4e-16)) << event.seconds;
    double before = infinity;
    for (const auto& balls : run.samples) {
        const double now = kinetic_energy(balls, settings);
        EXPECT_LE(now, before);
        before = now;
    }
    EXPECT_LT(before, 0.5 * kinetic_energy(run.samples.front(), settings));
    EXPECT_GT(before, 0.0);
}

TEST(PoolBreak, BallsNeverOverlapAndStayOnTheTable) {
    const PoolSettings settings;
    double nearest = 1.0;
    for (const auto& balls : break_run().samples) {
        for (std::size_t i = 0; i < balls.size(); ++i) {
            EXPECT_EQ(balls[i].position.y, settings.radius);
            EXPECT_LE(std::abs(balls[i].position.x), 0.5 * settings.length - settings.radius + 1e-9);
            EXPECT_LE(std::abs(balls[i].position.z), 0.5 * settings.width - settings.radius + 1e-9);
            for (std::size_t j = 0; j < i; ++j)
                nearest = std::min(nearest, glm::distance(balls[i].position, balls[j].position));
        }
    }
    EXPECT_GE(nearest, 2.0 * settings.radius - 1e-9);
    EXPECT_LT(nearest, 2.0 * settings.radius + 1e-3);  // some balls touch
}

TEST(PoolBreak, SpinIsExchanged) {
    // The rack starts without spin about y; friction between balls and cushions causes some.
    double most = 0.0;
    for (const auto& balls : break_run().samples)
        for (std::size_t i = 0; i + 1 < balls.size(); ++i) most = std::max(most, std::abs(balls[i].angular_velocity.y));
    EXPECT_GT(most, 1.0);
}

TEST(PoolBreak, SameArgumentsGiveTheSameBits) {
    const PoolRun again = simulate_pool(make_rack(PoolSettings{}), PoolSettings{}, 3.0, 120.0);
    const PoolRun& run = break_run();
    ASSERT_EQ(again.events.size(), run.events.size());
    for (std::size_t i = 0; i < run.samples.back().size(); ++i) {
        EXPECT_EQ(again.samples.back()[i].position, run.samples.back()[i].position);
        EXPECT_EQ(again.samples.back()[i].orientation, run.samples.back()[i].orientation);
    }
}

}  // namespace
}  // namespace aleph
