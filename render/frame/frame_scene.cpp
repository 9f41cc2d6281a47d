#include "render/frame/frame_scene.h"

#include "render/light/find_sky_openings.h"

namespace aleph {

void FrameScene::pose(double seconds, int camera, int width, int height) {
    if (posed_ && posed_->view.width == width && posed_->view.height == height) {
        update_posed_view(shot_.scene, plan_, seconds, camera, *posed_);
        return;
    }
    shading_.reset();
    posed_ = make_posed_view(shot_.scene, seconds, camera, width, height);
}

void FrameScene::pose(std::int64_t frame) {
    pose(shot_.seconds(frame), shot_.camera(frame), shot_.settings.picture.width, shot_.settings.picture.height);
}

void FrameScene::pose(const PosedView& given) {
    shading_.reset();
    posed_ = given;
}

std::size_t FrameScene::update_rays() {
    if (!rays_) rays_ = meshes_->rays().share_meshes();
    return rays_->update(posed_->pose, compute_anchor(posed_->view));
}

std::size_t FrameScene::prepare() {
    const std::size_t touched = update_rays();
    if (shading_) {
        update_shading_scene(*shading_, plan_, *rays_);
    } else {
        shading_ = make_shading_scene(shot_.scene, posed_->pose, *rays_, shot_.textures);
    }
    lights_ = make_light_set(*shading_, std::move(lights_));
    around_ = {};
    known_ = {};
    leave_out(shot_.settings.effects.forbid);
    shading_->points_unshadowed = false;
    shading_->caustic_width = find_caustic_width(shot_.settings);
    return touched;
}

void FrameScene::find_media_around(std::uint64_t& rays_cast) {
    Tracer tracer(*rays_, Blend::random);
    const glm::vec3 camera(posed_->view.position - rays_->anchor()), up(0.0f, 1.0f, 0.0f);
    around_ = find_media(*shading_, tracer, {camera, up}, rays_cast);
}

void FrameScene::find_known_lights(const SampleHits& centers, RayCounts& counts) {
    known_ = aleph::find_known_lights(lighting(), posed_->view, centers, counts);
    make_light_trees();
}

void FrameScene::take_known_lights(const FrameScene& other) {
    known_ = other.known_;
    if (known_.openings) move_openings(glm::vec3(other.rays_->anchor() - rays_->anchor()), *known_.openings);
    make_light_trees();
}

void FrameScene::add_known_lights(const FrameScene& other, const SampleHits& centers, RayCounts& counts) {
    aleph::add_known_lights(aleph::find_known_lights(other.lighting(), posed_->view, centers, counts),
                            glm::vec3(other.rays_->anchor() - rays_->anchor()), known_);
    make_light_trees();
}

void FrameScene::make_light_trees() {
    trees_ = KnownLightTrees(*shading_, lights_, known_);
}

LightingContext FrameScene::lighting() const {
    return {*shading_,
            lights_,
            *rays_,
            around_,
            trees_.seen.others.groups.empty() ? nullptr : &trees_.seen,
            trees_.met.groups.empty() ? nullptr : &trees_.met,
            known_.openings ? &*known_.openings : nullptr};
}

void FrameScene::copy_to(KeyPose& kept) const {
    kept.posed = *posed_;
    kept.shading = make_shading_scene(shot_.scene, kept.posed.pose, *rays_, shot_.textures);
    kept.shading.caustic_width = shading_->caustic_width;
}

void FrameScene::leave_out(const EffectSet& effects) {
    shading_->skipped = effects;
    if (effects.contains(Effect::direct_light)) remove_all_lights(lights_);
    make_light_trees();
}

void FrameScene::leave_out(const EffectsPlan& effects) {
    shading_->skipped = effects.left_out();
    shading_->points_unshadowed = effects.points_unshadowed;
    if (shot_.settings.effects.forbid.contains(Effect::direct_light) || effects.lights_left_out.empty()) return;
    std::vector<int> instances, punctual;
    for (const LightFacts& light : effects.lights_left_out) {
        (light.kind == LightFacts::Kind::surface ? instances : punctual).push_back(light.number);
    }
    remove_lights(*shading_, instances, punctual, lights_);
    make_light_trees();
}

}  // namespace aleph
