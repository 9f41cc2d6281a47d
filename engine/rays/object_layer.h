#pragma once
// A tree of objects, each with a tree of triangles in coordinates of its own and a place in the world. Internal to
// engine/rays.

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/rays/triangle_tree.h"

namespace aleph {

struct PlacedTree {
    const TriangleTree* tree = nullptr;
    int first_instance = 0;  ///< TreePart::instance is added

    bool operator==(const PlacedTree&) const = default;
};

/// One object's place.
struct Placement {
    PlacedTree object;
    glm::dmat4 world{1.0};  ///< object to world
    glm::dmat3 to_tree{1.0};
    glm::dvec3 place{0.0};  ///< of the object's origin, m, relative to the anchor
    Bounds bounds;          ///< m, relative to the anchor
    bool enabled = false;
};

struct ObjectState {
    bool shown = true;     ///< false: rays do not meet it
    bool changed = false;  ///< its triangles have
};

class ObjectLayer {
  public:
    /// @param device  must outlive this
    ObjectLayer(const EmbreeDevice& device, std::size_t count);
    ObjectLayer(const ObjectLayer&) = delete;
    ObjectLayer& operator=(const ObjectLayer&) = delete;

    std::size_t size() const { return placements_.size(); }
    std::size_t enabled() const { return enabled_; }
    const TreeExtent& extent() const { return extent_; }
    const Placement& placement(unsigned index) const { return placements_[index]; }
    RTCScene scene() const { return scene_.get(); }

    /// Places an object, or hides it.
    /// @return whether anything changed; commit() then has to follow
    bool place(std::size_t index, const PlacedTree& object, const glm::dmat4& world, const glm::dvec3& anchor,
               const ObjectState& state);
    void commit();

  private:
    const EmbreeDevice& device_;
    std::vector<Placement> placements_;
    std::size_t enabled_ = 0;
    TreeExtent extent_;
    EmbreeGeometry geometry_;
    EmbreeScene scene_;
};

}  // namespace aleph
