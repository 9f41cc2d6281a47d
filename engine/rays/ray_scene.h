#pragma once
// Rays through a posed scene, in single precision, in metres relative to the anchor (compute_anchor), so that a scene
// far from the origin renders as well as one at it.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/pose/pose.h"
#include "engine/rays/hit.h"
#include "engine/rays/mesh_bounds.h"

namespace aleph {

/// Rays with a component of this size or more are refused, in m or as a direction.
inline constexpr float max_ray_component = 1e9f;

/// Geometry with a coordinate of this size or more is refused, in m or in the object's own space.
inline constexpr float max_coordinate = 1.84e18f;

/// True for an instance that can be traced: its transform keeps volume and is below max_coordinate. One whose points
/// would be beyond it in the world cannot either.
bool is_traceable(const glm::dmat4& world);

/// True for posed points of a deforming mesh that can be traced: finite and below max_coordinate.
bool are_traceable(const std::vector<glm::dvec3>& positions);

struct RayLane;

class RayScene {
  public:
    /// Builds the structures of every rigid mesh; those of deforming meshes are built by the first update. What stands
    /// still is put into one tree (flat_plan.h). No ray meets triangles without area.
    /// @throws InputError for a mesh that cannot be traced; std::bad_alloc, also from Embree
    /// @param plan  make_pose_plan(scene); only read during the call
    RayScene(const Scene& scene, const PosePlan& plan);
    explicit RayScene(const Scene& scene);
    /// A second scene with the same mesh structures; the placement of instances and the deforming meshes are its own.
    RayScene share_meshes() const;
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    /// Places the instances as in a pose of the scene that this was made for. Only those are touched whose transform,
    /// points or visibility changed, all if the anchor moved, so that the cost follows what moves. Instances that are
    /// not traceable (a scale of 0, points that are not finite) are left out.
    /// @return number of instances touched
    /// @throws std::bad_alloc, also from Embree; after that this can only be destroyed
    std::size_t update(const ScenePose& posed, const glm::dvec3& anchor);

    const glm::dvec3& anchor() const;
    /// True where the instance stands still and its triangles are traced in one tree with others, in coordinates
    /// relative to flat_origin (m, world), not to its object's. Rounding of a hit follows that distance.
    bool is_flat(int instance) const;
    const glm::dvec3& flat_origin() const;
    /// Of a mesh of the scene as it is without deformation.
    const MeshBounds& bounds(int mesh) const;
    /// Number of rays traced, and of invalid ones (NaN, infinite, out of range), which count as misses.
    std::uint64_t rays_traced() const;
    std::uint64_t invalid_rays() const;

    struct State;  ///< state.h
    explicit RayScene(std::unique_ptr<State> state);

  private:
    friend class Tracer;
    std::unique_ptr<State> state_;
};

/// The effect of surfaces with AlphaMode::blend on rays. Alpha masks have the same in all three.
enum class Blend {
    cutout,  ///< rays pass where alpha is below .5: no noise, for maps and quick pictures
    /// At each surface a ray passes with probability 1 - alpha, so that pictures are right on average. A ray that has a
    /// number of its own (Ray::choice) shows one of the surfaces in its way by it: the first with a choice below its
    /// alpha a, the second with one below a + (1 - a) b, and so on. Numbers that are even make shares that are even.
    /// For other rays the choice is a hash of the ray's origin and direction, the instance and the triangle: the same
    /// whenever the same ray is cast, alone or in a packet, on any thread, and independent between different rays and
    /// between the surfaces that one ray meets. Rays with equal origin and direction share their choices: vary them per
    /// sample.
    random,
    whole,  ///< rays pass only where alpha is 0: for callers that weigh what is met by alpha
};

/// A surface that a ray meets, and from which it can go on.
struct Met {
    Hit hit{};
    float alpha = 1.0f;      ///< less where the surface is blended
    bool back = false;       ///< the triangle shows its back, in the object's own space
    bool bordering = false;  ///< on the edge of the triangle, so that a neighbour is met as well
};

/// Casts rays. Make one per task: it is cheap, counts locally, and adds its counts to the RayScene when destroyed.
class Tracer {
  public:
    explicit Tracer(const RayScene& scene, Blend blend = Blend::cutout);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// @param normal  if given, set as by the function for packets
    Hit intersect(const Ray& ray, glm::vec3* normal = nullptr);
    bool occluded(const Ray& ray);
    /// With Blend::whole: what a ray meets first, or after the surface that it met last. Of surfaces in one plane none
    /// is left out.
    Met meet(const Ray& ray, const Met* last = nullptr);
    /// Share of the light along a ray that is left: blended surfaces that are not glass leave 1 - alpha, without
    /// chance. All others stop it, or none if `plain_only`.
    float transmittance(const Ray& ray, bool plain_only = false);
    /// The nearest of those others.
    Hit intersect_others(const Ray& ray);
    /// True where a mesh is blended.
    bool has_blended() const;

    /// In packets, one hit per ray; quick where neighbouring rays have similar origins and directions.
    /// @param normals   if given, set to the true normals of what is hit: across the triangle, as long as twice its
    ///                  area, on either side; in the object's space, or the world's where RayScene::is_flat
    void intersect(std::span<const Ray> rays, std::span<Hit> hits, std::span<glm::vec3> normals = {});

  private:
    template <class Use>
    bool trace(const Ray& ray, bool occlusion, RayLane& lane, const Use& set_up);

    RayScene::State& state_;
    Blend blend_;
    std::uint64_t traced_ = 0, invalid_ = 0;
};

}  // namespace aleph
