#pragma once
// The state of a RayScene. Internal to engine/rays: Embree's handles are not used outside it.

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "engine/rays/embree_device.h"
#include "engine/rays/flat_plan.h"
#include "engine/rays/object_layer.h"
#include "engine/rays/ray_scene.h"
#include "engine/rays/refit.h"
#include "engine/rays/triangle_tree.h"

namespace aleph {

/// One tree of what stands still.
struct FlatTree {
    std::unique_ptr<TriangleTree> tree;   ///< null: nothing is flat
    std::vector<std::uint8_t> instances;  ///< per instance: in the tree
    glm::dvec3 origin{0.0};               ///< m, world: the tree's coordinates are relative to it
    std::size_t count = 0;                ///< instances in it
};

/// Embree's structures of every mesh, built once and shared by the RayScenes of neighbouring frames, and which
/// instances they belong to. What stands still is in one flat tree (FlatPlan); other meshes are in object space.
struct MeshStructures {
    /// Meshes of one node that are placed together.
    struct Object {
        int node;            ///< scene node that carries these meshes
        int first_instance;  ///< ScenePose::instances index of the node's first mesh; TreePart::instance is added
        int instance;        ///< of those, the one that says whether the object is shown
        const TriangleTree* tree = nullptr;  ///< null: deforming, each RayScene has its own
        int deforming = no_index;            ///< into `deforming`
    };

    /// @param flatten  false: every node has its own tree, for comparison
    /// @throws InputError: a mesh that cannot be traced; what EmbreeDevice throws
    MeshStructures(const Scene& scene, const PosePlan& plan,
                   std::unique_ptr<EmbreeDevice> device = std::make_unique<EmbreeDevice>(), bool flatten = true);
    MeshStructures(const MeshStructures&) = delete;
    MeshStructures& operator=(const MeshStructures&) = delete;

    std::unique_ptr<EmbreeDevice> device;
    int packet_width = 1;  ///< 16, 8, or 1: the widest packets that the processor traces as such
    std::vector<std::unique_ptr<const AlphaCutout>> cutouts;  ///< as Scene::meshes; null: no holes
    std::vector<MeshBounds> bounds;                           ///< as Scene::meshes
    std::vector<std::unique_ptr<TriangleTree>> trees;
    FlatTree flat;
    /// First what can move, deform, come or go, then what never does; in the order of the scene within both.
    std::vector<Object> objects;
    std::size_t moving_count = 0;
    /// How many of them share the first top-level scene: the moving ones, or all where there are few.
    std::size_t first_layer_count = 0;
    std::vector<DeformingMesh> deforming;
    bool any_cutout = false;
    bool any_blended = false;  ///< of the cutouts
    bool any_plain = false;
};

struct RayScene::State {
    explicit State(std::shared_ptr<const MeshStructures> shared);

    std::shared_ptr<const MeshStructures> meshes;
    std::vector<std::unique_ptr<RefitMesh>> refits;  ///< as MeshStructures::deforming
    /// Where many objects stand still they have a tree of their own, so that it is not built again for each that moves.
    std::unique_ptr<ObjectLayer> moving, still;
    std::array<const ObjectLayer*, 2> layers() const { return {still.get(), moving.get()}; }
    std::vector<float> alpha;  ///< per material, now; empty where no mesh has an alpha mask
    glm::dvec3 anchor{0.0};
    glm::dvec3 flat_shift{0.0};  ///< m: to be added to the origins of rays for the flat tree
    bool placed = false;         ///< by an update
    std::atomic<std::uint64_t> rays_traced{0}, invalid_rays{0};
};

}  // namespace aleph
