#include "render/pose_change.h"

#include <algorithm>

namespace aleph {

namespace {

constexpr int looks = 9;

}  // namespace

bool world_differs(const PosePlan& plan, const ScenePose& a, const ScenePose& b) {
    const auto instance_differs = [&](int i) {
        const auto [node, mesh] = a.instances[i];
        if (a.shown[i] != b.shown[i]) return true;
        return a.shown[i] != 0 && (a.world[node] != b.world[node] || !(a.meshes[mesh] == b.meshes[mesh]));
    };
    return std::ranges::any_of(plan.instances, instance_differs) ||
           std::ranges::any_of(plan.materials, [&](int m) { return !(a.materials[m] == b.materials[m]); }) ||
           !(a.lights == b.lights) || a.environment != b.environment ||
           a.environment_rotation != b.environment_rotation;
}

bool SpanLook::camera() const {
    return std::ranges::any_of(cameras, [&](const CameraValues& c) { return !(c == cameras.front()); });
}

const ScenePose& SpanLooker::pose_at(double seconds) {
    if (posed_) {
        update_pose(scene_, plan_, seconds, *posed_);
    } else {
        posed_ = pose(scene_, seconds);
    }
    return *posed_;
}

SpanLook SpanLooker::look(int camera, double from, double to) {
    SpanLook span;
    const ScenePose first = pose_at(from);
    span.cameras.push_back(first.cameras[camera]);
    const bool still = plan_.nodes.empty() && plan_.instances.empty() && plan_.materials.empty() && !plan_.lights &&
                       !plan_.environment && plan_.cameras.empty();
    for (int i = 1; i < looks && !still && !span.world; ++i) {
        const ScenePose& now = pose_at(from + (to - from) * i / (looks - 1));
        span.world = world_differs(plan_, first, now);
        span.cameras.push_back(now.cameras[camera]);
    }
    return span;
}

}  // namespace aleph
