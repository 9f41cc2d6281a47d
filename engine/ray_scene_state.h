#pragma once
// What RayScene keeps, shared with Tracer only: Embree's handles do not leave these two files.

#include <embree3/rtcore.h>

#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "engine/ray_scene.h"

namespace aleph {

/// Embree's structures of every mesh in object space, built once and shared by the RayScenes of neighbouring frames.
struct MeshStructures {
    struct Object {
        int node;            ///< scene node that carries these meshes
        int first_instance;  ///< SceneFrame::instances index of its first mesh
        RTCScene mesh_scene;
    };

    explicit MeshStructures(const Scene& scene);
    ~MeshStructures();
    MeshStructures(const MeshStructures&) = delete;
    MeshStructures& operator=(const MeshStructures&) = delete;

    RTCDevice device = nullptr;
    int packet_width = 8;
    std::vector<RTCScene> mesh_scenes;
    std::vector<Object> objects;
    std::size_t degenerate_triangles = 0;
};

/// One object's place in the top-level scene.
struct Placement {
    RTCGeometry geometry = nullptr;
    bool enabled = false;
    std::array<float, 12> transform{};
};

struct RayScene::State {
    explicit State(std::shared_ptr<const MeshStructures> shared);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    std::shared_ptr<const MeshStructures> meshes;
    RTCScene top = nullptr;
    std::vector<Placement> placements;  ///< as MeshStructures::objects
    glm::dvec3 anchor{0.0};
    std::size_t skipped_instances = 0;
    std::atomic<std::uint64_t> rays_traced{0}, invalid_rays{0};
};

}  // namespace aleph
