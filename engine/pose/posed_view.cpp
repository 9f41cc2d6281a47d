#include "engine/pose/posed_view.h"

namespace aleph {

PosedView make_posed_view(const Scene& scene, double seconds, int camera, int width, int height) {
    PosedView posed;
    posed.pose = pose(scene, seconds);
    posed.view = make_camera_view(posed.pose.cameras[camera], width, height);
    return posed;
}

void update_posed_view(const Scene& scene, const PosePlan& plan, double seconds, int camera, PosedView& posed) {
    update_pose(scene, plan, seconds, posed.pose);
    posed.view = make_camera_view(posed.pose.cameras[camera], posed.view.width, posed.view.height);
}

}  // namespace aleph
