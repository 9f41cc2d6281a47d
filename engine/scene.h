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

struct Node {
    std::string name;
    int parent = no_index;

    /// Local transform: `matrix` where set, else translation * rotation * scale.
    Track<glm::dvec3> translation{glm::dvec3(0.0)};
    Track<glm::dquat> rotation{glm::dquat(1.0, 0.0, 0.0, 0.0)};
    std::optional<AxisRotation> axis_rotation;  ///< in place of `rotation`
    Track<glm::dvec3> scale{glm::dvec3(1.0)};
    std::optional<Track<glm::dmat4>> matrix;  ///< affine, column vectors

    Track<double> visible{1.0};  ///< hidden where 0, with everything below; step

    std::vector<int> meshes;
    int camera = no_index;
    int light = no_index;
    int include = no_index;  ///< which include brought it; not saved again

    bool operator==(const Node&) const = default;
};

/// What a procedural mesh was made from, kept so that it is saved as it was authored. Sizes in metres.
struct Shape {
    enum class Kind { quad, box, sphere, cylinder };
    Kind kind = Kind::quad;
    glm::dvec3 size{1.0};      ///< quad: x, y (it faces +z); box: x, y, z; centred
    double radius = 0.5;       ///< sphere, cylinder
    double height = 1.0;       ///< cylinder: along y, capped, centred
    int segments = 48;         ///< around; sphere and cylinder
    glm::dvec2 uv_scale{1.0};  ///< how often a texture repeats

    bool operator==(const Shape&) const = default;
};

/// Triangles with one material. Per-vertex arrays are empty or as long as `positions`.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< m, object space
    std::vector<glm::vec3> normals;    ///< empty: flat
    std::vector<glm::vec2> uv[2];      ///< v grows downwards, row 0 of the image at v = 0 (glTF)
    std::vector<glm::vec4> colors;     ///< linear, multiplies the base colour
    std::vector<glm::uvec3> triangles;
    int material = no_index;  ///< no_index: glTF's default material
    std::optional<Shape> shape;
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
    TextureRef base_color_texture;          ///< sRGB, with alpha
    TextureRef metallic_roughness_texture;  ///< B metallic, G roughness, linear
    TextureRef emission_texture;            ///< sRGB
    TextureRef specular_texture;            ///< A, linear
    TextureRef specular_color_texture;      ///< sRGB
    bool double_sided = false;              ///< lit and, where it emits, shining on both sides
    int include = no_index;

    bool operator==(const Material&) const = default;
};

/// KHR_lights_punctual; shines along its node's -z.
struct Light {
    enum class Kind { point, directional };
    std::string name;
    Kind kind = Kind::point;
    Track<glm::dvec3> color{glm::dvec3(1.0)};
    Track<double> intensity{1.0};  ///< point: candela; directional: lux
    double range = 0.0;            ///< m; 0: unlimited
    int include = no_index;

    bool operator==(const Light&) const = default;
};

/// Looks along its node's -z. The node's scale does not count.
struct Camera {
    std::string name;
    bool orthographic = false;
    Track<double> fov{std::numbers::pi / 4.0};  ///< vertical, radians
    Track<double> half_height{1.0};             ///< orthographic, m
    double near_plane = 1e-4;                   ///< m; what is nearer has no valid motion
    glm::dvec2 shutter{0.0, 0.0};               ///< open, close: frames relative to the frame's own time
    Track<double> aperture{0.0};                ///< lens radius, m
    Track<double> focus_distance{1.0};          ///< m
    int include = no_index;

    bool operator==(const Camera&) const = default;
};

/// A .gltf, .glb (later .abc) file whose content hangs below a node. Its elements follow the scene's own.
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
