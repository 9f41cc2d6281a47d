#include "render/time/camera_span.h"

namespace aleph {

std::vector<CameraValues> CameraSpan::look(int camera, double from, double to) {
    constexpr int looks = 9;
    std::vector<CameraValues> values;
    for (int i = 0; i < looks; ++i) {
        const double seconds = from + (to - from) * i / (looks - 1);
        if (posed_) {
            update_pose(scene_, plan_, seconds, *posed_);
        } else {
            posed_ = pose(scene_, seconds);
        }
        values.push_back(posed_->cameras[camera]);
    }
    return values;
}

}  // namespace aleph
