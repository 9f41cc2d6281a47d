#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/gltf_reader.h"

namespace aleph {

namespace {

constexpr double doubtful_angle = 170.0 * std::numbers::pi / 180.0;  // radians

std::vector<double> read_times(GltfReader& reader, int accessor, const std::string& place) {
    std::vector<double> times = reader.accessors.read<double>(accessor);
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] < 0.0) {
            throw InputError(reader.source.file, place,
                             fmt::format("key {} lies at {} s: key times must not be negative", i, times[i]));
        }
        if (i > 0 && !(times[i] > times[i - 1])) {
            throw InputError(
                reader.source.file, place,
                fmt::format("key {} lies at {} s, the one before at {} s: key times must strictly increase", i,
                            times[i], times[i - 1]));
        }
    }
    return times;
}

/// Interpolation goes the short way, so a turn of 270 degrees between two keys becomes one of -90 (HARD_CASES RP-08).
void warn_of_large_steps(GltfReader& reader, const Track<glm::dquat>& track, const std::string& node) {
    for (std::size_t i = 1; i < track.values.size(); ++i) {
        const glm::dquat& a = track.values[i - 1];
        const glm::dquat b = glm::dot(a, track.values[i]) < 0.0 ? -track.values[i] : track.values[i];
        const double angle = 4.0 * std::atan2(glm::length(a - b), glm::length(a + b));
        if (angle > doubtful_angle) {
            reader.warn(node,
                        fmt::format("rotation keys {} and {} are {:.1f} degrees apart: the turn goes the short way",
                                    i - 1, i, angle * 180.0 / std::numbers::pi));
            return;
        }
    }
}

template <class T>
void set_timing(Track<T>& track, const std::vector<double>& times, bool step) {
    track.sampling.kind = TimeSampling::Kind::acyclic;
    track.sampling.times = times;
    track.interpolation = step ? Interpolation::step : Interpolation::linear;
}

void read_channel(GltfReader& reader, const tinygltf::AnimationChannel& channel,
                  const tinygltf::AnimationSampler& sampler, const std::string& place) {
    const int index = reader.node_of[static_cast<std::size_t>(channel.target_node)];
    if (index == no_index) {
        reader.warn(place, fmt::format("animates node {}, which is not in the scene", channel.target_node));
        return;
    }
    Node& node = reader.part.nodes[static_cast<std::size_t>(index)];
    const std::vector<double> times = read_times(reader, sampler.input, place);
    const std::vector<double> values = reader.accessors.read<double>(sampler.output);
    const bool step = sampler.interpolation == "STEP";
    if (channel.target_path == "rotation") {
        const std::string who = fmt::format("node {} \"{}\"", channel.target_node, printable(node.name));
        node.rotation.values.clear();
        std::size_t far_from_unit = 0;
        for (std::size_t i = 0; i < times.size(); ++i) {
            const UnitRotation unit =
                read_rotation(reader, &values[4 * i], fmt::format("{}: node {} key {}", place, channel.target_node, i));
            if (unit.was_far_from_unit()) ++far_from_unit;
            node.rotation.values.push_back(unit.rotation);
        }
        if (far_from_unit > 0) {
            reader.warn(who, fmt::format("{} rotation keys are not of length 1 and are normalized", far_from_unit));
        }
        set_timing(node.rotation, times, step);
        if (!step) warn_of_large_steps(reader, node.rotation, who);
        return;
    }
    Track<glm::dvec3>& track = channel.target_path == "translation" ? node.translation : node.scale;
    track.values.clear();
    for (std::size_t i = 0; i < times.size(); ++i) {
        track.values.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
    set_timing(track, times, step);
}

}  // namespace

void read_animations(GltfReader& reader) {
    for (std::size_t i = 0; i < reader.source.model.animations.size(); ++i) {
        const tinygltf::Animation& animation = reader.source.model.animations[i];
        for (const tinygltf::AnimationChannel& channel : animation.channels) {
            read_channel(reader, channel, animation.samplers[static_cast<std::size_t>(channel.sampler)],
                         fmt::format("/animations/{}/samplers/{}", i, channel.sampler));
        }
        const std::size_t all = reader.source.document["animations"][i]["channels"].size();
        if (const std::size_t dropped = all - animation.channels.size(); dropped > 0) {
            reader.warn(fmt::format("/animations/{}", i),
                        fmt::format("{} channels animate no node and are ignored", dropped));
        }
    }
}

}  // namespace aleph
