#pragma once
// Rays through a posed scene. RayScene owns Embree's structures; a Tracer is one thread's door to them.
// Everything here is single precision, in metres relative to the anchor (camera_view.h), so that a scene far from the
// origin renders as well as one at it.

#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/pose/pose.h"

namespace aleph {

struct Ray {
    glm::vec3 origin{0.0f};     ///< m, relative to the anchor
    glm::vec3 direction{0.0f};  ///< need not be unit; distances are in its length
    float near = 0.0f;
    float far = std::numeric_limits<float>::infinity();
};

/// What a ray met. instance is an index into ScenePose::instances, primitive a triangle of its mesh;
/// the point is (1 - u - v) p0 + u p1 + v p2.
struct Hit {
    int instance = no_index;  ///< no_index: nothing
    int primitive = no_index;
    float u = 0.0f, v = 0.0f;
    float distance = 0.0f;  ///< in lengths of the ray's direction

    bool operator==(const Hit&) const = default;
};

/// Rays with a component of this size or more are refused, in m or as a direction.
inline constexpr float largest_ray_component = 1e9f;

/// Whether rays can meet an instance at all: its transform keeps volume, and every ray that is let through stays within
/// what Embree takes in the object's own space (else it ends the process; HARD_CASES RC-01, RC-02).
bool is_traceable(const glm::dmat4& world, const glm::dvec3& anchor);

class RayScene {
  public:
    /// Builds the structures of every rigid mesh once; deforming ones follow at the first update. Degenerate triangles
    /// are left out and counted.
    /// @param plan  make_pose_plan(scene); only read during the call
    RayScene(const Scene& scene, const PosePlan& plan);
    explicit RayScene(const Scene& scene);
    /// Another one over the same mesh structures: only the placement of instances and the deforming meshes are its own.
    RayScene share_meshes() const;
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// Places the instances for a frame: only those whose transform, points or visibility changed are touched (all when
    /// the anchor moved). Instances that are not traceable (a scale of 0, points that are not finite) are left out and
    /// counted.
    /// @return how many instances were touched
    std::size_t update(const ScenePose& frame, const glm::dvec3& anchor);

    /// The same for a frame of the very scene that this was made for, where the last update had one too: what cannot
    /// move by its tracks is not even looked at, so that it costs what moves (everything where the anchor moved).
    std::size_t update_moving(const ScenePose& frame, const glm::dvec3& anchor);

    const glm::dvec3& anchor() const;
    std::size_t degenerate_triangles() const;
    std::size_t skipped_instances() const;
    /// Rays that the checked wrapper passed on, and those it refused (NaN, infinite, out of range: a miss).
    std::uint64_t rays_traced() const;
    std::uint64_t invalid_rays() const;

    struct State;  ///< state.h
    explicit RayScene(std::unique_ptr<State> state);

  private:
    friend class Tracer;
    std::unique_ptr<State> state_;
};

/// Casts rays. Make one per task: it is cheap, counts locally and reports to the RayScene when it goes.
class Tracer {
  public:
    explicit Tracer(const RayScene& scene);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    Hit intersect(const Ray& ray);
    bool occluded(const Ray& ray);

    /// As many rays as there are hits, in packets; say coherent where neighbours start and point alike.
    void intersect(std::span<const Ray> rays, std::span<Hit> hits, bool coherent);
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked);

  private:
    RayScene::State& state_;
    std::uint64_t traced_ = 0, invalid_ = 0;
};

}  // namespace aleph
