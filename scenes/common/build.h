#pragma once
// Short functions that add elements to a scene (engine/scene/scene.h).

#include <string>

#include "engine/scene/scene.h"
#include "engine/surface/shapes.h"

namespace aleph {

inline int add_node(Scene& scene, const std::string& name, int parent = no_index,
                    const glm::dvec3& translation = glm::dvec3(0.0),
                    const glm::dquat& rotation = glm::dquat(1.0, 0.0, 0.0, 0.0)) {
    scene.nodes.push_back(
        {.name = name, .parent = parent, .transform = {.translation = translation, .rotation = rotation}});
    return static_cast<int>(scene.nodes.size()) - 1;
}

inline Node& node_at(Scene& scene, int index) {
    return scene.nodes[index];
}

/// Rotates a node about an axis. @param angle  radians
inline void turn_about(Scene& scene, int node, const glm::dvec3& axis, const Track<double>& angle) {
    node_at(scene, node).transform.axis_rotation = AxisRotation{axis, angle};
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

/// A rotation as a quaternion, rounded to six decimals.
glm::dquat turn(const glm::dvec3& axis, double degrees);
/// The rotation that takes +y to a direction, rounded to six decimals.
glm::dquat y_towards(const glm::dvec3& direction);

/// A node of a scene, to which shapes are added; no_index: the root.
struct Group {
    Scene& scene;
    int node = no_index;

    operator int() const { return node; }
    /// Adds a node that shows one shape. Returns its index.
    int add_shape(const std::string& name, const Shape& shape, int material, const glm::dvec3& translation,
                  const glm::dquat& rotation = glm::dquat(1.0, 0.0, 0.0, 0.0)) const;
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

/// A Lambert surface. @param srgb  0..255
int add_lambert(Scene& scene, const std::string& name, const glm::dvec3& srgb);
/// A Lambert surface with a texture. @param image  name of an image of the scene
int add_textured(Scene& scene, const std::string& name, const std::string& image);
int add_emitter(Scene& scene, const std::string& name, const glm::dvec3& color, double radiance);
/// Gives the last material a highlight.
void add_gloss(Scene& scene, double roughness);

}  // namespace aleph
