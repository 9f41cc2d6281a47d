// glTF reader: animations: each channel's keys go to the property that it moves.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "engine/base/errors.h"
#include "engine/gltf/reader.h"
#include "engine/gltf/tracks.h"
#include "engine/gltf/validate/pointer.h"
#include "engine/json/close_names.h"

namespace aleph {

namespace {

struct MovedProperty {
    const tinygltf::AnimationSampler& sampler;
    GltfPointer target;
    std::string place;  ///< of the sampler
};

void read_weights(GltfReader& reader, const MovedProperty& channel) {
    const std::vector<int>& meshes = reader.morphs_of[channel.target.index];
    if (meshes.empty()) return;
    const std::size_t count = reader.part.meshes[meshes[0]].deformation.targets.size();
    const GltfKeys keys = read_keys(reader, channel.sampler, channel.place, count);
    for (const int index : meshes) {
        Mesh& mesh = reader.part.meshes[index];
        for (std::size_t k = 0; k < count; ++k) {
            mesh.deformation.target_weights[k] = number_track(reader, keys, channel.place, k);
        }
    }
}

void read_node_channel(GltfReader& reader, const MovedProperty& channel) {
    const std::size_t source = channel.target.index;
    const int index = reader.node_of[source];
    if (index == no_index) {
        reader.warn(channel.place, fmt::format("animates node {}, which is not in the scene", source));
        return;
    }
    if (channel.target.info->property == GltfProperty::node_weights) return read_weights(reader, channel);
    Node& node = reader.part.nodes[index];
    GltfKeys keys = read_keys(reader, channel.sampler, channel.place);
    switch (channel.target.info->property) {
        case GltfProperty::node_rotation:
            node.transform.rotation = rotation_track(reader, keys, channel.place,
                                                     fmt::format("node {} \"{}\"", source, printable(node.name)));
            break;
        case GltfProperty::node_translation:
            node.transform.translation = vector_track(reader, keys, channel.place);
            break;
        case GltfProperty::node_scale:
            node.transform.scale = vector_track(reader, keys, channel.place);
            break;
        default:
            for (double& value : keys.values) value = value != 0.0 ? 1.0 : 0.0;
            node.visible = number_track(reader, keys, channel.place);
    }
}

/// Where the scene keeps a number of a camera, a light or a material; null for colours, and for a range that a
/// directional light ignores.
Track<double>* find_number(Scene& part, const GltfPointer& target) {
    const std::size_t i = target.index;
    switch (target.info->property) {
        case GltfProperty::camera_yfov:
            return &part.cameras[i].fov;
        case GltfProperty::camera_ymag:
            return &part.cameras[i].half_height;
        case GltfProperty::light_intensity:
            return &part.lights[i].intensity;
        case GltfProperty::light_inner_cone:
            return &part.lights[i].inner_cone;
        case GltfProperty::light_outer_cone:
            return &part.lights[i].outer_cone;
        case GltfProperty::light_range:
            return part.lights[i].kind == Light::Kind::directional ? nullptr : &part.lights[i].range;
        case GltfProperty::material_factor:
            return target.info->factor->is_color() ? nullptr : &target.info->factor->number(part.materials[i]);
        default:
            return nullptr;
    }
}

Track<glm::dvec3>* find_color(Scene& part, const GltfPointer& target) {
    if (target.info->property == GltfProperty::light_color) return &part.lights[target.index].color;
    const GltfFactor* factor = target.info->factor;
    return factor != nullptr && factor->is_color() ? &factor->color(part.materials[target.index]) : nullptr;
}

void read_channel(GltfReader& reader, const MovedProperty& channel) {
    const GltfPropertyInfo& info = *channel.target.info;
    if (info.owner == GltfOwner::node) return read_node_channel(reader, channel);
    GltfKeys keys = read_keys(reader, channel.sampler, channel.place);
    if (clamp_keys(keys, info.low, info.high, info.factor != nullptr && info.factor->takes_zero)) {
        reader.warn(channel.place, fmt::format("keys of {} leave {} to {} and are clamped",
                                               pointer_text(channel.target), info.low, info.high));
    }
    if (auto* number = find_number(reader.part, channel.target)) *number = number_track(reader, keys, channel.place);
    if (auto* color = find_color(reader.part, channel.target)) *color = vector_track(reader, keys, channel.place);
    if (info.factor != nullptr && info.factor->has_alpha)
        reader.part.materials[channel.target.index].opacity.alpha = number_track(reader, keys, channel.place, 3);
}

/// The extension of a channel that names its property by a JSON pointer; null for other channels.
const nlohmann::json* find_pointer(const nlohmann::json& target) {
    return target["path"] == "pointer" ? find_extension(target, "KHR_animation_pointer") : nullptr;
}

/// The property that a validated channel moves; nothing for a channel that is left out.
std::optional<GltfPointer> find_target(const nlohmann::json& target) {
    if (const auto node = target.find("node"); node != target.end()) {
        return find_node_property(node->get<std::size_t>(), target["path"].get_ref<const std::string&>());
    }
    const nlohmann::json* pointer = find_pointer(target);
    if (pointer == nullptr) return std::nullopt;
    return find_gltf_property((*pointer)["pointer"].get_ref<const std::string&>());
}

std::string animation_name(const GltfReader& reader, std::size_t i) {
    const std::string& name = reader.source.model.animations[i].name;
    return name.empty() ? fmt::format("animation {}", i) : name;
}

void require_animations(const GltfReader& reader, const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < reader.source.model.animations.size(); ++i) known.push_back(animation_name(reader, i));
    for (const std::string& name : names) {
        if (std::ranges::find(known, name) != known.end()) continue;
        throw InputError(reader.source.file, "",
                         fmt::format("there is no animation \"{}\"{}", printable(name),
                                     known.empty() ? "; the file has none" : suggestion(name, known)));
    }
}

}  // namespace

void read_animations(GltfReader& reader, const std::vector<std::string>* names) {
    if (names != nullptr) require_animations(reader, *names);
    // All animations play together. Where two move one property they were made to play one at a time: only the first
    // does.
    std::map<std::string, std::size_t> moved_by;
    const std::vector<tinygltf::Animation>& animations = reader.source.model.animations;
    for (std::size_t i = 0; i < animations.size(); ++i) {
        if (names != nullptr && std::ranges::find(*names, animation_name(reader, i)) == names->end()) continue;
        const nlohmann::json& raw = reader.source.document["animations"][i];
        const std::string place = fmt::format("/animations/{}", i);
        std::size_t without_node = 0, left_out = 0, first_mover = 0;
        for (const nlohmann::json& channel : raw["channels"]) {
            const nlohmann::json& named = channel["target"];
            // glTF ignores such a channel; the validator has warned of pointers that are not supported.
            if (!named.contains("node") && find_pointer(named) == nullptr) ++without_node;
            const std::optional<GltfPointer> target = find_target(named);
            if (!target) continue;
            const auto [mover, is_first] = moved_by.emplace(pointer_text(*target), i);
            if (!is_first) {
                if (left_out++ == 0) first_mover = mover->second;
                continue;
            }
            const auto sampler = channel["sampler"].get<std::size_t>();
            read_channel(reader,
                         {animations[i].samplers[sampler], *target, fmt::format("{}/samplers/{}", place, sampler)});
        }
        if (without_node > 0) {
            reader.warn(place, fmt::format("{} channels animate no node and are ignored", without_node));
        }
        if (left_out > 0) {
            const auto name = [&](std::size_t k) {
                const std::string text = printable(animation_name(reader, k));
                return animations[k].name.empty() ? text : fmt::format("\"{}\"", text);
            };
            reader.warn(place,
                        fmt::format("{} of the {} channels of {} are left out: {} moves the same and comes first",
                                    left_out, raw["channels"].size(), name(i), name(first_mover)));
        }
    }
}

}  // namespace aleph
