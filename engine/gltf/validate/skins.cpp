// Validator: skins, and the nodes that deform or multiply a mesh.
#include <fmt/format.h>

#include <set>

#include "engine/base/errors.h"
#include "engine/gltf/validate/parts.h"

namespace aleph {

namespace {

void check_skin(const GltfCheck& check, const JsonRef& skin) {
    skin.find_string("name");
    skin.find_index("skeleton", check.counts.nodes, "node");
    const JsonRef joints = skin.require("joints");
    const std::size_t count = joints.array_size(1);
    std::set<std::size_t> seen;
    for (std::size_t i = 0; i < count; ++i) {
        const JsonRef joint = joints[i];
        const std::size_t node = joint.index(check.counts.nodes, "node");
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
    skin.index(check.counts.skins, "skin");
    const std::optional<std::size_t> mesh_index = node.find_index("mesh", check.counts.meshes, "mesh");
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

void check_skins(GltfCheck& check) {
    for_each_object(check.root, "skins", [&](const JsonRef& skin, std::size_t) { check_skin(check, skin); });
    for_each_object(check.root, "nodes", [&](const JsonRef& node, std::size_t) {
        if (const std::optional<JsonRef> skin = node.find("skin")) check_skinned_node(check, node, *skin);
        if (const std::optional<JsonRef> weights = node.find("weights")) {
            const std::optional<std::size_t> mesh = node.find_index("mesh", check.counts.meshes, "mesh");
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
