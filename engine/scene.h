#pragma once
// The animated scene: plain data, elements refer to each other by index, every property is a track over time.
// Every reader fills this one structure; pose() (pose.h) says what it looks like at a moment.
// Right-handed, y up, metres, seconds; angles in radians; colours linear Rec.709; light units unscaled (candela, lux,
// nits).

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/viewing.h"
#include "engine/track.h"

namespace aleph {

inline constexpr int no_index = -1;

/// Frames per second as a fraction, so that frame n lies at exactly n * denominator / numerator seconds.
struct FrameRate {
    std::int64_t numerator = 30;
    std::int64_t denominator = 1;

    double per_second() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
    /// s; the frame number is the state and time is derived, never accumulated (HARD_CASES KF-14 to KF-16).
    double seconds_of(std::int64_t frame) const {
        return static_cast<double>(frame) * static_cast<double>(denominator) / static_cast<double>(numerator);
    }
    bool operator==(const FrameRate&) const = default;
};

/// Rotation about a fixed axis whose angle interpolates as a number, so that a spin beyond 180 degrees works.
struct AxisRotation {
    glm::dvec3 axis{0.0, 1.0, 0.0};  ///< unit
    Track<double> angle{0.0};        ///< radians
    bool operator==(const AxisRotation&) const = default;
};

/// Alembic's transform: a list of operations whose channels interpolate one by one before the matrix is built.
struct OperationStack {
    /// Channels: translate and scale 3; matrix 16 (column by column, column vectors); rotate axis (3) and angle;
    /// rotate_x, _y, _z the angle. Angles in radians.
    enum class Kind : std::uint8_t { translate, scale, matrix, rotate, rotate_x, rotate_y, rotate_z };
    std::vector<Kind> operations;  ///< M = first * second * ...: the last acts on the point first
    TimeSampling sampling;
    std::vector<double> channels;  ///< sample by sample, each in the order of the operations

    bool operator==(const OperationStack&) const = default;
};

struct Node {
    std::string name;
    int parent = no_index;

    /// Local transform: `operations` where set, else `matrix` where set, else translation * rotation * scale.
    Track<glm::dvec3> translation{glm::dvec3(0.0)};
    Track<glm::dquat> rotation{glm::dquat(1.0, 0.0, 0.0, 0.0)};
    std::optional<AxisRotation> axis_rotation;  ///< in place of `rotation`
    Track<glm::dvec3> scale{glm::dvec3(1.0)};
    std::optional<Track<glm::dmat4>> matrix;  ///< affine, column vectors
    std::optional<OperationStack> operations;
    Track<double> inherits{1.0};  ///< step; where 0 the parent's transform does not apply (Alembic's `.inherits`)

    /// 0: hidden, with everything below; 1: as its parent; 2: shown even below a hidden parent (Alembic's explicit 1).
    /// Step or nearest, it never fades.
    Track<double> visible{1.0};

    std::vector<int> meshes;
    int camera = no_index;
    int light = no_index;
    int include = no_index;  ///< which include brought it; not saved again

    bool operator==(const Node&) const = default;
};

/// What a procedural mesh was made from, kept so that it is saved as it was authored. Sizes in metres.
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

/// Points under a time sampling, as a file stored them; meshes and cages are made of them. The count never changes.
struct PointCache {
    std::string name;
    TimeSampling sampling;
    std::vector<std::vector<glm::vec3>> positions;   ///< m, object space; at least one sample; linear between them
    std::vector<std::vector<glm::vec3>> velocities;  ///< m/s; empty or as `positions`; kept for those who ask
    int include = no_index;

    std::size_t point_count() const { return positions.empty() ? 0 : positions.front().size(); }
    bool operator==(const PointCache&) const = default;
};

/// Displacements of every vertex of a mesh (glTF). Arrays are empty or as long as Mesh::positions.
struct MorphTarget {
    std::string name;
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

/// A subdivision surface's control mesh. Faces are counter-clockwise seen from outside.
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
    std::vector<int> face_sizes;                     ///< vertices of each face, at least 3
    std::vector<int> face_points;                    ///< into the point cache, face by face
    std::vector<int> holes;                          ///< faces that are not drawn
    std::vector<int> crease_lengths, crease_points;  ///< chains of points, each at least 2 long
    std::vector<float> crease_sharpness;             ///< one per chain; 10 is infinitely sharp
    std::vector<int> corner_points;
    std::vector<float> corner_sharpness;
    std::vector<glm::vec2> uv;    ///< face-varying values; v grows downwards
    std::vector<int> face_uv;     ///< into uv, face by face as face_points; empty where there is none
    std::vector<int> face_parts;  ///< which part a face belongs to (Mesh::cage_part); empty: all part 0
    int points = no_index;        ///< point cache
    int level = 2;                ///< refinement of the meshes made of it
    int max_level = 6;            ///< the level that pixels ask for stays at or below this
    int include = no_index;

    bool operator==(const Cage&) const = default;
};

class LimitSurface;  // subdivide.h

/// Follows from the cage and its level, so that it does not count in comparisons.
struct LimitSurfaceRef {
    std::shared_ptr<const LimitSurface> surface;
    bool operator==(const LimitSurfaceRef&) const { return true; }
};

/// Triangles with one material. Per-vertex arrays are empty or as long as `positions`.
/// Points move by one of: a point cache, morph targets and then a skin, a cage; else the mesh is rigid.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< m, object space; of a deforming mesh: its first sample, or its rest shape
    std::vector<glm::vec3> normals;    ///< empty: flat
    std::vector<glm::vec2> uv[2];      ///< v grows downwards, row 0 of the image at v = 0 (glTF)
    std::vector<glm::vec4> colors;     ///< linear, multiplies the base colour
    std::vector<glm::uvec3> triangles;
    int material = no_index;  ///< no_index: glTF's default material
    std::optional<Shape> shape;

    int points = no_index;                     ///< point cache
    std::vector<std::uint32_t> vertex_points;  ///< vertex to point of the cache; empty: one to one
    /// Normals of every vertex over time, for a mesh with a point cache; empty: `normals`, or found anew from the moved
    /// triangles where `normals` is not empty.
    TimeSampling normal_sampling;
    std::vector<std::vector<glm::vec3>> normal_samples;

    /// A mesh with targets or a skin stands under exactly one node. Skinned: the node's own transform does not matter.
    std::vector<MorphTarget> targets;
    std::vector<Track<double>> target_weights;  ///< one per target
    int skin = no_index;
    std::vector<JointWeight> joint_weights;  ///< vertex by vertex, joints_per_vertex each
    int joints_per_vertex = 0;

    int cage = no_index;
    int cage_part = 0;
    LimitSurfaceRef limit;  ///< of the cage at the level of these triangles

    /// 0 where this mesh is not there at all; step. A surface whose topology changes is one mesh for each topology:
    /// there is no motion across the change.
    Track<double> present{1.0};
    int include = no_index;

    bool operator==(const Mesh&) const = default;
};

/// A decoded picture. Eight bits a channel, or float for EXR and HDR; one of the two is empty.
struct SceneImage {
    std::string name;
    std::string path;  ///< relative to the scene file; empty where it was embedded
    Image<glm::u8vec4> bytes;
    Image<glm::vec4> floats;
    int include = no_index;

    bool operator==(const SceneImage&) const = default;
};

enum class Wrap { repeat, clamp, mirror };

struct TextureRef {
    int image = no_index;
    int uv_set = 0;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool nearest = false;  ///< no interpolation when magnified
    /// KHR_texture_transform: uv' = offset + R(rotation) (scale * uv), R counter-clockwise as glTF's v grows downwards.
    glm::dvec2 uv_offset{0.0};
    glm::dvec2 uv_scale{1.0};
    double uv_rotation = 0.0;  ///< radians

    bool operator==(const TextureRef&) const = default;
};

/// glTF 2.0 metallic-roughness, its defaults.
struct Material {
    std::string name;
    Track<glm::dvec3> base_color{glm::dvec3(1.0)};
    Track<double> alpha{1.0};
    Track<double> metallic{1.0};
    Track<double> roughness{1.0};
    Track<glm::dvec3> emission{glm::dvec3(0.0)};  ///< radiance factor
    Track<double> emission_strength{1.0};         ///< KHR_materials_emissive_strength
    Track<double> specular{1.0};                  ///< KHR_materials_specular: 0 is a pure Lambert surface
    Track<glm::dvec3> specular_color{glm::dvec3(1.0)};
    Track<double> ior{1.5};
    Track<double> transmission{0.0};  ///< KHR_materials_transmission: share of light that passes the surface
    enum class AlphaMode { opaque, mask, blend };
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;              ///< mask: not there where alpha is below
    bool unlit = false;                     ///< KHR_materials_unlit: shows its base colour, takes and gives no light
    TextureRef base_color_texture;          ///< sRGB, with alpha
    TextureRef metallic_roughness_texture;  ///< B metallic, G roughness, linear
    TextureRef emission_texture;            ///< sRGB
    TextureRef specular_texture;            ///< A, linear
    TextureRef specular_color_texture;      ///< sRGB
    TextureRef transmission_texture;        ///< R, linear
    bool double_sided = false;              ///< lit and, where it emits, shining on both sides
    int include = no_index;

    bool operator==(const Material&) const = default;
};

/// KHR_lights_punctual; shines along its node's -z.
struct Light {
    enum class Kind { point, directional, spot };
    std::string name;
    Kind kind = Kind::point;
    Track<glm::dvec3> color{glm::dvec3(1.0)};
    Track<double> intensity{1.0};                      ///< point, spot: candela; directional: lux
    Track<double> inner_cone{0.0};                     ///< spot: half-angle of full intensity, radians
    Track<double> outer_cone{std::numbers::pi / 4.0};  ///< spot: half-angle where it ends, at most pi / 2
    Track<double> range{0.0};                          ///< m; 0: unlimited
    int include = no_index;

    bool operator==(const Light&) const = default;
};

/// Looks along its node's -z. The node's scale does not count.
struct Camera {
    std::string name;
    bool orthographic = false;
    Track<double> fov{std::numbers::pi / 4.0};  ///< vertical, radians
    Track<double> half_height{1.0};             ///< orthographic, m
    /// Film offset (lens shift) in heights of the picture: the view's centre moves right and up by so much.
    Track<double> shift_x{0.0}, shift_y{0.0};
    double near_plane = 1e-4;           ///< m; what is nearer has no valid motion
    glm::dvec2 shutter{0.0, 0.0};       ///< open, close: frames relative to the frame's own time
    Track<double> aperture{0.0};        ///< lens radius, m
    Track<double> focus_distance{1.0};  ///< m
    int include = no_index;

    bool operator==(const Camera&) const = default;
};

/// A .gltf, .glb or .abc file whose content hangs below a node. Its elements follow the scene's own.
struct Include {
    std::string path;  ///< relative to the scene file
    int node = no_index;

    bool operator==(const Include&) const = default;
};

/// A render setting as it was written; render/settings.h knows the keys and their types.
using SettingValue = std::variant<bool, double, std::string>;
using SettingMap = std::map<std::string, SettingValue>;

struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;
    bool operator==(const FrameRange&) const = default;
};

struct Scene {
    std::string name;
    FrameRate frame_rate;
    std::optional<FrameRange> range;               ///< frames; unset: the keys' span (frame_range in pose.h)
    std::vector<std::int64_t> cuts;                ///< frames that begin a new shot: no motion from the frame before
    ViewingConditions viewing;                     ///< frames_per_second follows frame_rate
    std::optional<double> exposure;                ///< factor on radiance
    std::optional<Track<glm::dvec3>> environment;  ///< constant radiance all around
    std::string camera;                            ///< name of the camera or of its node; empty: the first

    std::vector<Node> nodes;  ///< a parent stands before its children
    std::vector<Mesh> meshes;
    std::vector<PointCache> point_caches;
    std::vector<Skin> skins;
    std::vector<Cage> cages;
    std::vector<Material> materials;
    std::vector<SceneImage> images;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Include> includes;
    SettingMap settings;

    std::string file;                   ///< where it was read from; empty for a scene made in code
    std::vector<std::string> warnings;  ///< what a user should know about the file; the command line prints them

    bool operator==(const Scene&) const = default;
};

}  // namespace aleph
