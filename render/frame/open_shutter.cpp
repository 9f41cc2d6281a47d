#include "render/frame/open_shutter.h"

namespace aleph {

SampleMoment OpenShutter::move_to(double seconds, int camera, int width, int height, const EffectSet& skipped) {
    if (posed_) {
        update_posed_view(scene_, plan_, seconds, camera, *posed_);
    } else {
        posed_ = make_posed_view(scene_, seconds, camera, width, height);
    }
    rays_.update_moving(posed_->pose, compute_anchor(posed_->view));
    if (shading_) {
        update_shading_scene(*shading_, plan_, rays_);
    } else {
        shading_ = make_shading_scene(scene_, posed_->pose, rays_, textures_);
    }
    shading_->skipped = skipped;
    lights_ = make_light_set(*shading_);
    if (skipped.contains(Effect::direct_light)) remove_all_lights(lights_);
    return {{*shading_, lights_, rays_}, posed_->view};
}

}  // namespace aleph
