#pragma once
// A posed scene made ready for shading: single precision, relative to the anchor, one entry per instance.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/rays/ray_scene.h"
#include "render/settings/effects.h"

namespace aleph {

struct EnvironmentMap;
struct TextureSet;

inline glm::mat3 abs_of(const glm::mat3& m) {
    return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

struct PosedInstance {
    const Mesh* mesh = nullptr;
    int material = no_index;      ///< into ShadingScene::materials; the default material is its last entry
    glm::mat3 linear{1.0f};       ///< object to world
    glm::vec3 translation{0.0f};  ///< m, relative to the anchor
    glm::mat3 normals{1.0f};      ///< object to world for normals (cofactors), not normalised; outwards
    glm::mat3 rounding{1.0f};  ///< |linear| |linear^-1|: growth of a rounding error on the way to object space and back
    /// m, relative to the anchor: of the coordinates in which rays meet it, where they are those of the flat tree.
    glm::vec3 flat_origin{0.0f};
    bool flat = false;
    bool visible = false;
    const MeshBounds* bounds = nullptr;   ///< of the mesh without deformation
    const PosedMesh* deformed = nullptr;  ///< in place of the mesh's own points and normals; null: rigid

    /// Object space, m: the position that rays meet.
    glm::vec3 corner(std::uint32_t vertex) const {
        return deformed == nullptr ? mesh->positions[vertex] : glm::vec3(deformed->positions[vertex]);
    }
    /// m, relative to the anchor.
    glm::vec3 place(std::uint32_t vertex) const { return linear * corner(vertex) + translation; }
    const std::vector<glm::vec3>& vertex_normals() const {
        return deformed == nullptr ? mesh->normals : deformed->normals;
    }
};

/// The values of a material at this time, without its textures.
struct ShadingMaterial {
    MaterialValues values;
    const Material* material = nullptr;  ///< null: glTF's default
    bool double_sided = false;
    bool emits = false;
    bool layered = false;        ///< has a coat, sheen or anisotropy
    bool plain_lambert = false;  ///< scatters by its Lambert layer alone, and no map changes its normals
};

/// Bounds of the visible instances, m, relative to the anchor.
struct VisibleBounds {
    BoundingBox all;
    std::optional<BoundingBox> still;  ///< of those that updates do not change; set by the first update
};

struct ShadingEnvironment {
    Rgb radiance{0.0f};                   ///< all around, or factor on `map`
    const EnvironmentMap* map = nullptr;  ///< null: none
    glm::mat3 rotation{1.0f};             ///< of `map`, to the world
};

struct ShadingScene {
    const Scene* scene = nullptr;
    const ScenePose* pose = nullptr;
    const TextureSet* textures = nullptr;
    glm::dvec3 anchor{0.0};
    std::vector<PosedInstance> instances;  ///< as ScenePose::instances
    std::vector<ShadingMaterial> materials;
    ShadingEnvironment environment;
    bool has_thin_glass = false;  ///< some material may pass light straight: shadows depend on it
    bool has_volumes = false;     ///< some glass encloses a volume
    std::vector<int> emitting;    ///< instances whose material emits at some time
    VisibleBounds bounds;
    EffectSet skipped;               ///< left out of shading
    float caustic_width = 0.0f;      ///< find_caustic_width
    bool points_unshadowed = false;  ///< nothing stands before lights without area

    /// @param pdf  LightSample::pdf
    bool needs_shadow_ray(float pdf) const {
        return pdf > 0.0f ? !skipped.contains(Effect::area_shadows) : !points_unshadowed;
    }
};

/// Keeps pointers to scene, pose, textures and bounds of the rays' meshes, which must outlive it.
/// @param rays  of the scene, updated to the pose: gives the anchor, and which instances are flat
ShadingScene make_shading_scene(const Scene& scene, const ScenePose& pose, const RayScene& rays,
                                const TextureSet& textures);

/// Updates it after update_pose(plan) changed *shading.pose. The result equals that of make_shading_scene, but only the
/// instances and materials that the plan names are computed again; if the anchor moved, everything is.
void update_shading_scene(ShadingScene& shading, const PosePlan& plan, const RayScene& rays);

/// Of a visible instance, m, relative to the anchor. Of one that is rigid they follow from those of its mesh: box and
/// sphere may be larger, the area smaller, than those of its triangles.
MeshBounds find_bounds(const PosedInstance& instance);

/// Radiance that a ray meets which hits nothing.
/// @param direction  unit, world
Rgb environment_radiance(const ShadingScene& shading, const glm::vec3& direction);

/// Where a surface is and how it faces, seen from a direction.
struct SurfacePlace {
    /// m, relative to the anchor. Computed from barycentrics: at grazing incidence, origin + t direction can be metres
    /// off.
    glm::vec3 position{0.0f};
    glm::vec3 geometric{0.0f};  ///< unit, towards the viewer
    glm::vec3 normal{0.0f};     ///< shading normal, unit, never facing away from the viewer's side of `geometric`
    float offset = 0.0f;        ///< m along `geometric`, larger than the rounding error of `position`
    bool front = true;          ///< seen from the front side of its winding

    /// Origin of rays that leave on the viewer's side.
    glm::vec3 ray_origin() const { return position + geometric * offset; }
};

/// A point of a surface, with what textures need.
struct SurfacePoint : SurfacePlace {
    glm::vec2 uv[2]{};
    glm::vec3 edges[2]{};        ///< m, of the triangle, from its first corner
    glm::vec2 uv_edges[2][2]{};  ///< per set of texture coordinates: its difference along each edge
    glm::vec4 color{1.0f};       ///< vertex colour
    int material = no_index;
};

/// @param direction  of the ray that hit it; need not be unit
SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction);

/// The place alone.
SurfacePlace make_surface_place(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction);

/// The same point in another pose of the scene: light that was computed there belongs to it. Its place on the triangle
/// and its side are the same. Its shading normal turns with the triangle, so that normal maps and bent normals keep
/// their effect.
/// @param from  make_surface_point of the hit in the pose where it was found, perhaps with another shading normal
/// @return nothing if the surface is hidden in the pose `to`
std::optional<SurfacePoint> carry_point(const ShadingScene& to, const Hit& hit, const SurfacePoint& from);

}  // namespace aleph
