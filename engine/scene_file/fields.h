#pragma once
// Keys of materials, lights, cameras and shapes in scene files, with the limits of their values. Reader and writer use
// the same tables.

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// Limits of a value. `open`: the limits themselves are excluded.
struct ValueRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool open = false;
};

inline constexpr ValueRange any_value{};
inline constexpr ValueRange zero_to_one{0.0, 1.0, false};
inline constexpr ValueRange not_negative{0.0, std::numeric_limits<double>::infinity(), false};
inline constexpr ValueRange at_least_one{1.0, std::numeric_limits<double>::infinity(), false};
inline constexpr ValueRange above_zero{0.0, std::numeric_limits<double>::infinity(), true};
inline constexpr ValueRange field_of_view_degrees{0.0, 180.0, true};
inline constexpr ValueRange cone_degrees{0.0, 90.0, false};

template <class Element, class T>
struct TrackField {
    const char* key;
    Track<T> Element::*member;
    ValueRange range;
};

inline constexpr std::array material_numbers{
    TrackField<Material, double>{"alpha", &Material::alpha, zero_to_one},
    TrackField<Material, double>{"metallic", &Material::metallic, zero_to_one},
    TrackField<Material, double>{"roughness", &Material::roughness, zero_to_one},
    TrackField<Material, double>{"specular", &Material::specular, zero_to_one},
    TrackField<Material, double>{"ior", &Material::ior, at_least_one},
    TrackField<Material, double>{"emission_strength", &Material::emission_strength, not_negative},
    TrackField<Material, double>{"transmission", &Material::transmission, zero_to_one},
    TrackField<Material, double>{"thickness", &Material::thickness, not_negative},
    TrackField<Material, double>{"attenuation_distance", &Material::attenuation_distance, not_negative},
    TrackField<Material, double>{"clearcoat", &Material::clearcoat, zero_to_one},
    TrackField<Material, double>{"clearcoat_roughness", &Material::clearcoat_roughness, zero_to_one},
    TrackField<Material, double>{"sheen_roughness", &Material::sheen_roughness, zero_to_one},
    TrackField<Material, double>{"anisotropy", &Material::anisotropy, zero_to_one},
};
inline constexpr std::array material_colors{
    TrackField<Material, glm::dvec3>{"base_color", &Material::base_color, zero_to_one},
    TrackField<Material, glm::dvec3>{"specular_color", &Material::specular_color, not_negative},
    TrackField<Material, glm::dvec3>{"emission", &Material::emission, not_negative},
    TrackField<Material, glm::dvec3>{"attenuation_color", &Material::attenuation_color, zero_to_one},
    TrackField<Material, glm::dvec3>{"sheen_color", &Material::sheen_color, zero_to_one},
};
/// A value that does not change over time.
template <class Element, class T>
struct Field {
    const char* key;
    T Element::*member;
};

inline constexpr std::array camera_numbers{
    TrackField<Camera, double>{"half_height", &Camera::half_height, above_zero},
    TrackField<Camera, double>{"shift_x", &Camera::shift_x, any_value},
    TrackField<Camera, double>{"shift_y", &Camera::shift_y, any_value},
    TrackField<Camera, double>{"aperture", &Camera::aperture, not_negative},
    TrackField<Camera, double>{"focus", &Camera::focus_distance, above_zero},
};

inline constexpr std::array material_scales{
    Field<Material, double>{"normal_scale", &Material::normal_scale},
    Field<Material, double>{"clearcoat_normal_scale", &Material::clearcoat_normal_scale},
};
inline constexpr std::array viewing_numbers{
    Field<ViewingConditions, double>{"pixels_per_degree", &ViewingConditions::pixels_per_degree},
    Field<ViewingConditions, double>{"display_white", &ViewingConditions::display_white},
    Field<ViewingConditions, double>{"persistence", &ViewingConditions::persistence},
};

/// An angle under one of two keys.
template <class Element>
struct AngleField {
    const char* key;             ///< degrees
    const char* key_in_radians;  ///< where programs need every bit
    Track<double> Element::*member;
    ValueRange range;  ///< degrees
};

inline constexpr std::array camera_angles{
    AngleField<Camera>{"fov", "fov_radians", &Camera::fov, field_of_view_degrees},
};
inline constexpr std::array light_cones{
    AngleField<Light>{"inner_cone", "inner_cone_radians", &Light::inner_cone, cone_degrees},
    AngleField<Light>{"outer_cone", "outer_cone_radians", &Light::outer_cone, cone_degrees},
};
inline constexpr std::array material_angles{
    AngleField<Material>{"anisotropy_rotation", "anisotropy_rotation_radians", &Material::anisotropy_rotation,
                         any_value},
};

inline constexpr std::array shape_numbers{
    Field<Shape, double>{"radius", &Shape::radius},
    Field<Shape, double>{"tube_radius", &Shape::tube_radius},
    Field<Shape, double>{"height", &Shape::height},
};

/// The material of an empty object. Unlike in glTF an absent `metallic` is 0: in a file written by hand a colour alone
/// means a plain surface.
inline Material absent_material() {
    return {.metallic = 0.0};
}

// Words of enumerations, in the order of their values.
inline constexpr std::array interpolation_words{"step", "linear", "nearest", "cubic"};
inline constexpr std::array alpha_words{"opaque", "mask", "blend"};
inline constexpr std::array wrap_words{"repeat", "clamp", "mirror"};
inline constexpr std::array shape_words{"quad", "box", "sphere", "cylinder", "torus", "lathe"};
/// Keys of each kind of shape, in the order of shape_words.
inline const std::array<std::vector<std::string>, shape_words.size()> shape_keys{{
    {"size", "uv_scale"},
    {"size", "uv_scale"},
    {"radius", "segments", "uv_scale"},
    {"radius", "height", "segments", "uv_scale"},
    {"radius", "tube_radius", "segments", "uv_scale"},
    {"profile", "smooth", "segments", "uv_scale"},
}};
inline const std::vector<std::string> mesh_keys{"positions", "points", "vertex_points", "triangles",
                                                "normals",   "uv",     "uv1",           "colors"};
inline constexpr std::array scheme_words{"catmull_clark", "loop", "bilinear"};
inline constexpr std::array boundary_words{"none", "edge_only", "edge_and_corner"};
inline constexpr std::array uv_rule_words{"linear_none",          "linear_corners_only", "linear_corners_plus1",
                                          "linear_corners_plus2", "linear_boundaries",   "linear_all"};
inline constexpr std::array light_words{"point", "directional", "spot"};

}  // namespace aleph
