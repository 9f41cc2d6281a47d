#pragma once
// Rays on their way through Embree's trees. Embree calls back for every block of triangles, and for every object, whose
// box a ray may meet. Internal to engine/rays.

#include <embree3/rtcore.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "engine/rays/ray_scene.h"
#include "engine/rays/triangle_tree.h"

namespace aleph {

/// A triangle that a ray meets.
struct Crossing {
    double distance;
    float u, v;
    int instance;
    unsigned primitive;
    bool back;         ///< the triangle shows its back, in the object's own space
    bool bordering;    ///< BlockHits
    glm::vec3 normal;  ///< across the triangle, as long as twice its area, in the tree's space
    float alpha;       ///< Met::alpha
};

/// The nearest triangle that a ray meets. At about one distance the lowest (instance, primitive) counts, so that of two
/// surfaces in one plane the same is seen everywhere. Within an instance, triangles that face the ray come before those
/// that show their back: from afar both sides of a thin wall are at one distance, and the near one must be met.
/// The result does not depend on the order in which triangles are offered.
class Nearest {
  public:
    /// Distances this near each other, relatively, count as equal: some roundings of a single-precision corner.
    static constexpr double tie = 0x1p-19;

    bool empty() const { return count_ == 0; }
    /// Triangles beyond can no longer be the result.
    double limit() const { return nearest_ * (1.0 + tie); }
    void offer(const Crossing& crossing) {
        if (crossing.distance * (1.0 + tie) < nearest_) {  // as a rule what was met before lies clearly farther
            nearest_ = crossing.distance;
            kept_[0] = crossing;
            count_ = 1;
        } else {
            offer_tie(crossing);
        }
    }
    void clear() {
        nearest_ = std::numeric_limits<double>::infinity();
        count_ = 0;
        more_.reset();
    }
    /// Not if empty.
    const Crossing& result() const { return more_ == nullptr ? kept_[count_ - 1] : find_result(); }

  private:
    void offer_tie(const Crossing& crossing);
    const Crossing& find_result() const;

    static constexpr int capacity = 4;
    double nearest_ = std::numeric_limits<double>::infinity();
    int count_ = 0;
    /// From near to far, each before its predecessor in the order above: all others can never be the result.
    Crossing kept_[capacity];
    std::unique_ptr<std::vector<Crossing>> more_;  ///< found no room there; in no order. Null: none
};

/// Where a ray enters a tree: Embree's distance = (distance - start) * unit.
struct Entry {
    double start = 0.0;
    double unit = 1.0;  ///< a power of two: Embree's direction is that of the ray, divided by it
};

/// A ray while it is traced. Positions are relative to the anchor, distances in lengths of the direction.
struct RayLane {
    const Ray* given = nullptr;
    glm::dvec3 origin, direction;
    double near, far;
    Nearest nearest;
    bool blocked = false;
    /// Light that plain blended surfaces take, in 2^-24 halvings: the sum of whole numbers has no order.
    std::int64_t attenuation = 0;

    Entry entry;         ///< of the tree of objects
    Entry object_entry;  ///< of the tree of triangles
    ShearedRay local;    ///< in that tree's coordinates, from the start of object_entry

    /// @param ray  valid; stays
    void set(const Ray& ray);
    double limit() const { return std::min(far, nearest.limit()); }
};

/// Moves the start of a ray near to a tree, so that single precision is enough for Embree.
/// @return false: it passes by
bool enter_tree(const TreeExtent& extent, const glm::dvec3& origin, const glm::dvec3& direction, const RayLane& lane,
                Entry& entry, glm::dvec3& start);
/// A ray for Embree, which only has to meet the right boxes.
void set_embree_ray(const glm::dvec3& start, const glm::dvec3& direction, const RayLane& lane, const Entry& entry,
                    RTCRay& ray);
/// Distance for Embree's boxes: a little more than the true one.
float embree_far(const RayLane& lane, const Entry& entry);

/// Embree passes its context to the callbacks; this is what they find in it.
struct Traversal {
    RTCIntersectContext embree;  ///< first
    RayLane* lanes;              ///< as many as the packet has
    const RayScene::State* state;
    int first_instance = 0;  ///< added to the part's
    Blend blend;
    bool occlusion = false;
    bool attenuates = false;  ///< plain blended surfaces (AlphaCutout) stop no ray but take their share of its light
    bool plain_only = false;  ///< the others stop none
    const Crossing* passed = nullptr;  ///< only what comes after it is met; null: everything is

    Traversal(const RayScene::State& of, RayLane* rays, Blend blended, bool any_hit);
    /// One of its rays.
    Traversal(const Traversal& outer, RayLane& lane);
};

/// Returns whether a ray that goes on from `passed` meets `next`: beyond it, or at about its distance, but later in the
/// order of Nearest. At an edge it does not meet the same sheet again.
bool is_beyond(const Crossing& passed, const Crossing& next);

/// Traces the traversal's only ray through one of Embree's trees.
void trace_single(RTCScene scene, const glm::dvec3& start, const glm::dvec3& direction, const Entry& entry,
                  Traversal& traversal);

/// Traces the traversal's only ray through a tree of triangles.
/// @param origin, direction  in the tree's coordinates
void trace_triangles(const TriangleTree& tree, const glm::dvec3& origin, const glm::dvec3& direction,
                     Traversal& traversal);

/// Embree's callbacks of TriangleTree.
void intersect_blocks(const RTCIntersectFunctionNArguments* arguments);
void occlude_blocks(const RTCOccludedFunctionNArguments* arguments);

}  // namespace aleph
