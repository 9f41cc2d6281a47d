#include "scenes/pool/pool_scene.h"

#include <glm/trigonometric.hpp>

#include "scenes/common/build.h"
#include "scenes/common/keys.h"

namespace aleph {

void add_camera(Scene& scene, bool moves) {
    // The camera pans on an arm of 60 cm: the walls move by about 3 pixels per frame at 640x480, the table by less.
    // When the balls have spread, it approaches over the near rail and down towards them, and is still moving at the
    // end.
    const int first_of_move = 32;                           // frame
    const double arm = 0.6, height = 1.4;                   // m
    const double first = 68.8, last = 93.2, pitch = -15.2;  // degrees; 90 looks along -x
    const glm::dvec3 pivot(1.6, 0.0, 0.2), move(-0.82, -0.4, -0.12);
    const double lift = 4.3;                                         // degrees, added to the pitch on the way in
    const double begin = first_of_move / 30.0, rest = 102.0 / 30.0;  // s: start and end of the whole approach

    const int rig = add_node(scene, "camera_rig", no_index, pivot);
    turn_about(scene, rig, y_axis, glm::radians(first));
    const int camera = add_node(scene, "camera", rig, {0.0, height, arm});
    turn_about(scene, camera, x_axis, glm::radians(pitch));
    hang_camera(scene, 40.0);
    if (!moves) return;

    Track<double> turn;
    turn.sampling.period = last_frame / 30.0;
    turn.values = {glm::radians(first), glm::radians(last)};
    turn_about(scene, rig, y_axis, turn);
    // A part of the cubic from rest to rest is a cubic again.
    const auto share = [&](double seconds) {
        const double t = (seconds - begin) / (rest - begin);
        return t * t * (3.0 - 2.0 * t);
    };
    const double end = last_frame / 30.0, t = (end - begin) / (rest - begin);
    const glm::dvec3 velocity = 6.0 * t * (1.0 - t) / (rest - begin) * move;
    scene.nodes[rig].transform.translation =
        cubic_track<glm::dvec3>({{begin, {}, pivot, {}}, {end, velocity, pivot + share(end) * move, velocity}});
    // The pitch has one key per frame, because other formats have no cubic rotations about an axis.
    Track<double> tilt;
    tilt.sampling.start = begin;
    tilt.sampling.period = 1.0 / 30.0;
    tilt.values.clear();
    for (int frame = first_of_move; frame <= last_frame; ++frame)
        tilt.values.push_back(glm::radians(to_millionth(pitch + share(frame / 30.0) * lift)));
    turn_about(scene, camera, x_axis, tilt);
}

std::vector<DrawnTexture> make_pool_textures() {
    return join({make_room_textures(), make_ball_textures()});
}

Scene make_pool_scene(bool camera_moves, const std::string& textures) {
    const PoolSettings settings;
    const double duration = last_frame / 30.0 - strike_time;
    const PoolRun run = simulate_pool(make_rack(settings), settings, duration, samples_per_second);

    // Exposure chosen by eye. The automatic one uses direct light only, which is weak on the walls: the cloth would be
    // overexposed.
    Scene scene = begin_scene(camera_moves ? "pool" : "pool-still", last_frame, 3.0, textures, make_pool_textures());
    add_room(scene);
    add_lights(scene);
    add_table(scene, settings);
    add_balls(scene, settings, run);
    add_cue(scene, settings, run.samples.front()[cue_ball]);
    add_camera(scene, camera_moves);
    return scene;
}

}  // namespace aleph
