// The physics of pool: motions and impacts with a closed form. The break shot of the scene `pool`:
// momentum is conserved, energy falls, balls do not overlap.

#include "scenes/pool/pool_scene.h"
#include "scenes/pool/simulation.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// It slides, without spin.
PoolBall sliding(double x, double z, const glm::dvec3& velocity) {
    PoolBall ball;
    ball.position = {x, PoolSettings{}.radius, z};
    ball.velocity = velocity;
    return ball;
}

PoolBall rolling(double x, double z, const glm::dvec3& velocity) {
    PoolBall ball = sliding(x, z, velocity);
    ball.angular_velocity = glm::cross(glm::dvec3(0.0, 1.0, 0.0), velocity) / PoolSettings{}.radius;
    return ball;
}

/// Kinetic energy of translation and rotation, J.
double kinetic_energy(const std::vector<PoolBall>& balls, const PoolSettings& settings) {
    const double inertia = 0.4 * settings.mass * settings.radius * settings.radius;
    double sum = 0.0;
    for (const PoolBall& ball : balls)
        sum += 0.5 * settings.mass * glm::dot(ball.velocity, ball.velocity) +
               0.5 * inertia * glm::dot(ball.angular_velocity, ball.angular_velocity);
    return sum;
}

TEST(PoolSimulation, StruckBallEndsRollingWithFiveSeventhsOfItsSpeed) {
    PoolSettings settings{.rolling_friction = 0.0};
    // The ball slides for 2/7 v / (mu g) = .2913 s.
    const double end_of_sliding = 2.0 / 7.0 * 2.0 / (settings.sliding_friction * settings.gravity);
    const PoolRun run = simulate_pool({sliding(-1.0, 0.0, {2.0, 0.0, 0.0})}, settings, 0.5, 120.0);
    const PoolBall& end = run.samples.back()[0];
    EXPECT_NEAR(end.velocity.x, 10.0 / 7.0, 1e-12);
    EXPECT_NEAR(-end.angular_velocity.z * settings.radius, end.velocity.x, 1e-12);  // v = omega r
    EXPECT_LT(glm::length(cloth_slip(end, settings)), 1e-12);
    for (std::size_t i = 0; i < run.samples.size(); ++i) {
        const double t = static_cast<double>(i) / 120.0;
        const double slip = glm::length(cloth_slip(run.samples[i][0], settings));
        EXPECT_NEAR(slip, std::max(0.0, 2.0 * (1.0 - t / end_of_sliding)), 1e-10) << t;
    }
}

TEST(PoolSimulation, RollingBallTurnsByDistanceOverRadius) {
    const PoolSettings settings;
    const glm::dvec3 velocity(0.9, 0.0, 0.3);
    const PoolRun run = simulate_pool({rolling(-1.0, -0.4, velocity)}, settings, 1.5, 120.0);
    const glm::dvec3 axis = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), velocity));
    for (const auto& sample : run.samples) {
        const PoolBall& ball = sample[0];
        const double distance = glm::distance(ball.position, run.samples[0][0].position);
        const glm::dquat expected = glm::angleAxis(distance / settings.radius, axis);
        EXPECT_NEAR(std::abs(glm::dot(ball.orientation, expected)), 1.0, 1e-12);
        EXPECT_NEAR(glm::length(ball.velocity), settings.radius * glm::length(ball.angular_velocity), 1e-12);
    }
    EXPECT_GT(glm::distance(run.samples.back()[0].position, run.samples[0][0].position), 1.0);
}

TEST(PoolSimulation, RollingBallStopsAfterVSquaredOverTwoMuG) {
    const PoolSettings settings;
    const double speed = 0.4;
    const double deceleration = settings.rolling_friction * settings.gravity;
    const PoolRun run = simulate_pool({rolling(-1.0, 0.0, {speed, 0.0, 0.0})}, settings, 5.0, 10.0);
    EXPECT_NEAR(run.samples.back()[0].position.x, -1.0 + speed * speed / (2.0 * deceleration), 1e-4);
    EXPECT_EQ(run.samples.back()[0].velocity, glm::dvec3(0.0));
    EXPECT_EQ(run.samples.back()[0].position, run.samples[run.samples.size() - 5][0].position);
    // Half way in time, s = v t - a t^2 / 2. The error of the sub-steps is of first order, a v dt / 2.
    EXPECT_NEAR(run.samples[20][0].position.x, -1.0 + speed * 2.0 - 0.5 * deceleration * 4.0, 1e-4);
}

/// The simulation behind the scene `pool`.
const PoolRun& break_run() {
    static const PoolRun run = simulate_pool(make_rack(PoolSettings{}), PoolSettings{}, 3.0, 120.0);
    return run;
}

/// The cue ball at the apex: all sixteen take part, in one impact.
TEST(PoolBreak, MomentumIsConservedInTheImpactOfTheWholeRack) {
    const PoolSettings settings;
    std::vector<PoolBall> balls = make_rack(settings);
    balls[cue_ball].position = balls[1].position - glm::dvec3(2.0 * settings.radius, 0.0, 0.0);
    std::vector<int> all(16);
    std::iota(all.begin(), all.end(), 0);
    const double energy = kinetic_energy(balls, settings);
    const glm::dvec3 momentum = balls[cue_ball].velocity;
    collide_balls(balls, all, settings);
    glm::dvec3 sum(0.0);
    for (const PoolBall& ball : balls) {
        sum += ball.velocity;
        EXPECT_GT(glm::length(ball.velocity), 1e-3);
    }
    EXPECT_LE(glm::length(sum - momentum), 1e-15 * glm::length(momentum));
    EXPECT_LT(kinetic_energy(balls, settings), energy);
}

TEST(PoolBreak, EnergyNeverRises) {
    const PoolSettings settings;
    const PoolRun& run = break_run();
    EXPECT_EQ(run.samples.size(), 361u);
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

}  // namespace
}  // namespace aleph
