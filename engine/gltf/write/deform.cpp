// glTF writer: morph targets, samples of points as morph targets, skins.
#include <fmt/format.h>

#include <algorithm>

#include "engine/gltf/write/meshes.h"
#include "engine/scene/scene_hash.h"

namespace aleph {

namespace {

constexpr std::size_t joints_in_set = 4;

std::vector<glm::vec3> difference(const std::vector<glm::dvec3>& from, const std::vector<glm::vec3>& base) {
    std::vector<glm::vec3> moved;
    for (std::size_t v = 0; v < from.size(); ++v) moved.emplace_back(from[v] - glm::dvec3(base[v]));
    return moved;
}

/// The samples of a mesh by points: which target each is, and when.
struct ShapeSamples {
    TimeSampling sampling;     ///< acyclic
    std::vector<int> targets;  ///< no_index: the base shape
    std::size_t target_count = 0;
};

/// Weights by which the points move straight from sample to sample: at each, that of its target is 1.
WrittenKeys make_sample_weights(const ShapeSamples& samples) {
    const std::size_t count = samples.targets.size();
    WrittenKeys keys;
    keys.row = samples.target_count;
    const std::vector<KeyTime> times = round_times(samples.sampling.times);
    keys.values.assign(times.size() * keys.row, 0.0f);
    const auto target_at = [&](std::size_t key) {
        return samples.targets[find_samples(samples.sampling, count, times[key].own).floor];
    };
    for (std::size_t i = 0; i < times.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == times.size();
        const bool rests = !is_end && (target_at(i) == target_at(i - 1) || target_at(i) == target_at(i + 1));
        const SampleSpan span = find_samples(samples.sampling, count, is_end || rests ? times[i].own : times[i].at);
        const auto add = [&](std::size_t sample, double weight) {
            const int target = samples.targets[sample];
            if (target != no_index)
                keys.values[i * keys.row + static_cast<std::size_t>(target)] += static_cast<float>(weight);
        };
        add(span.floor, 1.0 - span.fraction);
        if (span.ceil != span.floor) add(span.ceil, span.fraction);
        keys.times.push_back(times[i].time);
    }
    return keys;
}

/// The weights of one vertex, each joint once, with a sum of 1.
std::vector<JointWeight> unite_joints(const JointWeight* weights, std::size_t count) {
    std::vector<JointWeight> united(count);
    double sum = 0.0;
    std::size_t used = 0;
    for (std::size_t k = 0; k < count; ++k) {
        if (!(weights[k].weight > 0.0f)) continue;
        sum += double{weights[k].weight};
        const auto end = united.begin() + static_cast<std::ptrdiff_t>(used);
        const auto same = std::find_if(united.begin(), end, [&](const auto& w) { return w.joint == weights[k].joint; });
        if (same == end) {
            united[used++] = weights[k];
        } else {
            same->weight += weights[k].weight;
        }
    }
    for (JointWeight& weight : united)
        weight.weight = static_cast<float>(double{weight.weight} / (sum > 0.0 ? sum : 1.0));
    if (!(sum > 0.0)) united[0].weight = 1.0f;
    return united;
}

}  // namespace

OrderedJson MeshWriter::write_target(const MorphTarget& target, std::size_t vertices, bool with_normals) {
    GlbBuffer& buffer = writer_.buffer;
    const auto add = [&](const std::vector<glm::vec3>& moves, bool bounds) {
        return moves.empty() ? buffer.add_zeros(vertices, "VEC3", bounds)
                             : buffer.add_floats(floats_of(moves), "VEC3", GlbBuffer::Target::vertices, bounds);
    };
    OrderedJson written;
    written["POSITION"] = add(target.positions, true);
    if (with_normals) written["NORMAL"] = add(target.normals, false);
    return written;
}

void MeshWriter::write_targets(const Mesh& mesh, Written& written) {
    const Deformation& deformation = mesh.deformation;
    if (deformation.targets.empty()) return;
    const bool with_normals = !mesh.normals.empty() && std::ranges::any_of(deformation.targets, [](const auto& target) {
        return !target.normals.empty();
    });
    written.primitive["targets"] = OrderedJson::array();
    for (const MorphTarget& target : deformation.targets)
        written.primitive["targets"].push_back(write_target(target, mesh.positions.size(), with_normals));

    std::vector<KeyColumn> columns;
    SampledTimes sampled;
    const std::string place = fmt::format("mesh \"{}\"", mesh.name);
    for (std::size_t k = 0; k < deformation.targets.size(); ++k) {
        const Track<double> weight = k < deformation.target_weights.size() ? deformation.target_weights[k] : Track(0.0);
        KeyColumn& column = columns.emplace_back();
        column.constant = {first_value(weight)};
        written.first_weights.push_back(column.constant[0]);
        if (!is_animated(weight)) continue;
        column.keys = writer_.keys_of(weight, place);
        sampled.add(weight);
    }
    if (sampled.count() == 0) return;
    if (std::optional<WrittenKeys> joined = join_columns(columns)) {
        written.weights = std::move(*joined);
        return;
    }
    writer_.add_frames(sampled, place);
    written.weights.row = columns.size();
    for (const KeyTime& key : sampled.make_key_times()) {
        written.weights.times.push_back(key.time);
        for (const Track<double>& weight : deformation.target_weights)
            written.weights.values.push_back(static_cast<float>(evaluate(weight, key.at)));
    }
}

void MeshWriter::pose_sample(int mesh, double seconds) {
    const auto deformer = static_cast<std::size_t>(sampled_by_[mesh]);
    const std::uint8_t shown = 1;
    writer_.placed.seconds = seconds;
    deform(writer_.scene, {&deformers_[deformer], 1}, {&shown, 1}, true, writer_.placed);
}

void MeshWriter::write_samples(int index, Written& written) {
    const Scene& scene = writer_.scene;
    const Mesh& mesh = scene.meshes[index];
    const int points =
        mesh.subdivision.cage != no_index ? scene.cages[mesh.subdivision.cage].points : mesh.deformation.points;
    SampledTimes moments;
    const PointCache& cache = scene.point_caches[points];
    moments.add(cache.sampling, cache.positions.size());
    moments.add(mesh.deformation.normal_sampling, mesh.deformation.normal_samples.size());
    ShapeSamples samples;
    samples.sampling.kind = TimeSampling::Kind::acyclic;
    samples.sampling.times = moments.smooth;
    std::vector<double>& times = samples.sampling.times;
    sort_and_unite(times);

    PosedMesh& posed = writer_.placed.meshes[index];
    pose_sample(index, times[0]);
    const std::vector<glm::vec3> base(posed.positions.begin(), posed.positions.end());
    const std::vector<glm::vec3> base_normals =
        posed.normals.empty() ? posed.normals : unit_normals(mesh, posed.normals);
    written.primitive["attributes"] = write_attributes(mesh, base, base_normals);
    OrderedJson targets = OrderedJson::array();
    std::map<std::string, int> known;  // shapes by their fingerprints
    for (const double seconds : times) {
        pose_sample(index, seconds);
        MorphTarget target;
        target.positions = difference(posed.positions, base);
        if (!base_normals.empty()) {
            const std::vector<glm::vec3> normals = unit_normals(mesh, posed.normals);
            target.normals = difference({normals.begin(), normals.end()}, base_normals);
        }
        std::string bytes(reinterpret_cast<const char*>(target.positions.data()), 12 * target.positions.size());
        bytes.append(reinterpret_cast<const char*>(target.normals.data()), 12 * target.normals.size());
        const bool is_base = bytes.find_first_not_of('\0') == std::string::npos;
        const auto [shape, is_new] =
            known.emplace(hash_bytes(bytes), is_base ? no_index : static_cast<int>(targets.size()));
        if (is_new && !is_base) targets.push_back(write_target(target, base.size(), !base_normals.empty()));
        samples.targets.push_back(shape->second);
    }
    posed = {};
    if (targets.empty()) return;
    samples.target_count = targets.size();
    written.primitive["targets"] = std::move(targets);
    writer_.buffer.charge(samples.target_count * times.size() * sizeof(float), fmt::format("mesh \"{}\"", mesh.name));
    written.weights = make_sample_weights(samples);
    const auto first = written.weights.values.begin();
    written.first_weights.assign(first, first + static_cast<std::ptrdiff_t>(samples.target_count));
}

void write_joint_weights(GltfWriter& writer, const Mesh& mesh, OrderedJson& attributes) {
    const auto per_vertex = static_cast<std::size_t>(mesh.deformation.joints_per_vertex);
    const std::size_t sets = (per_vertex + joints_in_set - 1) / joints_in_set, vertices = mesh.positions.size();
    std::vector<std::vector<std::uint16_t>> joints(sets, std::vector<std::uint16_t>(vertices * joints_in_set));
    std::vector<std::vector<float>> weights(sets, std::vector<float>(vertices * joints_in_set));
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto united = unite_joints(&mesh.deformation.joint_weights[v * per_vertex], per_vertex);
        for (std::size_t k = 0; k < per_vertex; ++k) {
            const std::size_t place = v * joints_in_set + k % joints_in_set;
            joints[k / joints_in_set][place] = static_cast<std::uint16_t>(united[k].joint);
            weights[k / joints_in_set][place] = united[k].weight;
        }
    }
    for (std::size_t set = 0; set < sets; ++set) {
        attributes[fmt::format("JOINTS_{}", set)] =
            writer.buffer.add_shorts(joints[set], "VEC4", GlbBuffer::Target::vertices);
        attributes[fmt::format("WEIGHTS_{}", set)] =
            writer.buffer.add_floats(weights[set], "VEC4", GlbBuffer::Target::vertices);
    }
}

void write_skins(GltfWriter& writer) {
    for (const Skin& skin : writer.scene.skins) {
        OrderedJson written;
        if (!skin.name.empty()) written["name"] = skin.name;
        std::vector<float> matrices;
        for (const glm::dmat4& bind : skin.inverse_binds)
            for (int k = 0; k < 16; ++k) matrices.push_back(static_cast<float>(bind[k / 4][k % 4]));
        written["inverseBindMatrices"] = writer.buffer.add_floats(matrices, "MAT4");
        written["joints"] = OrderedJson::array();
        for (const int joint : skin.joints) written["joints"].push_back(writer.node_of[joint]);
        writer.add("skins", std::move(written));
    }
}

}  // namespace aleph
