#pragma once
// Triangles in blocks, and Embree's tree of the blocks. Internal to engine/rays.

#include <embree3/rtcore.h>

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/base/bounds.h"
#include "engine/rays/alpha_cutout.h"
#include "engine/rays/embree_device.h"
#include "engine/rays/triangle_block.h"

namespace aleph {

/// A tree over boxes that are a little larger than what they hold. Embree's rounding moves a ray by less than the boxes
/// are enlarged, as long as the ray starts no farther than `reach` from `center` (enter_tree).
struct TreeExtent {
    glm::dvec3 center{0.0};
    double radius = 0.0;  ///< of a sphere about everything in the tree
    double margin = 0.0;  ///< added to the boxes on all sides

    TreeExtent() = default;
    explicit TreeExtent(const Bounds& bounds);
    double reach() const { return 4.0 * radius; }
    /// For Embree.
    RTCBounds enlarge(const glm::dvec3& low, const glm::dvec3& high) const;
};

/// One mesh of a tree.
struct TreePart {
    int instance = 0;                     ///< added to that of the object which is placed
    bool mirrored = false;                ///< its triangles show the other side
    const AlphaCutout* cutout = nullptr;  ///< null: no holes
};

/// A mesh to be put into a tree.
struct TreeMesh {
    TreePart part;
    std::span<const glm::vec3> points;
    std::span<const glm::uvec3> triangles;
};

class TriangleTree {
  public:
    enum class Kind { still, refitted };
    /// @param device  must outlive this
    TriangleTree(const EmbreeDevice& device, std::span<const TreeMesh> meshes, Kind kind);
    TriangleTree(const TriangleTree&) = delete;
    TriangleTree& operator=(const TriangleTree&) = delete;

    /// Moves the points of a tree of one mesh, and refits the boxes.
    void move(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles);

    RTCScene scene() const { return scene_.get(); }
    const TreeExtent& extent() const { return extent_; }
    const Bounds& bounds() const { return bounds_; }
    const TriangleBlock& block(unsigned index) const { return blocks_[index]; }
    const TreePart& part(std::uint32_t index) const { return parts_[index]; }

  private:
    void measure();
    void commit();

    const EmbreeDevice& device_;
    std::vector<TreePart> parts_;
    std::vector<TriangleBlock> blocks_;
    Bounds bounds_;
    TreeExtent extent_;
    EmbreeGeometry geometry_;
    EmbreeScene scene_;
};

}  // namespace aleph
