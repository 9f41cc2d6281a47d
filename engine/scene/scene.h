#pragma once
// The animated scene, which every reader fills: plain data, elements refer to each other by index, every property is a
// track over time; pose() (engine/pose/pose.h) evaluates it. Right-handed, y up, metres, seconds; angles in radians;
// colours linear Rec.709; light units unscaled (candela, lux, nits).

#include <algorithm>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/errors.h"
#include "engine/base/frame_rate.h"
#include "engine/base/index.h"
#include "engine/base/viewing.h"
#include "engine/scene/material.h"
#include "engine/scene/mesh.h"
#include "engine/scene/track.h"

namespace aleph {

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

/// From a node to its parent: `operations` where set, else `matrix` where set, else translation * rotation * scale.
struct LocalTransform {
    Track<glm::dvec3> translation{glm::dvec3(0.0)};
    Track<glm::dquat> rotation{glm::dquat(1.0, 0.0, 0.0, 0.0)};
    std::optional<AxisRotation> axis_rotation{};  ///< in place of `rotation`
    Track<glm::dvec3> scale{glm::dvec3(1.0)};
    std::optional<Track<glm::dmat4>> matrix{};  ///< affine, column vectors
    std::optional<OperationStack> operations{};

    bool operator==(const LocalTransform&) const = default;
};

struct Node {
    std::string name{};
    int parent = no_index;
    LocalTransform transform{};
    Track<double> inherits{1.0};  ///< step; where 0 that of space_of applies, not the parent's (Alembic's `.inherits`)

    /// 0: hidden, with everything below; 1: as its parent; 2: shown even below a hidden parent (Alembic's explicit 1).
    /// Interpolation is step or nearest.
    Track<double> visible{1.0};

    std::vector<int> meshes{};
    int camera = no_index;
    int light = no_index;
    int include = no_index;  ///< index of the include it comes from; such nodes are not saved

    bool operator==(const Node&) const = default;
};

/// KHR_lights_punctual; shines along its node's -z.
struct Light {
    enum class Kind { point, directional, spot };
    std::string name{};
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
    std::string name{};
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

/// A file whose content hangs below a node (.glb, .abc, ...). Its elements follow the scene's own.
struct Include {
    enum class Up : std::uint8_t { x, y, z };
    std::string path;  ///< relative to the scene file
    int node = no_index;
    /// glTF animations that play, by name ("animation 2" if it has none); unset: all.
    std::optional<std::vector<std::string>> animations{};
    std::map<std::string, std::string> materials{};  ///< of the file by name, to the scene's own that take their place
    double scale = 1.0;                              ///< metres per unit of the file
    Up up = Up::y;                                   ///< the file's axis that points up
    int content = no_index;  ///< node that stands for the file's space, once it is read; none: the world

    bool operator==(const Include&) const = default;
};

/// A render setting as it was written; render/settings/settings.h knows the keys and their types.
using SettingValue = std::variant<bool, double, std::string>;
using SettingMap = std::map<std::string, SettingValue>;

/// From this frame on, the picture is seen by another camera.
struct CameraKey {
    std::int64_t frame = 0;
    std::string camera;  ///< name of a camera or of its node

    bool operator==(const CameraKey&) const = default;
};

struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;
    bool operator==(const FrameRange&) const = default;
};

/// The surroundings of the scene.
struct Environment {
    std::optional<Track<glm::dvec3>> radiance;  ///< all around; factor on `image` where set; unset: black
    /// Index of an equirectangular picture: its middle column lies along -z, u grows towards +x, its top row is +y. Its
    /// pixels are floats, linear radiance. Needs `radiance`.
    int image = no_index;
    Track<glm::dquat> rotation{glm::dquat(1.0, 0.0, 0.0, 0.0)};  ///< picture to world
    std::optional<AxisRotation> axis_rotation;                   ///< in place of `rotation`

    bool operator==(const Environment&) const = default;
};

/// The film that is made of the scene: its frames, who looks, and how it is shown.
struct Film {
    FrameRate frame_rate;
    std::optional<FrameRange> range;  ///< frames; unset: the keys' span (frame_range in pose.h)
    std::vector<std::int64_t> cuts;   ///< frames that begin a new shot: no motion from the frame before
    std::string camera;               ///< name of the camera or of its node; empty: the first
    /// In place of `camera`, frames ascending; before the first key its camera looks. A change of cameras is a cut.
    std::vector<CameraKey> camera_keys;
    std::optional<double> exposure;  ///< factor on radiance
    ViewingConditions viewing;

    bool operator==(const Film&) const = default;
};

/// Where the scene is from, and what its file says beside the elements.
struct SceneSource {
    std::string name;  ///< of the scene
    std::string file;  ///< where it was read from; empty for a scene made in code
    std::vector<Include> includes;
    SettingMap settings;
    /// Problems of the file that do not stop it from loading; the command line prints them.
    std::vector<std::string> warnings;

    bool operator==(const SceneSource&) const = default;
};

struct Scene {
    SceneSource source;
    Film film;
    Environment environment;
    std::vector<Node> nodes;  ///< a parent stands before its children
    std::vector<Mesh> meshes;
    std::vector<PointCache> point_caches;
    std::vector<Skin> skins;
    std::vector<Cage> cages;
    std::vector<Material> materials;
    std::vector<SceneImage> images;
    std::vector<Light> lights;
    std::vector<Camera> cameras;

    bool operator==(const Scene&) const = default;
};

/// Index of the first of the nodes, meshes, materials, lights or cameras that has a name.
/// @throws InputError if none has it
template <class Element>
int find_named(const std::vector<Element>& elements, const std::string& name) {
    const auto found = std::ranges::find(elements, name, &Element::name);
    if (found == elements.end()) throw InputError("", name, "no element of this kind has the name");
    return static_cast<int>(found - elements.begin());
}

/// The node that stands for the space of the file that a node comes from: what does not inherit from its parent is in
/// that space. no_index: the world.
inline int space_of(const Scene& scene, const Node& node) {
    const auto include = static_cast<std::size_t>(node.include);  // a part of a scene has none
    return include < scene.source.includes.size() ? scene.source.includes[include].content : no_index;
}

}  // namespace aleph
