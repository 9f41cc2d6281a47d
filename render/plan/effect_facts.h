#pragma once
// Facts of a posed scene that decide which effects a frame calls for: boxes, brightness and layers. They are cheap to
// find, and never less than what is there.

#include <algorithm>
#include <vector>

#include "engine/base/bounds.h"
#include "engine/pose/camera_view.h"
#include "engine/pose/plan.h"
#include "render/surface/convex_mesh.h"
#include "render/surface/texture.h"

namespace aleph {

/// The largest values that a material has anywhere.
struct MaterialFacts {
    float diffuse = 0.0f;      ///< albedo of the Lambert layer
    float reflectance = 0.0f;  ///< of the lobes above it, at any angle; 0: there are none
    float least_width = 1.0f;  ///< GGX alpha of the narrowest lobe that has a width
    bool glossy = false;       ///< some lobe has a width
    bool mirror = false;       ///< some lobe has none
    bool glass = false;
    bool volume = false;       ///< the glass encloses one, and refracts
    bool rough_glass = false;  ///< some of it
    bool textured = false, maps_normals = false;
    bool alpha = false;  ///< a mask or blended
    bool unlit = false;
    float radiance = 0.0f;  ///< emitted

    bool scatters() const { return diffuse > 0.0f || glossy || mirror || glass; }
    bool has_specular() const { return glossy || mirror || glass; }
};

/// A mesh in its own space.
struct MeshFacts {
    Bounds bounds;         ///< m
    float color = 1.0f;    ///< largest vertex colour, at least 1
    bool deforms = false;  ///< in different ways at different times
    ConvexMesh shape;
};

/// Facts that do not change over a shot.
struct ShotFacts {
    std::vector<MeshFacts> meshes;
    float environment = 0.0f;  ///< largest value of the environment's picture; 1 without a picture
};

ShotFacts find_shot_facts(const Scene& scene, const TextureSet& textures, const PosePlan& plan);

/// An instance that is there.
struct ObjectFacts {
    int instance = 0, mesh = 0;
    bool deforms = false;  ///< in different ways at different times
    MaterialFacts material;
    Bounds bounds;              ///< world, m
    double lit_radiance = 0.0;  ///< of its Lambert layer, lit by the lights alone, at most
    bool in_view = false;
    bool convex = false;  ///< closed or flat, and no point that is seen of it sees another
    bool flat = false;
    glm::dvec3 point{0.0}, normal{0.0};  ///< world, of the plane of a flat one; the normal is unit
};

struct LightFacts {
    enum class Kind { surface, point, directional, surroundings };
    Kind kind = Kind::surface;
    int object = no_index;      ///< into FrameFacts::objects, of a surface
    int number = 0;             ///< surface: instance; point and directional: into ScenePose::lights
    glm::dvec3 center{0.0};     ///< world, m
    double radius = 0.0;        ///< m, of a sphere around it
    glm::dvec3 direction{0.0};  ///< directional: unit, the way light travels
    double strength = 0.0;      ///< radiance; point: candela; directional: lux
    double range = 0.0;         ///< m; 0: unlimited

    bool has_area() const { return kind == Kind::surface || kind == Kind::surroundings; }
};

/// Facts of one frame.
struct FrameFacts {
    std::vector<ObjectFacts> objects;
    std::vector<LightFacts> lights;
    /// Mirrors, glass or glossy surfaces are in view, so anything may be seen.
    bool sees_all = false;

    bool is_seen(const ObjectFacts& object) const { return sees_all || object.in_view; }
    /// @param layer  a member of MaterialFacts
    bool any(auto layer) const { return std::ranges::any_of(objects, layer, &ObjectFacts::material); }
};

/// @param all_in_view  the view is not known well enough to leave objects out: a lens, or an open shutter
FrameFacts find_frame_facts(const Scene& scene, const ShotFacts& shot, const TextureSet& textures,
                            const ScenePose& pose, const CameraView& view, bool all_in_view);

}  // namespace aleph
