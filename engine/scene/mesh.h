#pragma once
// Geometry: triangle meshes, and what they are made from or moved by (shapes, point caches, morph targets, skins,
// cages).

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/index.h"
#include "engine/scene/track.h"

namespace aleph {

/// Parameters of a procedural mesh, kept so that the scene is saved as it was authored. Sizes in metres.
struct Shape {
    enum class Kind { quad, box, sphere, cylinder, torus, lathe };
    Kind kind = Kind::quad;
    glm::dvec3 size{1.0};      ///< quad: x, y (it faces +z); box: x, y, z; centred
    double radius = 0.5;       ///< sphere, cylinder; torus: of the circle that the tube follows, about y
    double tube_radius = 0.2;  ///< torus
    double height = 1.0;       ///< cylinder: along y, capped, centred
    int segments = 48;         ///< around; sphere, cylinder, torus, lathe
    /// Lathe: (distance from the y axis, y) along the outline, turned about y. A repeated point is a sharp edge.
    std::vector<glm::dvec2> profile{};
    bool smooth = true;        ///< lathe: the outline is a spline through the points; else straight between them
    glm::dvec2 uv_scale{1.0};  ///< how often a texture repeats

    bool operator==(const Shape&) const = default;
};

/// Animated points as a file stored them, for meshes and cages. Their number never changes.
struct PointCache {
    std::string name;
    TimeSampling sampling;
    std::vector<std::vector<glm::vec3>> positions;  ///< m, object space; at least one sample; linear between them
    int include = no_index;

    std::size_t point_count() const { return positions.empty() ? 0 : positions.front().size(); }
    bool operator==(const PointCache&) const = default;
};

/// Displacements of every vertex of a mesh (glTF). Arrays are empty or as long as Mesh::positions.
struct MorphTarget {
    std::vector<glm::vec3> positions;  ///< m, added
    std::vector<glm::vec3> normals;    ///< added
    bool operator==(const MorphTarget&) const = default;
};

/// Joints that carry the vertices of a mesh (glTF).
struct Skin {
    std::string name;
    std::vector<int> joints;                ///< nodes
    std::vector<glm::dmat4> inverse_binds;  ///< as joints: mesh to joint when bound
    int include = no_index;
    bool operator==(const Skin&) const = default;
};

struct JointWeight {
    std::uint32_t joint = 0;  ///< into Skin::joints
    float weight = 0.0f;
    bool operator==(const JointWeight&) const = default;
};

/// Faces of a cage, counter-clockwise seen from outside.
struct CageFaces {
    std::vector<int> sizes;   ///< vertices of each face, at least 3
    std::vector<int> points;  ///< into the point cache, face by face
    std::vector<int> holes;   ///< faces that are not drawn
    std::vector<int> uv;      ///< into Cage::uv, face by face as `points`; empty where there is none
    std::vector<int> parts;   ///< which part a face belongs to (MeshSubdivision::part); empty: all part 0

    bool operator==(const CageFaces&) const = default;
};

/// Sharp edges of a cage: chains of points.
struct CageCreases {
    std::vector<int> lengths;      ///< of the chains, each at least 2
    std::vector<int> points;       ///< chain by chain
    std::vector<float> sharpness;  ///< one per chain; 10 is infinitely sharp
    bool operator==(const CageCreases&) const = default;
};

/// Sharp points of a cage.
struct CageCorners {
    std::vector<int> points;
    std::vector<float> sharpness;
    bool operator==(const CageCorners&) const = default;
};

/// A subdivision surface's control mesh.
struct Cage {
    enum class Scheme { catmull_clark, loop, bilinear };
    enum class Boundary { none, edge_only, edge_and_corner };  ///< OpenSubdiv's vertex boundary interpolation
    /// OpenSubdiv's face-varying interpolation: how texture coordinates behave at seams.
    enum class UvRule {
        linear_none,
        linear_corners_only,
        linear_corners_plus1,
        linear_corners_plus2,
        linear_boundaries,
        linear_all
    };
    std::string name;
    Scheme scheme = Scheme::catmull_clark;
    Boundary boundary = Boundary::edge_and_corner;
    UvRule uv_rule = UvRule::linear_corners_plus1;
    CageFaces faces;
    CageCreases creases;
    CageCorners corners;
    std::vector<glm::vec2> uv;  ///< face-varying values; v grows downwards
    int points = no_index;      ///< point cache
    int level = 2;              ///< refinement of the meshes made of it
    int max_level = 6;          ///< the level chosen by pixel size is at most this
    int include = no_index;

    bool operator==(const Cage&) const = default;
};

class LimitSurface;  // engine/surface/limit_surface.h

/// Computed from the cage and its level, so comparisons ignore it.
struct LimitSurfaceRef {
    std::shared_ptr<const LimitSurface> surface;
    bool operator==(const LimitSurfaceRef&) const { return true; }
};

/// The mover of a mesh's points: a point cache, or morph targets and then a skin.
struct Deformation {
    int points = no_index;                     ///< point cache
    std::vector<std::uint32_t> vertex_points;  ///< vertex to point of the cache; empty: one to one
    /// Normals of every vertex over time, for a mesh with a point cache; empty: Mesh::normals, or found anew from the
    /// moved triangles where those are not empty.
    TimeSampling normal_sampling;
    std::vector<std::vector<glm::vec3>> normal_samples;

    /// Targets, then a skin. A skinned mesh stands under one node at most, whose own transform does not matter.
    std::vector<MorphTarget> targets;
    std::vector<Track<double>> target_weights;  ///< one per target
    int skin = no_index;
    std::vector<JointWeight> joint_weights;  ///< vertex by vertex, joints_per_vertex each
    int joints_per_vertex = 0;

    bool operator==(const Deformation&) const = default;
};

/// The cage that a mesh is made of.
struct MeshSubdivision {
    int cage = no_index;
    int part = 0;           ///< of the cage: its faces of one material
    LimitSurfaceRef limit;  ///< of the cage at the level of the mesh's triangles

    bool operator==(const MeshSubdivision&) const = default;
};

/// Triangles with one material. Per-vertex arrays are empty or as long as `positions`.
/// Points move by a deformation or with a cage; else the mesh is rigid.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< m, object space; of a deforming mesh: its first sample, or its rest shape
    std::vector<glm::vec3> normals;    ///< empty: flat
    std::vector<glm::vec2> uv[2];      ///< v grows downwards, row 0 of the image at v = 0 (glTF)
    std::vector<glm::vec4> colors;     ///< linear, multiplies the base colour
    std::vector<glm::uvec3> triangles;
    int material = no_index;  ///< no_index: Material{}
    std::optional<Shape> shape;

    Deformation deformation;
    MeshSubdivision subdivision;
    /// 0 where this mesh is not there at all; step. A surface whose topology changes is one mesh for each topology:
    /// there is no motion across the change.
    Track<double> present{1.0};
    int include = no_index;

    bool operator==(const Mesh&) const = default;
};

}  // namespace aleph
