#pragma once
// Model-based motion, Yee 2000, 5.1.2: project the same surface point Q(u,v) at both times and subtract.

#include <optional>
#include <vector>

#include "engine/pose/posed_view.h"
#include "engine/rays/first_hits.h"
#include "engine/rays/ray_scene.h"
#include "motion/motion_field.h"
#include "motion/turn.h"

namespace aleph {

/// The instances that an image of hits shows, numbered from 0, so that work per instance follows what is seen.
class SeenInstances {
  public:
    /// Numbers the instances in the order of their first pixels.
    /// @param instance_count  of the scene
    void find(const Image<Hit>& hits, std::size_t instance_count) {
        for (const int instance : instances_) numbers_[instance] = no_index;
        instances_.clear();
        numbers_.resize(instance_count, no_index);
        for (const Hit& hit : hits.pixels) {
            if (hit.instance == no_index || numbers_[hit.instance] != no_index) continue;
            numbers_[hit.instance] = static_cast<int>(instances_.size());
            instances_.push_back(hit.instance);
        }
    }

    const std::vector<int>& instances() const { return instances_; }
    /// Place of a seen instance in instances().
    int number(int instance) const { return numbers_[instance]; }

  private:
    std::vector<int> instances_;
    std::vector<int> numbers_;  ///< per instance; no_index: not seen
};

struct PreparedMotion;

/// Motion between frames of one scene. Keeps a pose for the times between two frames, so that the cost follows what is
/// seen and what moves, not the number of objects. The result depends on the arguments alone.
class ModelMotion {
  public:
    /// @param plan  make_pose_plan(scene). Both must outlive this.
    ModelMotion(const Scene& scene, const PosePlan& plan);

    /// Motion of every first hit, in double precision. A world and camera that do not move give exactly 0.
    /// @param other  not read where `which` is none
    /// @param hits   first hits of `now`, of its view's size
    MotionField compute(const PosedView& now, const PosedView& other, const Image<Hit>& hits,
                        OtherFrame which = OtherFrame::next);

  private:
    void sum_paths(PreparedMotion& all, const PosedView& now, const PosedView& other, const Image<Hit>& hits,
                   MotionField& field);
    const ScenePose& pose_between(double seconds);

    const Scene& scene_;
    const PosePlan& plan_;
    TurnFinder turns_;
    SeenInstances seen_;
    std::optional<ScenePose> between_;
};

/// The field of a frame in which neither world nor camera move: displacement 0, and what lies before the near plane has
/// no valid motion.
/// @param hits  first hits through the pixel centres of the view
MotionField make_still_motion(const CameraView& view, const Image<Hit>& hits);

/// Marks valid pixels whose point is hidden in the other frame as `hidden`. Casts one ray for each. It takes what is
/// first met for a cover where that lies before the point by more than positions and rays are rounded, which is about a
/// millionth of the distance, and more along surfaces that are seen at a grazing angle.
/// @param other_rays  updated to the other frame
/// @return number of rays cast
std::uint64_t mark_hidden(MotionField& field, const Scene& scene, const PosedView& other, const Image<Hit>& hits,
                          const RayScene& other_rays);

}  // namespace aleph
