#include "scenes/pool/pool_scene.h"

#include <glm/trigonometric.hpp>

#include "scenes/common/build.h"
#include "scenes/common/camera.h"
#include "scenes/common/generator.h"
#include "scenes/pool/break.h"
#include "scenes/pool/textures.h"

namespace aleph {

void add_camera(Scene& scene, bool moves) {
    // It turns on an arm of a quarter of a metre: a pan with a little parallax. Walls move by about 3 pixels a frame at
    // 640x480.
    const double first = -20.0, last = 3.0;  // degrees about y; -x lies ahead at 0
    const int rig = add_node(scene, "camera_rig", no_index, {1.625, 0.0, 0.195});
    AxisRotation turn;
    turn.angle = glm::radians(first);
    if (moves) {
        turn.angle.sampling.period = last_frame / 30.0;
        turn.angle.values = {glm::radians(first), glm::radians(last)};
    }
    node_at(scene, rig).axis_rotation = turn;

    const glm::dquat ahead = z_to_plus_x * glm::angleAxis(glm::radians(-12.5), glm::dvec3(1.0, 0.0, 0.0));
    add_node(scene, "camera", rig, {0.25, 1.27, 0.0}, ahead);
    hang_camera(scene, 40.0);
}

std::vector<DrawnTexture> make_pool_textures() {
    return join({make_room_textures(), make_ball_textures()});
}

Scene make_pool_scene(bool camera_moves, const std::string& textures) {
    const PoolSettings settings;
    const double duration = last_frame / 30.0 - strike_time;
    const PoolRun run = simulate_pool(make_rack(settings), settings, duration, samples_per_second);

    // Exposure by eye. The automatic one goes by direct light alone, of which the walls get little: the cloth would
    // burn out.
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
