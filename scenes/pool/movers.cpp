#include <fmt/format.h>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/common/build.h"
#include "scenes/common/keys.h"
#include "scenes/pool/pool_scene.h"

namespace aleph {

namespace {

double smooth(double from, double to, double t) {
    const double f = glm::clamp((t - from) / (to - from), 0.0, 1.0);
    return f * f * (3.0 - 2.0 * f);
}

}  // namespace

void add_balls(Scene& scene, const PoolSettings& settings, const PoolRun& run) {
    const Group balls = Group{scene}.add_group("balls", {0.0, cloth_height, 0.0});
    const auto wait = static_cast<std::size_t>(std::lround(strike_time * run.samples_per_second));
    const std::size_t count = wait + run.samples.size();
    for (std::size_t i = 0; i < run.samples.front().size(); ++i) {
        const std::string name = fmt::format("ball_{:02}", i);
        const int material = add_textured(scene, name, name, 0.15);
        LocalTransform& place = scene.nodes[balls.add_shape(name, sphere(settings.radius), material)].transform;
        place.translation.sampling.period = place.rotation.sampling.period = 1.0 / run.samples_per_second;
        place.translation.values.clear();
        place.rotation.values.clear();
        for (std::size_t k = 0; k < count; ++k) {
            const PoolBall& ball = run.samples[k < wait ? 0 : k - wait][i];
            place.translation.values.push_back(to_millionth(ball.position));
            place.rotation.values.push_back(to_millionth(ball.orientation));
        }
    }
}

void add_cue(Scene& scene, const PoolSettings& settings, const PoolBall& struck) {
    const int maple = add_lambert(scene, "cue_shaft", {226, 192, 138}, 0.3);
    const int ebony = add_lambert(scene, "cue_butt", {52, 28, 22}, 0.3);
    const int white = add_lambert(scene, "cue_ferrule", {238, 234, 224});
    const int chalk = add_lambert(scene, "cue_tip", {52, 104, 168});

    // Origin at the tip, the butt along +y.
    const Group cue = Group{scene}.add_group("cue");
    cue.add_shape("tip", cylinder(0.006, 0.01, 24), chalk, {0.0, 0.005, 0.0});
    cue.add_shape("ferrule", cylinder(0.0062, 0.025, 24), white, {0.0, 0.0225, 0.0});
    cue.add_shape("shaft", cylinder(0.008, 0.7, 24), maple, {0.0, 0.385, 0.0});
    cue.add_shape("butt", cylinder(0.0125, 0.72, 24), ebony, {0.0, 1.095, 0.0});

    // Raised by 4 degrees to clear the rail. After the strike it draws back along its axis. When its tip is past the
    // far rail it sinks behind the table to the floor.
    const double raise = glm::radians(4.0);
    const glm::dvec3 back = -std::cos(raise) * glm::normalize(struck.velocity) + glm::dvec3(0.0, std::sin(raise), 0.0);
    const glm::dvec3 contact = struck.position + glm::dvec3(0.0, cloth_height, 0.0) + back * settings.radius;
    const glm::dquat aim = y_towards(back), level = y_towards({back.x, 0.0, back.z});
    const double through = 0.11, withdrawn = 1.04, butt_radius = 0.0125;  // m

    LocalTransform& place = scene.nodes[cue].transform;
    const double rate = 60.0;
    place.translation.sampling.period = place.rotation.sampling.period = 1.0 / rate;
    place.translation.values.clear();
    place.rotation.values.clear();
    for (int i = 0; i <= static_cast<int>(last_frame / 30.0 * rate + 0.5); ++i) {
        const double t = i / rate;
        // Accelerates, hits the ball at strike_time, and follows through by 11 cm.
        const double swing = t < strike_time ? 0.3 * (1.0 - std::pow(t / strike_time, 2.5))
                                             : -through * (1.0 - std::exp((strike_time - t) / 0.035));
        glm::dvec3 tip = contact + back * (swing + (through + withdrawn) * smooth(0.3, 1.1, t));
        const double sunk = smooth(0.87, 1.35, t);
        tip.y = glm::mix(tip.y, butt_radius, sunk);
        place.translation.values.push_back(to_millionth(tip));
        place.rotation.values.push_back(to_millionth(slerp_short(aim, level, sunk)));
    }
}

}  // namespace aleph
