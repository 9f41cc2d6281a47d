// Changes of a sequence's scene between frames, and the motion of the first frame after one.

#include <algorithm>
#include <numeric>

#include "engine/load/validate_scene.h"
#include "render/frame/sequence.h"
#include "render/frame/sequence_state.h"

namespace aleph {

namespace {

/// Whether surfaces of one pose can be found in the other.
bool has_same_elements(const ScenePose& a, const ScenePose& b) {
    const auto same_size = [](const PosedMesh& m, const PosedMesh& n) {
        return m.positions.size() == n.positions.size() && m.control.size() == n.control.size();
    };
    return a.instances == b.instances && a.world.size() == b.world.size() && a.cameras.size() == b.cameras.size() &&
           std::ranges::equal(a.meshes, b.meshes, same_size);
}

}  // namespace

void Sequence::edit(const std::function<void(Scene&)>& change) {
    SequenceState& old = state();
    Scene scene = old.scene;
    change(scene);
    validate(scene);
    const std::vector<CameraShot> shots = list_camera_shots(scene, camera_);
    auto made = std::make_unique<SequenceState>(std::move(scene), old.settings, shots);
    made->exposure = made->scene.exposure.value_or(old.exposure);
    made->before_edit = old.rendered ? std::move(old.now) : std::move(old.before_edit);
    state_ = std::move(made);
}

/// Makes the frame rendered before the edit the other one, after `now` has been moved to this frame.
/// @return none if the two have no motion
OtherFrame SequenceState::take_pose_before_edit(std::int64_t frame) {
    const bool begins_shot = std::ranges::find(scene.cuts, frame) != scene.cuts.end();
    if (begins_shot || !has_same_elements(before_edit->pose, now->pose)) return OtherFrame::none;
    other = before_edit;
    other_is_before_edit = true;
    return OtherFrame::previous;
}

/// An edit may have moved what the scene's own tracks leave at rest.
PosePlan SequenceState::make_plan_of_all() const {
    PosePlan plan = pose_plan;
    std::ranges::fill(plan.moving, std::uint8_t{1});
    plan.nodes.resize(scene.nodes.size());
    std::iota(plan.nodes.begin(), plan.nodes.end(), 0);
    plan.instances.resize(now->pose.instances.size());
    std::iota(plan.instances.begin(), plan.instances.end(), 0);
    return plan;
}

/// Later frames have the motion of the scene's tracks.
void SequenceState::forget_pose_before_edit() {
    before_edit.reset();
    if (!other_is_before_edit) return;
    other_is_before_edit = false;
    other.reset();
    other_rays.reset();
}

}  // namespace aleph
