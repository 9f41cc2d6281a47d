// Validator: meshes and animations: what accessors are used for.
#include <fmt/format.h>

#include <set>
#include <utility>

#include "engine/base/errors.h"
#include "engine/gltf_validate_parts.h"

namespace aleph {

namespace {

constexpr std::int64_t type_u8 = 5121, type_u16 = 5123, type_u32 = 5125, type_float = 5126;

bool is_float(const AccessorInfo& info) {
    return info.component_type == type_float;
}

/// Floats, or unsigned integers that stand for 0 to 1.
bool is_unit_range(const AccessorInfo& info) {
    const bool small = info.component_type == type_u8 || info.component_type == type_u16;
    return is_float(info) || (small && info.normalized);
}

void check_attribute(const JsonRef& attribute, std::string_view name, const AccessorInfo& info) {
    if ((name == "POSITION" || name == "NORMAL") && (info.type != "VEC3" || !is_float(info))) {
        attribute.fail(fmt::format("{} must be a float VEC3 accessor", name));
    }
    if ((name == "TEXCOORD_0" || name == "TEXCOORD_1") && (info.type != "VEC2" || !is_unit_range(info))) {
        attribute.fail(fmt::format("{} must be a VEC2 accessor of floats or normalized unsigned integers", name));
    }
    if (name == "COLOR_0" && ((info.type != "VEC3" && info.type != "VEC4") || !is_unit_range(info))) {
        attribute.fail("COLOR_0 must be a VEC3 or VEC4 accessor of floats or normalized unsigned integers");
    }
}

void check_indices(const GltfCheck& check, const JsonRef& indices) {
    const AccessorInfo& info = check.accessors[indices.index(check.counts.accessors, "accessor")];
    const bool is_index =
        info.component_type == type_u8 || info.component_type == type_u16 || info.component_type == type_u32;
    if (info.type != "SCALAR" || !is_index || info.normalized) {
        indices.fail("indices must be a SCALAR accessor of unsigned integers, not normalized");
    }
    if (info.interleaved) indices.fail("the view of indices must not have a byteStride");
    if (info.count % 3 != 0) indices.fail(fmt::format("{} indices do not make whole triangles", info.count));
}

void check_primitive(const GltfCheck& check, const JsonRef& primitive) {
    if (const std::optional<JsonRef> targets = primitive.find("targets"))
        targets->fail("morph targets are not supported");
    if (const std::optional<JsonRef> mode = primitive.find("mode"); mode && mode->integer(0, 6) != 4) {
        mode->fail(fmt::format("primitive mode {} is not supported, only triangles (4)", mode->integer(0, 6)));
    }
    primitive.find_index("material", check.counts.materials, "material");

    const JsonRef attributes = primitive.require("attributes");
    attributes.expect_object();
    const JsonRef position = attributes.require("POSITION");
    const AccessorInfo& points = check.accessors[position.index(check.counts.accessors, "accessor")];
    for (const auto& [name, value] : attributes.json().items()) {
        const JsonRef attribute = attributes.require(name);
        const AccessorInfo& info = check.accessors[attribute.index(check.counts.accessors, "accessor")];
        check_attribute(attribute, name, info);
        if (info.count != points.count) {
            attribute.fail(fmt::format("{} elements, POSITION has {}", info.count, points.count));
        }
    }
    const std::optional<JsonRef> indices = primitive.find("indices");
    if (!indices) primitive.fail("meshes without indices are not supported");
    check_indices(check, *indices);
}

void check_channel(const GltfCheck& check, const JsonRef& channel, const JsonRef& samplers,
                   std::set<std::pair<std::size_t, std::string>>& targets) {
    const JsonRef sampler_index = channel.require("sampler");
    const std::size_t sampler_number = sampler_index.index(samplers.array_size(), "sampler");
    const JsonRef target = channel.require("target");
    const JsonRef path = target.require("path");
    const std::string& name = path.string();
    const std::optional<std::size_t> node_number = target.find_index("node", check.counts.nodes, "node");
    if (!node_number) return;  // glTF: such a channel is ignored; the reader says so

    if (name == "weights") path.fail("animated morph target weights are not supported");
    const bool is_rotation = name == "rotation";
    if (!is_rotation && name != "translation" && name != "scale") {
        path.fail(fmt::format("\"{}\" is no animated property", printable(name)));
    }
    const JsonRef nodes = check.root.require("nodes");
    if (nodes[*node_number].has("matrix"))
        path.fail(fmt::format("node {} has a matrix and cannot be animated", *node_number));
    if (!targets.emplace(*node_number, name).second) {
        path.fail(fmt::format("a second channel animates the {} of node {}", name, *node_number));
    }
    const JsonRef sampler = samplers[sampler_number];
    const JsonRef output = sampler.require("output");
    const AccessorInfo& info = check.accessors[output.index(check.counts.accessors, "accessor")];
    if (is_rotation && (info.type != "VEC4" || !(is_float(info) || info.normalized))) {
        output.fail("rotation keys must be a VEC4 accessor of floats or normalized integers");
    }
    if (!is_rotation && (info.type != "VEC3" || !is_float(info))) {
        output.fail(fmt::format("{} keys must be a float VEC3 accessor", name));
    }
}

void check_sampler(const GltfCheck& check, const JsonRef& sampler) {
    if (const std::optional<JsonRef> interpolation = sampler.find("interpolation")) {
        const std::string& name = interpolation->string();
        if (name == "CUBICSPLINE") interpolation->fail("CUBICSPLINE interpolation is not supported");
        if (name != "LINEAR" && name != "STEP") {
            interpolation->fail(fmt::format("\"{}\" is no interpolation", printable(name)));
        }
    }
    const JsonRef input = sampler.require("input");
    const AccessorInfo& times = check.accessors[input.index(check.counts.accessors, "accessor")];
    if (times.type != "SCALAR" || !is_float(times)) input.fail("key times must be a float SCALAR accessor");
    const JsonRef output = sampler.require("output");
    const AccessorInfo& values = check.accessors[output.index(check.counts.accessors, "accessor")];
    if (values.count != times.count) output.fail(fmt::format("{} values for {} key times", values.count, times.count));
}

}  // namespace

void check_meshes(GltfCheck& check) {
    for_each_object(check.root, "meshes", [&](const JsonRef& mesh, std::size_t) {
        mesh.find_string("name");
        const JsonRef primitives = mesh.require("primitives");
        primitives.array_size(1);
        for_each_object(mesh, "primitives",
                        [&](const JsonRef& primitive, std::size_t) { check_primitive(check, primitive); });
        if (const std::optional<JsonRef> weights = mesh.find("weights"))
            weights->fail("morph targets are not supported");
    });
}

void check_animations(GltfCheck& check) {
    std::set<std::pair<std::size_t, std::string>> targets;  // over all animations: they play together
    for_each_object(check.root, "animations", [&](const JsonRef& animation, std::size_t) {
        animation.find_string("name");
        const JsonRef samplers = animation.require("samplers");
        const JsonRef channels = animation.require("channels");
        samplers.array_size(1);
        channels.array_size(1);
        // Channels first: a file that animates weights is refused for that, not for how many weights it has.
        for_each_object(animation, "channels",
                        [&](const JsonRef& channel, std::size_t) { check_channel(check, channel, samplers, targets); });
        for_each_object(animation, "samplers",
                        [&](const JsonRef& sampler, std::size_t) { check_sampler(check, sampler); });
    });
}

}  // namespace aleph
