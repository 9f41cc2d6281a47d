#include "scenes/common/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/common/build.h"
#include "scenes/common/keys.h"

namespace aleph {

void hang_camera(Scene& scene, double fov_degrees) {
    Camera camera;
    camera.name = "camera";
    camera.fov = glm::radians(fov_degrees);
    scene.nodes.back().camera = static_cast<int>(scene.cameras.size());
    scene.cameras.push_back(camera);
}

void add_walking_camera(Scene& scene, const std::vector<CameraStop>& stops, double fov_degrees) {
    std::vector<double> times, yaws, pitches;
    std::vector<glm::dvec3> eyes;
    for (const CameraStop& stop : stops) {
        const glm::dvec3 look = glm::normalize(stop.target - stop.eye);
        times.push_back(stop.frame / 30.0);
        eyes.push_back(stop.eye);
        yaws.push_back(std::atan2(-look.x, -look.z));
        pitches.push_back(std::asin(look.y));
    }
    const int rig = add_node(scene, "camera_rig");
    node_at(scene, rig).transform.translation = eased_track(times, eyes);
    turn_about(scene, rig, y_axis, eased_track(times, yaws));
    turn_about(scene, add_node(scene, "camera", rig), x_axis, eased_track(times, pitches));
    hang_camera(scene, fov_degrees);
}

}  // namespace aleph
