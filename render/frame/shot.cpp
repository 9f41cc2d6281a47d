#include "render/frame/shot.h"

#include "engine/base/errors.h"
#include "engine/pose/cage_level.h"
#include "engine/pose/parts.h"
#include "engine/rays/alpha_cutout.h"
#include "render/surface/texture.h"

namespace aleph {

namespace {

/// A change of cameras begins a shot.
Scene add_camera_cuts(Scene scene, const std::vector<CameraShot>& shots) {
    for (std::size_t i = 1; i < shots.size(); ++i) scene.film.cuts.push_back(shots[i].first);
    std::ranges::sort(scene.film.cuts);
    const auto repeated = std::ranges::unique(scene.film.cuts);
    scene.film.cuts.erase(repeated.begin(), repeated.end());
    return scene;
}

/// The scene with its subdivision cages at the levels that the picture needs.
Scene refine_cages(Scene scene, const std::vector<CameraShot>& shots, const RenderSettings& settings) {
    if (scene.cages.empty()) return scene;
    std::vector<int> levels(scene.cages.size(), settings.picture.subdivision_level);
    for (const CameraShot& shot : shots) {
        if (settings.picture.subdivision_level >= 0) break;
        const std::vector<int> needed =
            choose_cage_levels(scene, shot.camera, settings.picture.width, settings.picture.height);
        std::ranges::transform(levels, needed, levels.begin(), [](int a, int b) { return std::max(a, b); });
    }
    const std::unique_ptr<Scene> refined = make_scene_at_levels(scene, levels);
    return refined ? std::move(*refined) : std::move(scene);
}

std::vector<int> list_levels(const Scene& scene) {
    std::vector<int> levels;
    for (const Cage& cage : scene.cages) levels.push_back(cage.level);
    return levels;
}

bool is_cut(const Scene& scene, std::int64_t frame) {
    return std::ranges::find(scene.film.cuts, frame) != scene.film.cuts.end();
}

}  // namespace

Lens find_lens(const Scene& scene, const CameraValues& camera) {
    if (!(camera.aperture > 0.0)) return {};
    if (!(camera.focus_distance > 0.0)) {
        throw InputError(scene.source.file, "camera of node " + printable(scene.nodes[camera.node].name),
                         "with an aperture, its focus distance has to be above 0");
    }
    return {camera.aperture, camera.focus_distance};
}

Shot::Shot(Scene given, const RenderSettings& chosen, const std::vector<CameraShot>& camera_shots)
    : given_cuts(given.film.cuts),
      given_levels(list_levels(given)),
      scene(refine_cages(add_camera_cuts(std::move(given), camera_shots), camera_shots, chosen)),
      settings(chosen),
      shots(camera_shots),
      range(frame_range(scene)),
      textures(make_texture_set(scene)),
      pose_plan(make_pose_plan(scene)),
      steady(scene, pose_plan),
      blended(has_blended(scene)),
      crossed_cuts(find_crossed_cuts(scene, [this](std::int64_t frame) { return camera(frame); })) {}

Scene Shot::given_scene() const {
    const std::unique_ptr<Scene> coarse = make_scene_at_levels(scene, given_levels);
    Scene given = coarse ? std::move(*coarse) : scene;
    given.film.cuts = given_cuts;
    return given;
}

glm::dvec2 Shot::shutter(std::int64_t frame) const {
    const int node = find_camera_node(scene, camera(frame));
    return node == no_index ? glm::dvec2(0.0) : scene.cameras[scene.nodes[node].camera].shutter;
}

std::optional<ShutterInterval> Shot::open_shutter(std::int64_t frame) const {
    return can_change() ? find_shutter(scene, shutter(frame), frame, crossed_cuts) : std::nullopt;
}

double Shot::seconds(std::int64_t frame) const {
    return can_change() ? find_shutter_center(scene, shutter(frame), frame, crossed_cuts)
                        : scene.film.frame_rate.seconds_of(frame);
}

OtherFrame Shot::other_frame(std::int64_t frame) const {
    const bool is_last = frame == range.last && range.last > range.first;
    if (is_cut(scene, is_last ? frame : frame + 1)) return OtherFrame::none;
    return is_last ? OtherFrame::previous : OtherFrame::next;
}

OtherFrame Shot::backward_frame(std::int64_t frame) const {
    if (is_cut(scene, frame)) return OtherFrame::none;
    return frame <= range.first ? OtherFrame::next : OtherFrame::previous;
}

}  // namespace aleph
