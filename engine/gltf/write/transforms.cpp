// glTF writer: the transforms of nodes. Tracks go as they are; operations, sheared matrices and nodes that leave their
// parent's transform are sampled.
#include <algorithm>
#include <cmath>

#include "engine/gltf/write/writer.h"
#include "engine/pose/parts.h"
#include "engine/scene/operations.h"
#include "engine/scene/transforms.h"
#include "engine/scene/visit.h"

namespace aleph {

namespace {

/// Times between which the angle changes by at most max_key_turn, if they are few enough.
std::vector<KeyTime> split_axis_turns(GltfWriter& writer, const AxisRotation& turn, const std::string& place,
                                      SampledTimes& sampled) {
    constexpr double most_per_key = 1e4;
    const std::vector<KeyTime> times = sampled.make_key_times();
    for (std::size_t i = 1; i < times.size(); ++i) {
        const double change = evaluate(turn.angle, times[i].own) - evaluate(turn.angle, times[i - 1].own);
        const double parts = std::ceil(std::abs(change) / max_key_turn);
        if (!(parts > 1.0)) continue;
        if (parts > most_per_key) {  // too fast for anything between frames
            writer.add_frames(sampled, place);
            std::vector<KeyTime> frames = sampled.make_key_times();
            for (KeyTime& key : frames) key.at = key.own;
            return frames;
        }
        const double begin = times[i - 1].own, step = (times[i].own - begin) / parts;
        writer.buffer.charge(static_cast<std::uint64_t>(parts) * 5 * sizeof(float), place);
        for (double k = 1.0; k < parts; ++k) sampled.smooth.push_back(begin + k * step);
    }
    return sampled.make_key_times();
}

WrittenKeys make_axis_keys(GltfWriter& writer, const AxisRotation& turn, const std::string& place) {
    const Track<double>& angle = turn.angle;
    if (angle.interpolation == Interpolation::step || angle.interpolation == Interpolation::nearest) {
        Track<glm::dquat> turns;
        turns.sampling = angle.sampling;
        turns.interpolation = angle.interpolation;
        for (std::size_t i = 0; i < angle.key_count(); ++i)
            turns.values.push_back(rotation_at(turn, sample_time(angle.sampling, i)));
        return make_keys(turns);
    }
    SampledTimes sampled;
    sampled.add(angle);
    if (angle.interpolation != Interpolation::linear) writer.add_frames(sampled, place);
    return make_sampled_keys(split_axis_turns(writer, turn, place, sampled),
                             [&](double t) { return rotation_at(turn, t); });
}

void write_tracks(GltfWriter& writer, const LocalTransform& local, const std::string& place,
                  WrittenTransform& written) {
    written.parts.translation = first_value(local.translation);
    written.parts.scale = first_value(local.scale);
    if (is_animated(local.translation)) written.translation_keys = writer.keys_of(local.translation, place);
    if (is_animated(local.scale)) written.scale_keys = writer.keys_of(local.scale, place);
    if (!local.axis_rotation) {
        written.parts.rotation = safe_normalize(first_value(local.rotation));
        if (is_animated(local.rotation)) written.rotation_keys = writer.keys_of(local.rotation, place);
        return;
    }
    const Track<double>& angle = local.axis_rotation->angle;
    written.parts.rotation = rotation_at(*local.axis_rotation, first_time(angle));
    if (is_animated(angle)) written.rotation_keys = make_axis_keys(writer, *local.axis_rotation, place);
}

void write_matrices(const std::vector<KeyTime>& times, const std::vector<glm::dmat4>& matrices,
                    WrittenTransform& written) {
    TransformParts parts;
    written.translation_keys.row = written.scale_keys.row = 3;
    written.rotation_keys.row = written.inner_keys.row = 4;
    for (std::size_t i = 0; i < times.size(); ++i) {
        parts = decompose(matrices[i], parts);
        if (i == 0) written.parts = parts;
        written.translation_keys.append(times[i].time, components(parts.translation));
        written.rotation_keys.append(times[i].time, components(parts.rotation));
        written.scale_keys.append(times[i].time, components(parts.scale));
        written.inner_keys.append(times[i].time, components(parts.inner));
    }
    for (WrittenKeys* keys :
         {&written.translation_keys, &written.rotation_keys, &written.scale_keys, &written.inner_keys})
        if (keys->is_constant()) *keys = {};
}

/// Adds times between those where the matrix turns by more than max_key_turn.
template <class Function>
void split_matrix_turns(const Function& matrix, SampledTimes& sampled) {
    TransformParts last;
    const std::vector<KeyTime> times = sampled.make_key_times();
    for (std::size_t i = 0; i < times.size(); ++i) {
        const TransformParts parts = decompose(matrix(times[i].own), last);
        const bool turns = i > 0 && turn_between(last.rotation, parts.rotation) > max_key_turn;
        if (turns && times[i].own - times[i - 1].own > 1e-4)  // else it jumps
            sampled.smooth.push_back(times[i - 1].own + 0.5 * (times[i].own - times[i - 1].own));
        last = parts;
    }
}

template <class Function>
void write_sampled(const Function& matrix, SampledTimes& sampled, WrittenTransform& written) {
    split_matrix_turns(matrix, sampled);
    const std::vector<KeyTime> times = sampled.make_key_times();
    write_matrices(times, sample_keys(times, matrix), written);
}

/// True where a keyed matrix is linear in glTF's sense between its keys: it does not shear, flatten or change between
/// mirrored and not.
bool is_linear_in_parts(const Track<glm::dmat4>& matrix) {
    if (matrix.interpolation != Interpolation::linear) return false;
    const double sign = orientation_sign(matrix.values[0]);
    for (const glm::dmat4& m : matrix.values) {
        if (!has_full_rank(m) || orientation_sign(m) != sign) return false;
        if (decompose(m, {}).inner != glm::dquat(1.0, 0.0, 0.0, 0.0)) return false;
    }
    return true;
}

/// @param property  a track of matrices, or a stack of operations
/// @param is_exact  of its own times: whether keys there, straight between them, are the property's
template <class Property, class IsExact>
void write_property(GltfWriter& writer, const Property& property, const std::string& place, const IsExact& is_exact,
                    WrittenTransform& written) {
    const auto at = [&](double t) { return evaluate(property, t); };
    if (!is_animated(property)) {
        written.parts = decompose(at(0.0), {});
        return;
    }
    SampledTimes sampled;
    sampled.add(property);
    if (!is_exact(sampled)) writer.add_frames(sampled, place);
    write_sampled(at, sampled, written);
}

/// The world transform of a node, which becomes a root.
void write_world(GltfWriter& writer, int node, const std::string& place, WrittenTransform& written) {
    std::vector<int> chain;  // from the root
    for (int n = node; n != no_index; n = writer.scene.nodes[n].parent) chain.push_back(n);
    std::reverse(chain.begin(), chain.end());
    SampledTimes sampled;
    for (const int n : chain) {
        const Node& each = writer.scene.nodes[n];
        sampled.add(each.inherits);
        visit_tracks(each.transform, [&](const auto& track) { sampled.add(track); });
    }
    writer.add_frames(sampled, place);
    const auto at = [&](double t) {
        for (const int n : chain) place_node(writer.scene, n, t, writer.placed);
        return writer.placed.world[node];
    };
    if (sampled.count() == 0) {
        written.parts = decompose(at(0.0), {});
    } else {
        write_sampled(at, sampled, written);
    }
}

}  // namespace

bool has_key(const Track<double>& track, double value) {
    for (std::size_t i = 0; i < track.key_count(); ++i)
        if (key_value(track, i) == value) return true;
    return false;
}

bool is_detached(const Node& node) {
    return node.parent != no_index && has_key(node.inherits, 0.0);
}

WrittenTransform write_transform(GltfWriter& writer, int index) {
    const Node& node = writer.scene.nodes[index];
    const std::string place = "node \"" + node.name + "\"";
    WrittenTransform written;
    if (is_detached(node) && is_animated(node.inherits)) {
        write_world(writer, index, place, written);
    } else if (node.transform.operations) {
        write_property(
            writer, *node.transform.operations, place, [](const SampledTimes&) { return false; }, written);
    } else if (node.transform.matrix) {
        const auto is_exact = [&](const SampledTimes& sampled) {
            return !sampled.steps.empty() || is_linear_in_parts(*node.transform.matrix);
        };
        write_property(writer, *node.transform.matrix, place, is_exact, written);
    } else {
        write_tracks(writer, node.transform, place, written);
    }
    return written;
}

}  // namespace aleph
