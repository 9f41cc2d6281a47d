#pragma once
// Short functions that add elements to a scene (engine/scene/scene.h).

#include <array>
#include <string>
#include <vector>

#include "engine/scene/append.h"
#include "engine/surface/shapes.h"

namespace aleph {

inline const glm::dquat no_turn(1.0, 0.0, 0.0, 0.0);

inline int add_node(Scene& scene, const std::string& name, int parent = no_index,
                    const glm::dvec3& translation = glm::dvec3(0.0), const glm::dquat& rotation = no_turn) {
    return append(scene.nodes,
                  {.name = name, .parent = parent, .transform = {.translation = translation, .rotation = rotation}});
}

/// Rotates a node about an axis. @param angle  radians
inline void turn_about(Scene& scene, int node, const glm::dvec3& axis, const Track<double>& angle) {
    scene.nodes[node].transform.axis_rotation = AxisRotation{axis, angle};
}

inline Shape quad(double width, double height, const glm::dvec2& uv_scale = glm::dvec2(1.0)) {
    return {.kind = Shape::Kind::quad, .size = {width, height, 1.0}, .uv_scale = uv_scale};
}
inline Shape box(const glm::dvec3& size, const glm::dvec2& uv_scale = glm::dvec2(1.0)) {
    return {.kind = Shape::Kind::box, .size = size, .uv_scale = uv_scale};
}
inline Shape sphere(double radius) {
    return {.kind = Shape::Kind::sphere, .radius = radius};
}
inline Shape cylinder(double radius, double height, int segments = 24) {
    return {.kind = Shape::Kind::cylinder, .radius = radius, .height = height, .segments = segments};
}

/// About the y axis.
inline Shape torus(double radius, double tube_radius, int segments = 48) {
    return {.kind = Shape::Kind::torus, .radius = radius, .tube_radius = tube_radius, .segments = segments};
}
/// (distance from the axis, height) of each point; a repeated point is a sharp edge.
using Profile = std::vector<glm::dvec2>;
inline Shape lathe(const Profile& profile, int segments = 48, const glm::dvec2& uv_scale = glm::dvec2(1.0)) {
    return {.kind = Shape::Kind::lathe, .segments = segments, .profile = profile, .uv_scale = uv_scale};
}

inline constexpr glm::dvec3 x_axis{1.0, 0.0, 0.0}, y_axis{0.0, 1.0, 0.0}, z_axis{0.0, 0.0, 1.0};

/// A rotation as a quaternion, rounded to six decimals.
glm::dquat turn(const glm::dvec3& axis, double degrees);
/// The rotation that takes +y to a direction.
glm::dquat y_towards(const glm::dvec3& direction);

/// Parts that come in pairs: where they are along an axis, and the end of their names.
struct Side {
    double sign;
    std::string letter;
};
inline const std::array<Side, 2> both_sides{{{-1.0, "a"}, {1.0, "b"}}};

/// A node of a scene, to which shapes are added; no_index: the root.
struct Group {
    Scene& scene;
    int node = no_index;

    operator int() const { return node; }
    /// Adds a node below this one.
    Group add_group(const std::string& name, const glm::dvec3& translation = glm::dvec3(0.0),
                    const glm::dquat& rotation = no_turn) const {
        return {scene, add_node(scene, name, node, translation, rotation)};
    }
    /// Adds a node that shows a mesh; several nodes may show the same. Returns its index, as all below.
    int add_mesh(const std::string& name, int mesh, const glm::dvec3& translation = glm::dvec3(0.0),
                 const glm::dquat& rotation = no_turn) const;
    int add_shape(const std::string& name, const Shape& shape, int material,
                  const glm::dvec3& translation = glm::dvec3(0.0), const glm::dquat& rotation = no_turn) const;
    /// A straight round bar between two points.
    int add_rod(const std::string& name, const glm::dvec3& from, const glm::dvec3& to, double radius, int material,
                int segments = 12) const;
};

/// Rotations that take +z (the front of a quad) to the direction in the name; exact, without rounded sines.
inline constexpr double half_root = 0.70710678118654752440;
inline const glm::dquat z_to_up(half_root, -half_root, 0.0, 0.0);
inline const glm::dquat z_to_down(half_root, half_root, 0.0, 0.0);
inline const glm::dquat z_to_plus_x(half_root, 0.0, half_root, 0.0);
inline const glm::dquat z_to_minus_x(half_root, 0.0, -half_root, 0.0);
inline const glm::dquat z_to_minus_z(0.0, 0.0, 1.0, 0.0);

/// A Lambert surface, with a highlight if a roughness is given. @param srgb  0..255
int add_lambert(Scene& scene, const std::string& name, const glm::dvec3& srgb, double roughness = 0.0);
/// The same with a texture. @param image  name of an image of the scene
int add_textured(Scene& scene, const std::string& name, const std::string& image, double roughness = 0.0);
/// @param image  multiplies the colour; may be empty
int add_emitter(Scene& scene, const std::string& name, const glm::dvec3& color, double radiance,
                const std::string& image = "");

/// Adds a camera to the last node. Camera and node are both called "camera"; it looks along the -z of its node.
/// @param fov_degrees  vertical
void hang_camera(Scene& scene, double fov_degrees);

/// Position and target of the camera on a frame.
struct CameraStop {
    double frame;  ///< 30 frames per second
    glm::dvec3 eye, target;
};

/// A camera that moves from stop to stop, eased in between. The node "camera_rig" moves and rotates about y, the node
/// below it rotates about x.
void add_walking_camera(Scene& scene, const std::vector<CameraStop>& stops, double fov_degrees);

}  // namespace aleph
