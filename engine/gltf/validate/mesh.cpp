// Validator: meshes, and that their accessors fit their use; skins, and the nodes that deform or multiply a mesh.
#include <fmt/format.h>

#include <set>

#include "engine/gltf/validate/parts.h"

namespace aleph {

namespace {

/// KHR_mesh_quantization allows small integers; without it only floats are allowed.
bool is_position(const GltfCheck& check, const AccessorInfo& info) {
    return is_float(info) || (check.is_quantized && info.component_type != type_u32);
}
bool is_direction(const GltfCheck& check, const AccessorInfo& info) {
    const bool is_signed = info.component_type == type_i8 || info.component_type == type_i16;
    return is_float(info) || (check.is_quantized && is_signed && info.normalized);
}

/// Sets 0 and 1 of an attribute are read: "TEXCOORD_0" of "TEXCOORD_".
bool is_read_set(std::string_view name, std::string_view start) {
    const std::size_t length = start.size();
    return name.size() == length + 1 && name.substr(0, length) == start && (name[length] == '0' || name[length] == '1');
}

void check_attribute(const GltfCheck& check, const JsonRef& attribute, std::string_view name,
                     const AccessorInfo& info) {
    const char* wanted = check.is_quantized ? "a VEC3 accessor of floats or small integers" : "a float VEC3 accessor";
    if (name == "POSITION" && (info.type != "VEC3" || !is_position(check, info))) {
        attribute.fail(fmt::format("POSITION must be {}", wanted));
    }
    if (name == "NORMAL" && (info.type != "VEC3" || !is_direction(check, info))) {
        attribute.fail(fmt::format("NORMAL must be {}", wanted));
    }
    if (is_read_set(name, "TEXCOORD_")) {
        const bool is_uv = is_positive_unit_range(info) || (check.is_quantized && info.component_type != type_u32);
        if (info.type != "VEC2" || !is_uv) {
            attribute.fail(fmt::format("{} must be a VEC2 accessor of floats or normalized unsigned integers", name));
        }
    }
    if (name == "COLOR_0" && ((info.type != "VEC3" && info.type != "VEC4") || !is_positive_unit_range(info))) {
        attribute.fail("COLOR_0 must be a VEC3 or VEC4 accessor of floats or normalized unsigned integers");
    }
    if (is_read_set(name, "JOINTS_")) {
        const bool is_index = info.component_type == type_u8 || info.component_type == type_u16;
        if (info.type != "VEC4" || !is_index || info.normalized) {
            attribute.fail(
                fmt::format("{} must be a VEC4 accessor of 8-bit or 16-bit unsigned integers, not normalized", name));
        }
    }
    if (is_read_set(name, "WEIGHTS_") && (info.type != "VEC4" || !is_positive_unit_range(info))) {
        attribute.fail(fmt::format("{} must be a VEC4 accessor of floats or normalized unsigned integers", name));
    }
}

void check_accessor_use(const JsonRef& attribute, const AccessorInfo& info, std::int64_t vertices) {
    if (info.count != vertices) {
        attribute.fail(fmt::format("{} elements, POSITION has {}", info.count, vertices));
    }
    if (!info.aligned) attribute.fail("vertex attributes must start at multiples of 4 bytes");
}

/// Points need one vertex, lines two, and so on. glTF 2.0, 3.7.2.1.
void check_element_count(const JsonRef& place, std::int64_t mode, std::int64_t count) {
    if (mode == 4 && count % 3 != 0)
        place.fail(fmt::format("{} indices or vertices do not make whole triangles", count));
    if (mode == 1 && count % 2 != 0) place.fail(fmt::format("{} indices or vertices do not make whole lines", count));
    const std::int64_t least = mode == 0 ? 1 : mode <= 3 ? 2 : 3;
    if (count < least) place.fail(fmt::format("primitive mode {} needs {} indices or vertices", mode, least));
}

void check_indices(const GltfCheck& check, const JsonRef& indices, std::int64_t mode) {
    const AccessorInfo& info = check.accessor(indices);
    const bool is_index =
        info.component_type == type_u8 || info.component_type == type_u16 || info.component_type == type_u32;
    if (info.type != "SCALAR" || !is_index || info.normalized) {
        indices.fail("indices must be a SCALAR accessor of unsigned integers, not normalized");
    }
    if (info.interleaved) indices.fail("the view of indices must not have a byteStride");
    check_element_count(indices, mode, info.count);
}

/// Morph targets: displacements of what the primitive itself has.
void check_target(const GltfCheck& check, const JsonRef& target, const JsonRef& attributes, std::int64_t vertices) {
    target.expect_object();
    for (const auto& [name, value] : target.json().items()) {
        const JsonRef displacement = target.require(name);
        const AccessorInfo& info = check.accessor(displacement);
        check_accessor_use(displacement, info, vertices);
        const bool is_vector = name == "POSITION" || name == "NORMAL" || name == "TANGENT";
        if (!is_vector) continue;
        if (!attributes.has(name)) displacement.fail(fmt::format("the primitive itself has no {}", name));
        const bool fits = name == "POSITION" ? is_position(check, info) : is_direction(check, info);
        if (info.type != "VEC3" || !fits) displacement.fail(fmt::format("{} must be a float VEC3 accessor", name));
    }
}

/// JOINTS_n and WEIGHTS_n come in pairs, without gaps.
void check_joint_sets(const JsonRef& attributes) {
    for (const char* set : {"0", "1"}) {
        const bool joints = attributes.has(std::string("JOINTS_") + set);
        const bool weights = attributes.has(std::string("WEIGHTS_") + set);
        if (joints != weights) attributes.fail(fmt::format("JOINTS_{} and WEIGHTS_{} must stand together", set, set));
    }
    if (attributes.has("JOINTS_1") && !attributes.has("JOINTS_0")) attributes.fail("JOINTS_1 without JOINTS_0");
}

/// @return the number of morph targets
std::size_t check_primitive(const GltfCheck& check, const JsonRef& primitive) {
    const std::int64_t mode = primitive.find_integer("mode", 0, 6).value_or(4);
    primitive.find_index("material", check.count("materials"), "material");

    const JsonRef attributes = primitive.require("attributes");
    attributes.expect_object();
    const JsonRef position = attributes.require("POSITION");
    const std::int64_t vertices = check.accessor(position).count;
    for (const auto& [name, value] : attributes.json().items()) {
        const JsonRef attribute = attributes.require(name);
        const AccessorInfo& info = check.accessor(attribute);
        check_attribute(check, attribute, name, info);
        check_accessor_use(attribute, info, vertices);
    }
    check_joint_sets(attributes);
    if (const std::optional<JsonRef> indices = primitive.find("indices")) {
        check_indices(check, *indices, mode);
    } else {
        check_element_count(position, mode, vertices);
    }
    const std::optional<JsonRef> targets = primitive.find("targets");
    if (!targets) return 0;
    const std::size_t count = targets->array_size(1);
    for (std::size_t i = 0; i < count; ++i) check_target(check, (*targets)[i], attributes, vertices);
    return count;
}

/// Optional "weights" of a mesh or a node: one number for each morph target.
void check_weights(const JsonRef& owner, std::size_t target_count) {
    const std::optional<JsonRef> weights = owner.find("weights");
    if (!weights) return;
    if (const std::size_t count = weights->array_size(); count != target_count) {
        weights->fail(fmt::format("{} weights for {} morph targets", count, target_count));
    }
    weights->numbers(target_count);
}

void check_skin(const GltfCheck& check, const JsonRef& skin) {
    skin.find_string("name");
    skin.find_index("skeleton", check.count("nodes"), "node");
    const JsonRef joints = skin.require("joints");
    const std::size_t count = joints.array_size(1);
    std::set<std::size_t> seen;
    for (const JsonRef joint : joints.elements()) {
        const std::size_t node = joint.index(check.count("nodes"), "node");
        if (!seen.insert(node).second) joint.fail(fmt::format("node {} is listed twice", node));
    }
    const std::optional<JsonRef> binds = skin.find("inverseBindMatrices");
    if (!binds) return;
    const AccessorInfo& info = check.accessor(*binds);
    if (info.type != "MAT4" || !is_float(info)) binds->fail("inverse bind matrices must be a float MAT4 accessor");
    if (static_cast<std::size_t>(info.count) < count) {
        binds->fail(fmt::format("{} inverse bind matrices for {} joints", info.count, count));
    }
}

void check_skinned_node(const GltfCheck& check, const JsonRef& node, const JsonRef& skin) {
    skin.index(check.count("skins"), "skin");
    const std::optional<std::size_t> mesh_index = node.find_index("mesh", check.count("meshes"), "mesh");
    if (!mesh_index) skin.fail("a node with a skin needs a mesh");
    const JsonRef meshes = check.root.require("meshes");
    const JsonRef mesh = meshes[*mesh_index];
    for_each_object(mesh, "primitives", [&](const JsonRef& primitive, std::size_t) {
        const JsonRef attributes = primitive.require("attributes");
        if (!attributes.has("JOINTS_0")) attributes.fail("the mesh is used with a skin and has no JOINTS_0, WEIGHTS_0");
    });
}

void check_instances(const GltfCheck& check, const JsonRef& node, const JsonRef& instancing) {
    instancing.expect_object();
    if (!node.has("mesh")) instancing.fail("instances of a node without a mesh");
    if (node.has("skin")) instancing.fail("a skinned mesh cannot be instanced");
    const JsonRef attributes = instancing.require("attributes");
    attributes.expect_object();
    if (attributes.json().empty()) attributes.fail("there is no attribute");
    std::int64_t count = -1;
    for (const auto& [name, value] : attributes.json().items()) {
        const JsonRef attribute = attributes.require(name);
        const AccessorInfo& info = check.accessor(attribute);
        if (count >= 0 && info.count != count) {
            attribute.fail(fmt::format("{} elements, other instance attributes have {}", info.count, count));
        }
        count = info.count;
        if ((name == "TRANSLATION" || name == "SCALE") && (info.type != "VEC3" || !is_float(info))) {
            attribute.fail(fmt::format("{} must be a float VEC3 accessor", name));
        }
        if (name == "ROTATION" && (info.type != "VEC4" || !is_unit_range(info))) {
            attribute.fail("ROTATION must be a VEC4 accessor of floats or normalized integers");
        }
    }
}

}  // namespace

void check_meshes(GltfCheck& check) {
    for_each_object(check.root, "meshes", [&](const JsonRef& mesh, std::size_t) {
        mesh.find_string("name");
        const JsonRef primitives = mesh.require("primitives");
        primitives.array_size(1);
        std::size_t targets = 0;
        for_each_object(mesh, "primitives", [&](const JsonRef& primitive, std::size_t k) {
            const std::size_t count = check_primitive(check, primitive);
            if (k > 0 && count != targets) {
                primitive.fail(fmt::format("{} morph targets, the mesh's first primitive has {}", count, targets));
            }
            targets = count;
        });
        check_weights(mesh, targets);
        check.target_counts.push_back(targets);
    });
}

void check_skins(GltfCheck& check) {
    for_each_object(check.root, "skins", [&](const JsonRef& skin, std::size_t) { check_skin(check, skin); });
    for_each_object(check.root, "nodes", [&](const JsonRef& node, std::size_t) {
        if (const std::optional<JsonRef> skin = node.find("skin")) check_skinned_node(check, node, *skin);
        if (const std::optional<JsonRef> weights = node.find("weights")) {
            const std::optional<std::size_t> mesh = node.find_index("mesh", check.count("meshes"), "mesh");
            if (!mesh) weights->fail("morph target weights of a node without a mesh");
            check_weights(node, check.target_counts[*mesh]);
        }
        if (const ExtensionRef instancing(node, "EXT_mesh_gpu_instancing"); instancing) {
            check_instances(check, node, *instancing);
        }
        if (const ExtensionRef visibility(node, "KHR_node_visibility"); visibility) {
            visibility->check_boolean("visible");
        }
    });
}

}  // namespace aleph
