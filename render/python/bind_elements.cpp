// Materials, lights, cameras, meshes and nodes.

#include <pybind11/stl.h>

#include <numbers>

#include "engine/scene_file/fields.h"
#include "render/python/arrays.h"
#include "render/python/bindings.h"
#include "render/python/elements.h"

namespace aleph::python {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// A copy, (values, 3).
template <class Number, class Triple>
py::array_t<Number> copy_triples(const std::vector<Triple>& values) {
    return py::array_t<Number>({static_cast<py::ssize_t>(values.size()), py::ssize_t{3}},
                               reinterpret_cast<const Number*>(values.data()));
}

void set_positions(const Element<Mesh>& element,
                   const py::array_t<float, py::array::c_style | py::array::forcecast>& positions) {
    Mesh& mesh = element.get();
    const auto count = static_cast<py::ssize_t>(mesh.positions.size());
    if (positions.ndim() != 2 || positions.shape(0) != count || positions.shape(1) != 3)
        throw InputError("", fmt::format("Mesh '{}': positions", mesh.name),
                         fmt::format("expected an array ({}, 3): the number of points does not change", count));
    if (mesh.shape || mesh.deformation.points != no_index || mesh.subdivision.cage != no_index)
        throw InputError("", fmt::format("Mesh '{}': positions", mesh.name),
                         "its points come from a shape, a cage or a list of points");
    const auto* const data = reinterpret_cast<const glm::vec3*>(positions.data());
    mesh.positions.assign(data, data + count);
}

}  // namespace

void bind_materials(py::module_& module) {
    auto m = bind_elements<Material>(module, "Material", "Materials",
                                     "A material. Properties have the names and units of scene files; colours are "
                                     "linear Rec.709, (3,); all but the flags may be a Track.");
    add_track<&Material::base_color>(m, "base_color", "Base colour.");
    add_track<&Material::opacity, &Opacity::alpha>(m, "alpha", "Coverage, 0 to 1.");
    add_track<&Material::glow, &Glow::color>(
        m, "emission", "Radiance that it sends out, cd/m2 before exposure, times emission_strength.");
    add_track<&Material::glow, &Glow::strength>(m, "emission_strength", "Factor on emission.");
    add_track<&Material::gloss, &Gloss::metallic>(m, "metallic", "0 to 1.");
    add_track<&Material::gloss, &Gloss::roughness>(m, "roughness", "0 to 1.");
    add_track<&Material::gloss, &Gloss::specular>(m, "specular", "0 to 1; 0 is Lambert's surface.");
    add_track<&Material::gloss, &Gloss::specular_color>(m, "specular_color", "Colour of the dielectric reflection.");
    add_track<&Material::gloss, &Gloss::ior>(m, "ior", "Index of refraction.");
    add_track<&Material::glass, &Glass::transmission>(m, "transmission", "Share of light that passes.");
    add_track<&Material::glass, &Glass::thickness>(m, "thickness", "Metres; above 0 the mesh encloses a volume.");
    add_track<&Material::glass, &Glass::attenuation_distance>(m, "attenuation_distance", "Metres.");
    add_track<&Material::glass, &Glass::attenuation_color>(m, "attenuation_color",
                                                           "Colour of white after that distance.");
    add_track<&Material::layers, &Layers::clearcoat>(m, "clearcoat", "Strength of the coat.");
    add_track<&Material::layers, &Layers::clearcoat_roughness>(m, "clearcoat_roughness", "0 to 1.");
    add_track<&Material::layers, &Layers::sheen_color>(m, "sheen_color", "Colour of the sheen.");
    add_track<&Material::layers, &Layers::sheen_roughness>(m, "sheen_roughness", "0 to 1.");
    add_track<&Material::layers, &Layers::anisotropy>(m, "anisotropy", "Strength, 0 to 1.");
    add_track<&Material::layers, &Layers::anisotropy_rotation>(m, "anisotropy_rotation", "Degrees.", degree);
    add_field(m, "unlit", "Shows its base colour, takes and gives no light.", &Material::unlit);
    add_field(m, "double_sided", "Lit and shining on both sides.", &Material::double_sided);
}

void bind_lights_and_cameras(py::module_& module) {
    auto light = bind_elements<Light>(module, "Light", "Lights", "A point, directional or spot light.");
    light.def_property_readonly(
        "kind", [](const Element<Light>& e) { return light_words[static_cast<std::size_t>(e.get().kind)]; },
        "\"point\", \"directional\" or \"spot\".");
    add_track<&Light::color>(light, "color", "Linear colour.");
    add_track<&Light::intensity>(light, "intensity", "Candela; of a directional light lux.");
    add_track<&Light::range>(light, "range", "Metres; 0: unlimited.");
    add_track<&Light::inner_cone>(light, "inner_cone", "Degrees from the axis.", degree);
    add_track<&Light::outer_cone>(light, "outer_cone", "Degrees from the axis.", degree);

    auto camera = bind_elements<Camera>(module, "Camera", "Cameras", "A camera; it looks along -z of its node.");
    add_field(camera, "orthographic", "True: half_height counts, and not fov.", &Camera::orthographic);
    add_track<&Camera::fov>(camera, "fov", "Degrees, vertical.", degree);
    add_track<&Camera::half_height>(camera, "half_height", "Metres, of an orthographic view.");
    add_track<&Camera::shift_x>(camera, "shift_x", "Shift of the lens to the right, heights of the picture.");
    add_track<&Camera::shift_y>(camera, "shift_y", "The same upwards.");
    add_track<&Camera::aperture>(camera, "aperture", "Radius of the lens, metres.");
    add_track<&Camera::focus_distance>(camera, "focus_distance", "Metres.");
    camera.def_property(
        "shutter", [](const Element<Camera>& e) { return std::pair(e.get().shutter.x, e.get().shutter.y); },
        [](const Element<Camera>& e, std::pair<double, double> times) {
            e.get().shutter = {times.first, times.second};
        },
        "Open and close, frames relative to the frame.");
}

namespace {

void bind_meshes(py::module_& module) {
    auto mesh = bind_elements<Mesh>(module, "Mesh", "Meshes", "Triangles of one material.");
    mesh.def_property(
            "positions", [](const Element<Mesh>& e) { return copy_triples<float>(e.get().positions); }, &set_positions,
            "A copy of the points, (points, 3), metres in the space of its node. Those of a mesh that neither deforms "
            "nor is made from a shape may be assigned.")
        .def_property_readonly(
            "triangles", [](const Element<Mesh>& e) { return copy_triples<std::uint32_t>(e.get().triangles); },
            "A copy of the indices of points, (triangles, 3).")
        .def_property(
            "material",
            [](const Element<Mesh>& e) { return element_or_none(e.scene, &Scene::materials, e.get().material); },
            [](const Element<Mesh>& e, const std::optional<Element<Material>>& material) {
                if (material && material->scene != e.scene)
                    throw InputError("", "Mesh.material", "it is of another scene");
                e.get().material = material ? static_cast<int>(material->index) : no_index;
            },
            "Its material; None: white and rough.");
    add_track<&Mesh::present>(mesh, "present", "0 where it is not there; step.");
}

void bind_transform(py::class_<Element<Node>>& node) {
    add_track<&Node::transform, &LocalTransform::translation>(node, "translation", "Metres, (3,).");
    add_track<&Node::transform, &LocalTransform::scale>(node, "scale", "Factors, (3,).");
    node.def_property(
        "rotation",
        [](const Element<Node>& e) -> py::object {
            const LocalTransform& transform = e.get().transform;
            if (!transform.axis_rotation) return track_to_python(transform.rotation);
            const glm::dvec3& axis = transform.axis_rotation->axis;
            return py::make_tuple(py::make_tuple(axis.x, axis.y, axis.z),
                                  track_to_python(transform.axis_rotation->angle, degree));
        },
        [](const Element<Node>& e, const py::object& value) {
            const std::string place = fmt::format("Node '{}': rotation", e.get().name);
            LocalTransform& transform = e.get().transform;
            transform.operations.reset();
            if (!py::isinstance<py::tuple>(value) || py::len(value) != 2) {
                transform.rotation = track_from_python<glm::dquat>(value, place);
                transform.axis_rotation.reset();
                return;
            }
            const auto pair = value.cast<py::tuple>();
            const glm::dvec3 axis = track_from_python<glm::dvec3>(pair[0], place).values.front();
            if (!(glm::length(axis) > 0.0)) throw InputError("", place, "the axis has no length");
            transform.axis_rotation =
                AxisRotation{glm::normalize(axis), track_from_python<double>(pair[1], place, degree)};
        },
        "A quaternion x, y, z, w, or a pair of an axis (3,) and its degrees.");
    node.def_property(
        "matrix",
        [](const Element<Node>& e) -> py::object {
            if (!e.get().transform.matrix) return py::none();
            return track_to_python(*e.get().transform.matrix);
        },
        [](const Element<Node>& e, const py::object& value) {
            const std::string place = fmt::format("Node '{}': matrix", e.get().name);
            auto& matrix = e.get().transform.matrix;
            if (value.is_none()) return matrix.reset();
            matrix = track_from_python<glm::dmat4>(value, place);
            e.get().transform.operations.reset();
        },
        "An affine (4, 4) matrix for column vectors in place of translation, rotation and scale; None: it has these.");
}

}  // namespace

void bind_nodes_and_meshes(py::module_& module) {
    bind_meshes(module);
    auto node = bind_elements<Node>(module, "Node", "Nodes",
                                    "A node of the scene. From its space to its parent's: `matrix` where set, else "
                                    "translation * rotation * scale. Each may be a Track. A node of an Alembic archive "
                                    "has transform operations instead, until one of these is assigned.");
    node.def_property_readonly(
            "parent", [](const Element<Node>& e) { return element_or_none(e.scene, &Scene::nodes, e.get().parent); },
            "The node above; None at the top.")
        .def_property_readonly(
            "meshes",
            [](const Element<Node>& e) {
                py::list meshes;
                for (const int index : e.get().meshes) meshes.append(element_or_none(e.scene, &Scene::meshes, index));
                return meshes;
            },
            "The meshes that it shows.")
        .def_property_readonly(
            "camera", [](const Element<Node>& e) { return element_or_none(e.scene, &Scene::cameras, e.get().camera); },
            "Its camera, or None.")
        .def_property_readonly(
            "light", [](const Element<Node>& e) { return element_or_none(e.scene, &Scene::lights, e.get().light); },
            "Its light, or None.");
    add_track<&Node::visible>(node, "visible", "1: as its parent; 0: hidden, with all below; step.");
    bind_transform(node);
}

}  // namespace aleph::python
