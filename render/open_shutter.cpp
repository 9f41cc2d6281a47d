#include "render/open_shutter.h"

namespace aleph {

SampleMoment OpenShutter::move_to(double seconds, int width, int height) {
    if (posed_) {
        update_posed_view(scene_, plan_, seconds, camera_, *posed_);
    } else {
        posed_ = make_posed_view(scene_, seconds, camera_, width, height);
    }
    const glm::dvec3 anchor = compute_anchor(posed_->view);
    rays_.update_moving(posed_->pose, anchor);
    if (shading_) {
        update_shading_scene(*shading_, plan_, anchor);
    } else {
        shading_ = make_shading_scene(scene_, posed_->pose, anchor, textures_);
    }
    lights_ = make_light_set(*shading_);
    return {{*shading_, lights_, rays_}, posed_->view};
}

}  // namespace aleph
