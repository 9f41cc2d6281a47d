#pragma once
// A posed scene seen by one of its cameras: what motion, rays and shading need of one time.

#include "engine/pose/camera_view.h"
#include "engine/pose/plan.h"
#include "engine/pose/pose.h"

namespace aleph {

struct PosedView {
    ScenePose pose;
    CameraView view;
    int camera = 0;  ///< that looks: index into pose.cameras
};

/// @param width, height  pixels
/// @throws InputError as make_camera_view
inline PosedView make_posed_view(const Scene& scene, double seconds, int camera, int width, int height) {
    PosedView posed{pose(scene, seconds), {}, camera};
    posed.view = make_camera_view(scene, posed.pose.cameras[camera], width, height);
    return posed;
}

/// Takes a posed view of the same scene to another time. Only what can change is computed again (update_pose); the size
/// stays.
inline void update_posed_view(const Scene& scene, const PosePlan& plan, double seconds, int camera, PosedView& posed) {
    update_pose(scene, plan, seconds, posed.pose);
    posed.camera = camera;
    posed.view = make_camera_view(scene, posed.pose.cameras[camera], posed.view.width, posed.view.height);
}

}  // namespace aleph
