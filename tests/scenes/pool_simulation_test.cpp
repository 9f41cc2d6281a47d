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

PoolBall resting(double x, double z) {
    return sliding(x, z, glm::dvec3(0.0));
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

void collide_pair(PoolBall& a, PoolBall& b, const PoolSettings& settings) {
    std::vector<PoolBall> balls = {a, b};
    collide_balls(balls, {0, 1}, settings);
    a = balls[0];
    b = balls[1];
}

PoolSettings without_friction() {
    PoolSettings settings;
    settings.sliding_friction = settings.rolling_friction = settings.ball_friction = settings.cushion_friction = 0.0;
    settings.spin_deceleration = 0.0;
    settings.ball_restitution = settings.cushion_restitution = 1.0;
    settings.soft_speed = 0.0;
    return settings;
}

TEST(PoolSimulation, BallAtRestStaysAtRest) {
    const PoolRun run = simulate_pool({resting(0.3, -0.2), resting(0.3 + 2 * 0.028575, -0.2)}, {}, 1.0, 60.0);
    for (const auto& balls : run.samples) {
        EXPECT_EQ(balls[0].position, run.samples[0][0].position);
        EXPECT_EQ(balls[1].position, run.samples[0][1].position);
        EXPECT_EQ(balls[0].orientation, glm::dquat(1.0, 0.0, 0.0, 0.0));
    }
}

TEST(PoolSimulation, HeadOnElasticCollisionSwapsVelocities) {
    const PoolSettings settings = without_friction();
    const PoolBall a = sliding(-0.3, 0.1, {1.5, 0.0, 0.0}), b = sliding(0.2, 0.1, {-0.5, 0.0, 0.0});
    const PoolRun run = simulate_pool({a, b}, settings, 0.3, 100.0);
    const double met = (0.5 - 2 * settings.radius) / 2.0;  // s
    EXPECT_NEAR(run.samples.back()[0].position.x, -0.3 + 1.5 * met - 0.5 * (0.3 - met), 1e-12);
    EXPECT_NEAR(run.samples.back()[0].velocity.x, -0.5, 1e-14);
    EXPECT_NEAR(run.samples.back()[1].velocity.x, 1.5, 1e-14);
}

TEST(PoolSimulation, ElasticObliqueCollisionPartsAtARightAngle) {
    // Equal masses, one at rest: the final velocities are orthogonal, and their squares add up to that of the first.
    const PoolSettings settings = without_friction();
    PoolBall a = sliding(0.0, 0.0, {2.0, 0.0, 0.0}),
             b = resting(2 * settings.radius * std::cos(0.6), 2 * settings.radius * std::sin(0.6));
    collide_pair(a, b, settings);
    EXPECT_NEAR(glm::dot(a.velocity, b.velocity), 0.0, 1e-14);
    EXPECT_NEAR(glm::length(b.velocity), 2.0 * std::cos(0.6), 1e-14);
    EXPECT_NEAR(glm::length(a.velocity), 2.0 * std::sin(0.6), 1e-14);
}

TEST(PoolSimulation, RestitutionSetsTheSpeedOfParting) {
    PoolSettings settings;
    PoolBall a = sliding(0.0, 0.0, {2.0, 0.0, 0.0}), b = resting(2 * settings.radius, 0.0);
    collide_pair(a, b, settings);
    EXPECT_NEAR(b.velocity.x - a.velocity.x, 2.0 * settings.ball_restitution, 1e-14);
    PoolBall c = rolling(1.0, 0.0, {2.0, 0.0, 0.0});
    collide_cushion(c, {-1.0, 0.0, 0.0}, settings);
    EXPECT_NEAR(c.velocity.x, -2.0 * settings.cushion_restitution, 1e-14);
}

TEST(PoolSimulation, TwoBallsStruckAtOnceConserveMomentumAndEnergy) {
    // Elastic, without friction, symmetric: 2 u cos(30) = v - v', 2 u^2 = v^2 - v'^2, so u = .4 sqrt(3) v and v' = -v
    // / 5.
    const PoolSettings settings = without_friction();
    const double pitch = 2.0 * settings.radius;
    std::vector<PoolBall> balls = {sliding(0.0, 0.0, {3.0, 0.0, 0.0}), resting(pitch * std::sqrt(0.75), 0.5 * pitch),
                                   resting(pitch * std::sqrt(0.75), -0.5 * pitch)};
    collide_balls(balls, {0, 1, 2}, settings);
    EXPECT_NEAR(balls[0].velocity.x, -0.6, 1e-4);
    EXPECT_NEAR(balls[0].velocity.z, 0.0, 1e-14);
    for (const int i : {1, 2}) EXPECT_NEAR(glm::length(balls[i].velocity), 1.2 * std::sqrt(3.0), 1e-4);
    EXPECT_NEAR(balls[1].velocity.z, -balls[2].velocity.z, 1e-14);
    EXPECT_NEAR(balls[0].velocity.x + balls[1].velocity.x + balls[2].velocity.x, 3.0, 1e-14);
}

TEST(PoolSimulation, RowOfTouchingBallsPassesTheImpactOn) {
    // Hertzian contacts in a row: nearly all momentum goes to the last ball, and no ball overtakes another.
    const PoolSettings settings = without_friction();
    std::vector<PoolBall> balls;
    for (int i = 0; i < 5; ++i) balls.push_back(resting(i * 2.0 * settings.radius, 0.0));
    balls[0].velocity = {2.0, 0.0, 0.0};
    const double energy = kinetic_energy(balls, settings);
    collide_balls(balls, {0, 1, 2, 3, 4}, settings);
    double sum = 0.0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        sum += balls[i].velocity.x;
        EXPECT_GE(balls[i].velocity.x, balls[i > 0 ? i - 1 : 0].velocity.x - 1e-12);
    }
    EXPECT_NEAR(sum, 2.0, 1e-14);
    EXPECT_GT(balls[4].velocity.x, 1.8);
    EXPECT_LT(balls[4].velocity.x, 2.0);
    EXPECT_NEAR(kinetic_energy(balls, settings), energy, 1e-4 * energy);
}

TEST(PoolSimulation, ContactFrictionTurnsTheOtherBall) {
    // Side spin on a: its surface slides along b at 1.143 m/s, the friction impulse is mu times the normal one.
    const PoolSettings settings;
    PoolBall a = sliding(0.0, 0.0, {2.0, 0.0, 0.0}), b = resting(2 * settings.radius, 0.0);
    a.angular_velocity = {0.0, 40.0, 0.0};
    collide_pair(a, b, settings);
    const double push = 0.5 * (1.0 + settings.ball_restitution) * 2.0;
    const double sideways = settings.ball_friction * push;
    EXPECT_NEAR(b.velocity.z, -sideways, 1e-14);
    EXPECT_NEAR(a.velocity.z, sideways, 1e-14);
    const double turn = 2.5 * sideways / settings.radius;
    EXPECT_NEAR(a.angular_velocity.y, 40.0 - turn, 1e-12);
    EXPECT_NEAR(b.angular_velocity.y, -turn, 1e-12);
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

TEST(PoolSimulation, SpinAboutTheVerticalEndsWithoutMovingTheBall) {
    const PoolSettings settings;
    PoolBall ball = resting(0.0, 0.0);
    ball.angular_velocity = {0.0, 12.0, 0.0};
    const PoolRun run = simulate_pool({ball}, settings, 2.0, 100.0);
    EXPECT_NEAR(run.samples[50][0].angular_velocity.y, 12.0 - 0.5 * settings.spin_deceleration, 1e-9);
    EXPECT_EQ(run.samples.back()[0].angular_velocity.y, 0.0);
    EXPECT_EQ(run.samples.back()[0].position, ball.position);
}

TEST(PoolSimulation, MirroredBreakRunsMirrored) {
    std::vector<PoolBall> balls = {rolling(-0.5, 0.013, {2.0, 0.0, -0.05}), resting(0.1, 0.0), resting(0.3, 0.05)};
    const PoolRun run = simulate_pool(balls, {}, 1.0, 60.0);
    for (PoolBall& ball : balls) {
        ball.position.z = -ball.position.z;
        ball.velocity.z = -ball.velocity.z;
        ball.angular_velocity.x = -ball.angular_velocity.x;
        ball.angular_velocity.y = -ball.angular_velocity.y;
    }
    const PoolRun mirrored = simulate_pool(balls, {}, 1.0, 60.0);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        EXPECT_NE(run.samples.back()[i].position, run.samples.front()[i].position);
        EXPECT_NEAR(run.samples.back()[i].position.x, mirrored.samples.back()[i].position.x, 1e-9);
        EXPECT_NEAR(run.samples.back()[i].position.z, -mirrored.samples.back()[i].position.z, 1e-9);
    }
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

TEST(PoolBreak, SpinIsExchanged) {
    // The rack starts without spin about y; friction between balls and cushions causes some.
    double most = 0.0;
    for (const auto& balls : break_run().samples)
        for (std::size_t i = 0; i + 1 < balls.size(); ++i) most = std::max(most, std::abs(balls[i].angular_velocity.y));
    EXPECT_GT(most, 1.0);
}

}  // namespace
}  // namespace aleph
