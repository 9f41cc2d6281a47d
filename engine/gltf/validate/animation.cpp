// Validator: animations: what channels move, and that the keys fit it.
#include <fmt/format.h>

#include <array>
#include <set>

#include "engine/base/errors.h"
#include "engine/base/index.h"
#include "engine/gltf/validate/parts.h"
#include "engine/gltf/validate/pointer.h"

namespace aleph {

namespace {

/// Pointers to the properties that an animation moves already.
using Taken = std::set<std::string>;

/// Refuses a KHR_animation_pointer whose element is missing or has no such property.
void check_owner(const GltfCheck& check, const GltfPointer& pointer, const JsonRef& place) {
    const std::array counts{check.count("nodes"), check.count("cameras"), check.light_count(),
                            check.count("materials")};
    const std::size_t count = counts[index_of(pointer.info->owner)];
    const std::string text = pointer_text(pointer);
    if (pointer.index >= count) place.fail(fmt::format("\"{}\" leads to nothing: the file has {}", text, count));
    const nlohmann::json& root = check.root.json();
    if (pointer.info->owner == GltfOwner::camera) {
        const char* wanted = pointer.info->property == GltfProperty::camera_yfov ? "perspective" : "orthographic";
        if (root["cameras"][pointer.index]["type"] != wanted) place.fail(fmt::format("\"{}\" leads to nothing", text));
    }
    const bool is_cone = pointer.info->property == GltfProperty::light_inner_cone ||
                         pointer.info->property == GltfProperty::light_outer_cone;
    if (is_cone && root["extensions"]["KHR_lights_punctual"]["lights"][pointer.index]["type"] != "spot") {
        place.fail(fmt::format("\"{}\" leads to nothing", text));
    }
}

/// The property that a channel moves; nothing where the channel is left out.
std::optional<GltfPointer> check_target(GltfCheck& check, const JsonRef& target) {
    const JsonRef path = target.require("path");
    const std::string& name = path.string();
    const std::optional<std::size_t> node = target.find_index("node", check.count("nodes"), "node");
    const ExtensionRef extension(target, "KHR_animation_pointer");
    if (name == "pointer" && extension) {
        if (node) path.fail("a channel has either a node or a pointer");
        const JsonRef text = extension->require("pointer");
        if (text.string().empty() || text.string()[0] != '/') {
            text.fail(fmt::format("\"{}\" is no JSON pointer", printable(text.string())));
        }
        const std::optional<GltfPointer> pointer = find_gltf_property(text.string());
        if (!pointer) {
            check.warn(text, fmt::format("the animation of {} is not supported and is left out",
                                         printable(text.string(), 200)));
            return std::nullopt;
        }
        check_owner(check, *pointer, text);
        return pointer;
    }
    if (!node) return std::nullopt;  // glTF: such a channel is ignored; the reader says so
    const std::optional<GltfPointer> pointer = find_node_property(*node, name);
    if (!pointer) path.fail(fmt::format("\"{}\" is no animated property", printable(name)));
    return pointer;
}

/// Output values for each key: 1, or as many as the node's mesh has morph targets.
std::int64_t values_per_key(const GltfCheck& check, const GltfPointer& pointer, const JsonRef& place) {
    if (pointer.info->property != GltfProperty::node_weights) return 1;
    const JsonRef nodes = check.root.require("nodes");
    const JsonRef node = nodes[pointer.index];
    const std::optional<std::size_t> mesh = node.find_index("mesh", check.count("meshes"), "mesh");
    const std::size_t targets = mesh ? check.target_counts[*mesh] : 0;
    if (targets == 0) place.fail(fmt::format("node {} has no morph targets whose weights could move", pointer.index));
    return static_cast<std::int64_t>(targets);
}

void check_output(const GltfPointer& pointer, const AccessorInfo& info, const JsonRef& output) {
    const std::string text = pointer_text(pointer);
    if (info.type != pointer.info->type) {
        output.fail(fmt::format("keys of {} must be a {} accessor", text, pointer.info->type));
    }
    switch (pointer.info->property) {
        case GltfProperty::node_visible:
            if (info.component_type != type_u8 || info.normalized) {
                output.fail(fmt::format("keys of {} must be 8-bit unsigned integers, not normalized", text));
            }
            return;
        case GltfProperty::node_translation:
        case GltfProperty::node_scale:
            if (!is_float(info)) output.fail(fmt::format("keys of {} must be floats", text));
            return;
        default:
            if (!is_unit_range(info))
                output.fail(fmt::format("keys of {} must be floats or normalized integers", text));
    }
}

void check_keys(const GltfCheck& check, const GltfPointer& pointer, const JsonRef& sampler, const JsonRef& place) {
    const std::string interpolation = sampler.find_string("interpolation").value_or("LINEAR");
    const JsonRef output = sampler.require("output");
    const AccessorInfo& times = check.accessor(sampler.require("input"));
    const AccessorInfo& values = check.accessor(output);
    if (pointer.info->property == GltfProperty::node_visible && interpolation != "STEP") {
        place.fail("visibility must have STEP interpolation");
    }
    const std::int64_t per_key = values_per_key(check, pointer, place) * (interpolation == "CUBICSPLINE" ? 3 : 1);
    check_output(pointer, values, output);
    if (values.count != per_key * times.count) {
        output.fail(
            fmt::format("{} values for {} key times, expected {}", values.count, times.count, per_key * times.count));
    }
}

void check_channel(GltfCheck& check, const JsonRef& channel, const JsonRef& samplers, Taken& taken) {
    const JsonRef sampler = samplers[channel.require("sampler").index(samplers.array_size(), "sampler")];
    const JsonRef target = channel.require("target");
    const std::optional<GltfPointer> pointer = check_target(check, target);
    if (!pointer) return;
    const JsonRef path = target.require("path");
    if (pointer->info->owner == GltfOwner::node) {
        const JsonRef nodes = check.root.require("nodes");
        const bool moves = pointer->info->property <= GltfProperty::node_scale;
        if (moves && nodes[pointer->index].has("matrix")) {
            path.fail(fmt::format("node {} has a matrix and cannot be animated", pointer->index));
        }
    }
    const std::string text = pointer_text(*pointer);
    if (!taken.insert(text).second) path.fail(fmt::format("a second channel of the animation moves {}", text));
    check_keys(check, *pointer, sampler, path);
}

void check_sampler(const GltfCheck& check, const JsonRef& sampler) {
    if (const std::optional<JsonRef> interpolation = sampler.find("interpolation"))
        expect_word(*interpolation, {"LINEAR", "STEP", "CUBICSPLINE"}, "interpolation");
    const JsonRef input = sampler.require("input");
    const AccessorInfo& times = check.accessor(input);
    if (times.type != "SCALAR" || !is_float(times)) input.fail("key times must be a float SCALAR accessor");
    check.accessor(sampler.require("output"));
}

}  // namespace

void check_animations(GltfCheck& check) {
    for_each_object(check.root, "animations", [&](const JsonRef& animation, std::size_t) {
        animation.find_string("name");
        const JsonRef samplers = animation.require("samplers");
        const JsonRef channels = animation.require("channels");
        samplers.array_size(1);
        channels.array_size(1);
        for_each_object(animation, "samplers",
                        [&](const JsonRef& sampler, std::size_t) { check_sampler(check, sampler); });
        Taken taken;
        for_each_object(animation, "channels",
                        [&](const JsonRef& channel, std::size_t) { check_channel(check, channel, samplers, taken); });
    });
}

}  // namespace aleph
