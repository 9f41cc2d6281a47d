#include "engine/rays/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <new>

#include "engine/rays/traversal.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

/// A triangle, before it is in a block.
struct TriangleName {
    std::uint32_t mesh, primitive;
};

/// Nodes of the tree that groups neighbouring triangles: the same that Embree would make of single triangles, with up
/// to four in a leaf.
struct Node {
    Node* children[2] = {nullptr, nullptr};
    unsigned count = 0;  ///< of triangles; 0: has children
    unsigned triangles[TriangleBlock::size]{};
};

/// Embree turns the exception into an error of the device.
Node* allocate_node(RTCThreadLocalAllocator allocator) {
    void* const memory = rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node));
    if (memory == nullptr) throw std::bad_alloc();
    return new (memory) Node;
}

void* make_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return allocate_node(allocator);
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->children[i] = static_cast<Node*>(children[i]);
}

void set_bounds(void*, const RTCBounds**, unsigned, void*) {}

void* make_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* triangles, std::size_t count, void*) {
    Node* const leaf = allocate_node(allocator);
    leaf->count = static_cast<unsigned>(count);
    for (std::size_t i = 0; i < count; ++i) leaf->triangles[i] = triangles[i].primID;
    return leaf;
}

RTCBuildPrimitive make_primitive(const TreeMesh& mesh, std::uint32_t triangle, std::size_t index) {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 &a = mesh.points[t.x], &b = mesh.points[t.y], &c = mesh.points[t.z];
    const glm::vec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    return {low.x, low.y, low.z, 0, high.x, high.y, high.z, static_cast<unsigned>(index)};
}

void set_corners(TriangleBlock& block, int place, const TreeMesh& mesh) {
    const glm::uvec3& t = mesh.triangles[block.primitive[place]];
    for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis) block.corners[k][axis][place] = mesh.points[t[k]][axis];
}

TriangleBlock make_block(const Node& leaf, const std::vector<TriangleName>& names, std::span<const TreeMesh> meshes) {
    TriangleBlock block;
    for (int i = 0; i < TriangleBlock::size; ++i) {
        if (i < static_cast<int>(leaf.count)) {
            const TriangleName& name = names[leaf.triangles[i]];
            block.primitive[i] = name.primitive;
            block.part[i] = name.mesh;
            set_corners(block, i, meshes[name.mesh]);
        } else {
            block.primitive[i] = block.part[i] = std::numeric_limits<std::uint32_t>::max();
            for (auto& corner : block.corners)
                for (auto& axis : corner) axis[i] = std::numeric_limits<float>::quiet_NaN();
        }
    }
    return block;
}

/// Blocks of neighbours.
std::vector<TriangleBlock> make_blocks(const EmbreeDevice& device, std::span<const TreeMesh> meshes) {
    std::vector<TriangleName> names;
    std::vector<RTCBuildPrimitive> primitives;
    for (std::uint32_t m = 0; m < meshes.size(); ++m) {
        for (std::uint32_t t = 0; t < meshes[m].triangles.size(); ++t) {
            primitives.push_back(make_primitive(meshes[m], t, names.size()));
            names.push_back({m, t});
        }
    }
    std::vector<TriangleBlock> blocks;
    if (names.empty()) return blocks;
    const EmbreeBvh bvh = device.make_bvh();
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.byteSize = sizeof(arguments);
    arguments.maxDepth = 1024;
    arguments.maxLeafSize = TriangleBlock::size;
    arguments.traversalCost = 4.0f;  // four triangles cost little more than one
    arguments.bvh = bvh.get();
    arguments.primitives = primitives.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = make_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = make_leaf;
    std::vector<const Node*> waiting{static_cast<const Node*>(rtcBuildBVH(&arguments))};
    device.check();
    while (!waiting.empty()) {
        const Node* const node = waiting.back();
        waiting.pop_back();
        if (node->count > 0) {
            blocks.push_back(make_block(*node, names, meshes));
            continue;
        }
        for (const Node* child : node->children)
            if (child != nullptr) waiting.push_back(child);
    }
    return blocks;
}

Bounds measure_block(const TriangleBlock& block) {
    Bounds bounds;
    for (int i = 0; i < TriangleBlock::size; ++i)
        for (int k = 0; k < 3 && block.corners[0][0][i] == block.corners[0][0][i]; ++k) bounds.add(block.corner(i, k));
    return bounds;
}

void write_block_bounds(const RTCBoundsFunctionArguments* arguments) {
    const TriangleTree& tree = *static_cast<const TriangleTree*>(arguments->geometryUserPtr);
    const Bounds bounds = measure_block(tree.block(arguments->primID));
    *arguments->bounds_o = tree.extent().enlarge(bounds.low, bounds.high);
}

}  // namespace

// Embree's boxes are tested by t = corner * (1 / d) - origin * (1 / d), which is off by less than 2^-21 of |corner| +
// |origin| (in lengths of the axis), and rays are rounded to 2^-24 of |origin|.
TreeExtent::TreeExtent(const Bounds& bounds) {
    if (bounds.empty()) return;
    center = 0.5 * bounds.low + 0.5 * bounds.high;
    // A single point has no size of its own.
    radius = std::max(glm::length(bounds.high - center), std::numeric_limits<float>::min() * 1e10);
    const double farthest = largest_element(center) + reach();
    margin = 0x1p-19 * farthest;
}

RTCBounds TreeExtent::enlarge(const glm::dvec3& low, const glm::dvec3& high) const {
    const glm::vec3 l(low - 2.0 * margin), h(high + 2.0 * margin);  // twice: these are rounded, too
    return {l.x, l.y, l.z, 0.0f, h.x, h.y, h.z, 0.0f};
}

TriangleTree::TriangleTree(const EmbreeDevice& device, std::span<const TreeMesh> meshes, Kind kind)
    : device_(device), blocks_(make_blocks(device, meshes)) {
    for (const TreeMesh& mesh : meshes) parts_.push_back(mesh.part);
    measure();
    // Embree refits only in scenes that it calls dynamic.
    const bool still = kind == Kind::still;
    scene_ = device.make_scene(still ? RTC_SCENE_FLAG_NONE : RTC_SCENE_FLAG_DYNAMIC,
                               still ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_LOW);
    geometry_ = device.make_geometry();
    rtcSetGeometryBuildQuality(geometry_.get(), still ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_REFIT);
    rtcSetGeometryUserPrimitiveCount(geometry_.get(), static_cast<unsigned>(blocks_.size()));
    rtcSetGeometryUserData(geometry_.get(), this);
    rtcSetGeometryBoundsFunction(geometry_.get(), write_block_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry_.get(), intersect_blocks);
    rtcSetGeometryOccludedFunction(geometry_.get(), occlude_blocks);
    rtcAttachGeometryByID(scene_.get(), geometry_.get(), 0);
    commit();
}

void TriangleTree::measure() {
    bounds_ = {};
    for (const TriangleBlock& block : blocks_) {
        const Bounds bounds = measure_block(block);
        bounds_.add(bounds.low);
        bounds_.add(bounds.high);
    }
    extent_ = TreeExtent(bounds_);
}

void TriangleTree::commit() {
    rtcCommitGeometry(geometry_.get());
    rtcCommitScene(scene_.get());
    device_.check();
}

void TriangleTree::move(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles) {
    const TreeMesh mesh{{}, points, triangles};
    for (TriangleBlock& block : blocks_)
        for (int i = 0; i < TriangleBlock::size; ++i)
            if (block.primitive[i] < triangles.size()) set_corners(block, i, mesh);
    measure();
    commit();
}

}  // namespace aleph
