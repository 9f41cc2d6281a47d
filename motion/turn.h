#pragma once
// How far things turn against the camera within a span of time, read from their tracks: the poses at both ends cannot
// tell a full turn from rest.

#include <cstdint>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Finds the turns of a scene's nodes. Looks at the nodes that can move only, so that the cost follows their number.
class TurnFinder {
  public:
    /// @param plan  make_pose_plan(scene). Both must outlive this.
    TurnFinder(const Scene& scene, const PosePlan& plan);

    /// Finds the turns within a span of time; of_node() and background() give them.
    /// @param camera_node  no_index: a camera that stands still
    /// @param begin, end   s, in either order
    void find(int camera_node, double begin, double end);

    /// Turn of a node against the camera, radians, summed along the keys and the hierarchy: not less than the angle
    /// between the poses at both ends. What camera and node inherit alike does not count. A node with a skinned mesh
    /// turns as far as the joint that turns most.
    double of_node(int node) const;
    /// Turn of the camera against the environment's picture, radians.
    double background() const { return background_; }

    /// Times evenly between `begin` and `end`, in that direction, so many that from one to the next nothing that has a
    /// mesh, nor the background, turns by more than `max_turn` (radians). Empty where nothing turns further anyway. At
    /// most 511: a spin beyond 512 times `max_turn` gets longer steps. Leaves the turns of its last step behind.
    std::vector<double> subdivide(int camera_node, double begin, double end, double max_turn);

  private:
    double turn_against_camera(int node) const;
    double largest() const;

    const Scene& scene_;
    const PosePlan& plan_;
    std::vector<int> with_mesh_;  ///< nodes whose turn can differ from that of the world and that carry a mesh
    std::vector<int> skinned_;    ///< of those, the ones with a skinned mesh
    double camera_ = 0.0;         ///< turn of the camera against the world, radians
    double background_ = 0.0;
    // Per node, radians; 0 for nodes that cannot move. Along the way from the root: the whole turn, and the part of it
    // that the camera shares.
    std::vector<double> total_, shared_;
    std::vector<double> joints_;  ///< per node: the largest turn of its skins' joints
    std::vector<std::uint8_t> carries_camera_;
};

}  // namespace aleph
