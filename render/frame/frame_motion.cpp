#include "render/frame/frame_motion.h"

#include <algorithm>
#include <numeric>

#include "engine/surface/limit_surface.h"
#include "motion/raster.h"
#include "motion/velocity.h"
#include "perception/sanitize.h"
#include "render/estimate/sight_line.h"
#include "render/frame/prepared_frame.h"
#include "render/settings/measure.h"

namespace aleph {

namespace {

/// Returns whether surfaces of one pose can be found in the other.
bool has_same_elements(const ScenePose& a, const ScenePose& b) {
    const auto same_size = [](const PosedMesh& m, const PosedMesh& n) {
        return m.positions.size() == n.positions.size() && m.control.size() == n.control.size();
    };
    return a.instances == b.instances && a.world.size() == b.world.size() && a.cameras.size() == b.cameras.size() &&
           std::ranges::equal(a.meshes, b.meshes, same_size);
}

PosePlan plan_all(PosePlan plan, std::size_t nodes, std::size_t instances) {
    std::ranges::fill(plan.moving, std::uint8_t{1});
    plan.nodes.resize(nodes);
    std::iota(plan.nodes.begin(), plan.nodes.end(), 0);
    plan.instances.resize(instances);
    std::iota(plan.instances.begin(), plan.instances.end(), 0);
    return plan;
}

}  // namespace

void FrameMotion::begin_edited(FrameBeforeEdit before) {
    // The level of a moving cage may be another now: the same surface has other triangles.
    std::vector<PosedMesh>& posed = before.posed.pose.meshes;
    for (std::size_t m = 0; before.same_triangles && m < posed.size(); ++m) {
        const MeshSubdivision& made = shot_.scene.meshes[m].subdivision;
        if (!posed[m].control.empty())
            made.limit.surface->evaluate_vertices(made.part, posed[m].control, posed[m].positions, posed[m].normals);
    }
    before_edit_ = std::move(before);
}

std::optional<FrameBeforeEdit> FrameMotion::end_edited() {
    edited_.reset();
    from_edit_ = false;
    return std::exchange(before_edit_, std::nullopt);
}

OtherFrame FrameMotion::pose_other(const FrameWork& work, const PosedView& here) {
    edited_.reset();
    from_edit_ = false;
    if (!work.edited || !work.perceive) {
        if (work.other != OtherFrame::none) other_.pose(other_frame_number(work.frame, work.other));
        return work.other;
    }
    from_edit_ = is_found_before_edit(work, here);
    return from_edit_ ? OtherFrame::previous : OtherFrame::none;
}

/// Returns whether the frame before the edit shows what this one does, with the same camera in the same shot.
bool FrameMotion::is_found_before_edit(const FrameWork& work, const PosedView& here) const {
    const auto [first, last] = std::minmax(before_edit_->frame, work.frame);
    const auto is_between = [first = first, last = last](std::int64_t cut) { return first < cut && cut <= last; };
    return before_edit_->same_triangles && before_edit_->posed.camera == here.camera &&
           std::ranges::none_of(shot_.scene.film.cuts, is_between) &&
           has_same_elements(before_edit_->posed.pose, here.pose);
}

FrameScene& FrameMotion::other_scene(const FrameScene& here) {
    if (!from_edit_) return other_;
    all_ = plan_all(shot_.pose_plan, shot_.scene.nodes.size(), here.posed().pose.instances.size());
    edited_ = std::make_unique<FrameScene>(shot_, all_);
    edited_->pose(before_edit_->posed);
    return *edited_;
}

void FrameMotion::compute(const FrameWork& work, const FrameScene& here, EstimateLight& light, StageClock& clock,
                          PreparedFrame& frame) {
    const FramePlan& plan = frame.plan;
    const SampleHits& centers = frame.centers;
    FrameOutput& out = frame.out;
    const bool has_other = work.other != OtherFrame::none;
    RayCounts& counts = out.statistics.counts.rays;
    if (shot_.settings.guide.motion == MotionSource::raster) items_ = rasterize(shot_.scene, here.posed());
    if (has_other && plan.skips(Effect::motion)) {
        out.motion = make_still_motion(out.view, centers.hits);
        return;
    }
    const std::optional<PictureSearch> search = picture_search(shot_.settings.guide.motion);
    if (search) {
        out.motion = has_other ? search_other(work, here, light, *search, clock, frame)
                               : make_motion_field(out.view.width, out.view.height, MotionValidity::no_counterpart);
        return;
    }
    out.motion = compute_from_scene(here.posed(), has_other ? other_view() : here.posed(), centers.hits, work.other);
    if (!has_other || !work.maps) return;
    FrameScene& other = other_scene(here);
    other.update_rays();
    counts.primary += mark_hidden(out.motion, shot_.scene, other.posed(), points(centers.hits), other.rays());
}

Image<float> FrameMotion::find_velocity(const FrameWork& work, const FrameScene& here, PreparedFrame& frame) {
    FrameOutput& out = frame.out;
    const Film& film = shot_.scene.film;
    Image<float> slowest = compute_image_velocity(out.motion, film.viewing, film.frame_rate);
    const bool moves = std::ranges::any_of(slowest.pixels, [](float speed) { return speed > 0.0f; });
    if (!moves || shot_.settings.guide.motion != MotionSource::model) return slowest;
    for (const Image<Hit>& layer : find_layers(here.lighting(), out.view, frame.centers, out.statistics.counts.rays)) {
        const Image<float> velocity = compute_image_velocity(
            compute_from_scene(here.posed(), other_view(), layer, work.other), film.viewing, film.frame_rate);
        std::ranges::transform(slowest.pixels, velocity.pixels, slowest.pixels.begin(),
                               [](float a, float b) { return std::min(a, b); });
    }
    return slowest;
}

const Image<Hit>& FrameMotion::points(const Image<Hit>& hits) const {
    return shot_.settings.guide.motion == MotionSource::raster ? items_ : hits;
}

MotionField FrameMotion::compute_from_scene(const PosedView& here, const PosedView& other, const Image<Hit>& hits,
                                            OtherFrame which) {
    if (!model_) model_.emplace(shot_.scene, shot_.pose_plan);
    return shot_.settings.guide.motion == MotionSource::raster
               ? compute_raster_motion(*model_, shot_.scene, here, other, items_, which)
               : model_->compute(here, other, hits, which);
}

MotionField FrameMotion::search_other(const FrameWork& work, const FrameScene& here, EstimateLight& light,
                                      PictureSearch search, StageClock& clock, PreparedFrame& frame) {
    FrameOutput& out = frame.out;
    RayCounts& counts = out.statistics.counts.rays;
    FrameScene& other = other_scene(here);
    other.prepare();
    const SampleHits centers = cast_centers(other.rays(), other.posed().view, &counts.primary);
    other.find_known_lights(centers, counts);
    std::optional<EstimateNodes> nodes;
    if (shot_.estimates_indirect_light(frame.plan.settings.light.bounces))
        nodes = light.gather_nodes(other_frame_number(work.frame, work.other), other, centers, counts);
    Image<Rgb> estimate = estimate_scene(shot_, other, centers, nodes ? &*nodes : nullptr, counts);
    sanitize_estimate(estimate);
    clock.add_to(out.statistics.seconds.estimate);
    MotionField found =
        compute_picture_motion(prepare_picture(out.estimate, search), prepare_picture(estimate, search), search);
    if (work.other == OtherFrame::previous) turn_round(found);
    return found;
}

void FrameMotion::compute_backward(const FrameWork& work, const FrameScene& here, PreparedFrame& frame) {
    FrameOutput& out = frame.out;
    if (work.edited || picture_search(shot_.settings.guide.motion)) return;
    const OtherFrame other = shot_.backward_frame(work.frame);
    if (other == OtherFrame::next) {
        out.backward = out.motion;
        return turn_round(out.backward);
    }
    const Image<Hit>& hits = frame.centers.hits;
    if (other == OtherFrame::previous) other_.pose(work.frame - 1);
    const PosedView& before = other == OtherFrame::previous ? other_.posed() : here.posed();
    out.backward = compute_from_scene(here.posed(), before, hits, other);
    if (other == OtherFrame::none) return;
    turn_round(out.backward);
    other_.update_rays();
    out.statistics.counts.rays.primary +=
        mark_hidden(out.backward, shot_.scene, other_.posed(), points(hits), other_.rays());
}

}  // namespace aleph
