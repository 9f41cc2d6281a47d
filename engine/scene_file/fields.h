#pragma once
// Keys of materials, lights, cameras and shapes in scene files, with the limits of their values. Reader and writer use
// the same tables.

#include <array>
#include <string>
#include <vector>

#include "engine/json/json_ref.h"
#include "engine/scene/place.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Limits of a number, in a file and in a scene that a program made (engine/load/validate_scene.h).
struct ValueRange {
    double low = -max_json_number;
    double high = max_json_number;
    bool above_low = false, below_high = false;  ///< the limit itself is excluded
    bool takes_zero = false;                     ///< 0 has a meaning of its own, below `low`

    bool holds(double value) const {
        if (takes_zero && value == 0.0) return true;
        return (above_low ? value > low : value >= low) && (below_high ? value < high : value <= high);
    }
};

/// "has to lie between 0 and 1, found 7", for a value outside.
std::string describe_outside(const ValueRange& range, double value);

/// The range of an angle, from degrees.
ValueRange in_radians(const ValueRange& degrees);

inline constexpr ValueRange any_value{};
inline constexpr ValueRange zero_to_one{0.0, 1.0};
inline constexpr ValueRange above_zero_to_one{0.0, 1.0, true};
inline constexpr ValueRange not_negative{0.0};
inline constexpr ValueRange above_zero{0.0, max_json_number, true};
inline constexpr ValueRange index_of_refraction{1.0, max_json_number, false, false, true};  // 0: full reflection
inline constexpr ValueRange environment_range = not_negative;
inline constexpr ValueRange field_of_view_degrees{0.0, 180.0, true, true};
inline constexpr ValueRange cone_degrees{0.0, 90.0};

template <class Element, class T>
struct TrackField {
    const char* key;
    Place<Element, Track<T>> in;
    ValueRange range;
};

inline constexpr std::array material_numbers{
    TrackField<Material, double>{"alpha", {at<&Material::opacity, &Opacity::alpha>}, zero_to_one},
    TrackField<Material, double>{"metallic", {at<&Material::gloss, &Gloss::metallic>}, zero_to_one},
    TrackField<Material, double>{"roughness", {at<&Material::gloss, &Gloss::roughness>}, zero_to_one},
    TrackField<Material, double>{"specular", {at<&Material::gloss, &Gloss::specular>}, zero_to_one},
    TrackField<Material, double>{"ior", {at<&Material::gloss, &Gloss::ior>}, index_of_refraction},
    TrackField<Material, double>{"emission_strength", {at<&Material::glow, &Glow::strength>}, not_negative},
    TrackField<Material, double>{"transmission", {at<&Material::glass, &Glass::transmission>}, zero_to_one},
    TrackField<Material, double>{"thickness", {at<&Material::glass, &Glass::thickness>}, not_negative},
    TrackField<Material, double>{
        "attenuation_distance", {at<&Material::glass, &Glass::attenuation_distance>}, not_negative},
    TrackField<Material, double>{"clearcoat", {at<&Material::layers, &Layers::clearcoat>}, zero_to_one},
    TrackField<Material, double>{
        "clearcoat_roughness", {at<&Material::layers, &Layers::clearcoat_roughness>}, zero_to_one},
    TrackField<Material, double>{"sheen_roughness", {at<&Material::layers, &Layers::sheen_roughness>}, zero_to_one},
    TrackField<Material, double>{"anisotropy", {at<&Material::layers, &Layers::anisotropy>}, zero_to_one},
};
inline constexpr std::array material_colors{
    TrackField<Material, glm::dvec3>{"base_color", {at<&Material::base_color>}, zero_to_one},
    TrackField<Material, glm::dvec3>{"specular_color", {at<&Material::gloss, &Gloss::specular_color>}, not_negative},
    TrackField<Material, glm::dvec3>{"emission", {at<&Material::glow, &Glow::color>}, not_negative},
    TrackField<Material, glm::dvec3>{
        "attenuation_color", {at<&Material::glass, &Glass::attenuation_color>}, zero_to_one},
    TrackField<Material, glm::dvec3>{"sheen_color", {at<&Material::layers, &Layers::sheen_color>}, zero_to_one},
};
/// A value that does not change over time.
template <class Element, class T>
struct Field {
    const char* key;
    Place<Element, T> in;
    ValueRange range = any_value;
};

inline constexpr std::array light_colors{
    TrackField<Light, glm::dvec3>{"color", {at<&Light::color>}, not_negative},
};
inline constexpr std::array light_numbers{
    TrackField<Light, double>{"intensity", {at<&Light::intensity>}, not_negative},
    TrackField<Light, double>{"range", {at<&Light::range>}, not_negative},
};

inline constexpr std::array camera_numbers{
    TrackField<Camera, double>{"half_height", {at<&Camera::half_height>}, above_zero},
    TrackField<Camera, double>{"shift_x", {at<&Camera::shift_x>}, any_value},
    TrackField<Camera, double>{"shift_y", {at<&Camera::shift_y>}, any_value},
    TrackField<Camera, double>{"aperture", {at<&Camera::aperture>}, not_negative},
    TrackField<Camera, double>{"focus", {at<&Camera::focus_distance>}, above_zero},
};

inline constexpr std::array camera_lengths{
    Field<Camera, double>{"near", {at<&Camera::near_plane>}, above_zero},
};

inline constexpr std::array material_scales{
    Field<Material, double>{"normal_scale", {at<&Material::textures, &MaterialImages::normal_scale>}},
    Field<Material, double>{"clearcoat_normal_scale",
                            {at<&Material::textures, &MaterialImages::clearcoat_normal_scale>}},
};
inline constexpr std::array viewing_numbers{
    Field<ViewingConditions, double>{"pixels_per_degree", {at<&ViewingConditions::pixels_per_degree>}, above_zero},
    Field<ViewingConditions, double>{"display_white", {at<&ViewingConditions::display_white>}, above_zero},
    Field<ViewingConditions, double>{"persistence", {at<&ViewingConditions::persistence>}, above_zero_to_one},
};

/// Null, or why the cones of a light do not fit each other. Keys may cross: the light then ends sharply.
const char* fault_of_cones(const Light& light);

/// An angle under one of two keys.
template <class Element>
struct AngleField {
    const char* key;             ///< degrees
    const char* key_in_radians;  ///< where programs need every bit
    Place<Element, Track<double>> in;
    ValueRange range;  ///< degrees
};

inline constexpr std::array camera_angles{
    AngleField<Camera>{"fov", "fov_radians", {at<&Camera::fov>}, field_of_view_degrees},
};
inline constexpr std::array light_cones{
    AngleField<Light>{"inner_cone", "inner_cone_radians", {at<&Light::inner_cone>}, cone_degrees},
    AngleField<Light>{"outer_cone", "outer_cone_radians", {at<&Light::outer_cone>}, cone_degrees},
};
inline constexpr std::array material_angles{
    AngleField<Material>{"anisotropy_rotation",
                         "anisotropy_rotation_radians",
                         {at<&Material::layers, &Layers::anisotropy_rotation>},
                         any_value},
};

inline constexpr std::array shape_numbers{
    Field<Shape, double>{"radius", {at<&Shape::radius>}},
    Field<Shape, double>{"tube_radius", {at<&Shape::tube_radius>}},
    Field<Shape, double>{"height", {at<&Shape::height>}},
};

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
