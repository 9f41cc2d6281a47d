#pragma once
// Spans of time in which nothing changes that a camera shows.

#include <vector>

#include "engine/pose/plan.h"

namespace aleph {

/// Compares the keys of tracks, not poses, so that a change between two frames is found too. It errs on the safe side:
/// tracks whose changes cancel, or are hidden, count as changes.
class SteadySpans {
  public:
    /// Keeps a reference to the scene.
    /// @param plan  make_pose_plan(scene)
    SteadySpans(const Scene& scene, const PosePlan& plan);

    /// True where the scene has the same pose, bit for bit, at all times of a span with its ends. Other cameras do not
    /// count.
    /// @param camera    index into ScenePose::cameras
    /// @param from, to  s; from <= to
    bool is_steady(int camera, double from, double to) const;

    /// The same without any camera.
    bool is_world_steady(double from, double to) const;

    /// True where that holds for all times, whichever camera looks.
    bool is_always_steady() const { return !changes_; }

  private:
    struct CameraTracks {
        int camera = no_index;   ///< into Scene::cameras
        std::vector<int> nodes;  ///< its own and those above it, if they move
    };

    const Scene& scene_;
    // The parts that can change: indices into the scene's lists.
    std::vector<int> nodes_;   ///< with a mesh, a light or a joint at or below them
    std::vector<int> meshes_;  ///< under some node
    std::vector<int> point_caches_, materials_, lights_;
    std::vector<CameraTracks> cameras_;
    bool changes_ = false;  ///< something does, cameras included
};

/// Times of keys within a span, without its ends, s, in order: of everything but the points of meshes. Where there are
/// more than 256, an even choice of them.
std::vector<double> find_key_times(const Scene& scene, double from, double to);

}  // namespace aleph
