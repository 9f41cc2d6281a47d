#include <algorithm>

#include "engine/scene_file/lists.h"
#include "engine/scene_file/reader.h"
#include "engine/scene_file/tracks.h"
#include "engine/scene_file/write_elements.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

ordered_json write_samples_of_points(const TimeSampling& sampling, const std::vector<std::vector<glm::vec3>>& samples,
                                     const FrameRate& rate) {
    std::vector<ordered_json> values;
    for (const auto& sample : samples) values.push_back(write_vectors(sample));
    return write_samples(sampling, rate, std::move(values));
}

/// A list cut into consecutive lists of the given lengths.
ordered_json write_runs(const std::vector<int>& lengths, const std::vector<int>& values) {
    ordered_json out = ordered_json::array();
    auto begin = values.begin();
    for (const int length : lengths) {
        out.push_back(std::vector<int>(begin, begin + length));
        begin += length;
    }
    return out;
}

template <class Words, class Word>
void write_word(ordered_json& out, const char* key, const Words& words, Word word, Word absent) {
    if (word != absent) out[key] = words[index_of(word)];
}

}  // namespace

ordered_json write_points(const PointCache& cache, const FrameRate& rate) {
    if (cache.positions.size() == 1 && cache.sampling == TimeSampling{}) return write_vectors(cache.positions.front());
    return write_samples_of_points(cache.sampling, cache.positions, rate);
}

ordered_json write_shape(const Shape& shape) {
    const Shape absent;
    const auto kind = index_of(shape.kind);
    const auto has = [&](const char* key) {
        return std::find(shape_keys[kind].begin(), shape_keys[kind].end(), key) != shape_keys[kind].end();
    };
    ordered_json out = {{"type", shape_words[kind]}};
    if (has("size") && shape.size != absent.size) {
        out["size"] = write_dvec3(shape.size);
        if (shape.kind == Shape::Kind::quad) out["size"].erase(2);
    }
    for (const auto& field : shape_numbers) {
        if (has(field.key) && field.in(shape) != field.in(absent)) out[field.key] = field.in(shape);
    }
    for (const glm::dvec2& point : shape.profile) out["profile"].push_back({point.x, point.y});
    if (shape.smooth != absent.smooth) out["smooth"] = shape.smooth;
    if (has("segments") && shape.segments != absent.segments) out["segments"] = shape.segments;
    if (shape.uv_scale != absent.uv_scale) out["uv_scale"] = {shape.uv_scale.x, shape.uv_scale.y};
    return out;
}

ordered_json write_cage(const Cage& cage, const std::string& points) {
    const Cage absent;
    ordered_json out = {{"points", points}};
    write_word(out, "scheme", scheme_words, cage.scheme, absent.scheme);
    write_word(out, "boundary", boundary_words, cage.boundary, absent.boundary);
    write_word(out, "uv_rule", uv_rule_words, cage.uv_rule, absent.uv_rule);
    if (cage.level != absent.level) out["level"] = cage.level;
    if (cage.max_level != absent.max_level) out["max_level"] = cage.max_level;
    out["faces"] = write_runs(cage.faces.sizes, cage.faces.points);
    const ordered_json chains = write_runs(cage.creases.lengths, cage.creases.points);
    for (std::size_t i = 0; i < chains.size(); ++i) {
        out["creases"].push_back({{"points", chains[i]}, {"sharpness", widen(cage.creases.sharpness[i])}});
    }
    for (std::size_t i = 0; i < cage.corners.points.size(); ++i) {
        out["corners"].push_back({{"point", cage.corners.points[i]}, {"sharpness", widen(cage.corners.sharpness[i])}});
    }
    if (!cage.faces.holes.empty()) out["holes"] = cage.faces.holes;
    if (!cage.uv.empty()) out["uv"] = write_vectors(cage.uv);
    if (!cage.faces.uv.empty() && cage.faces.uv != cage.faces.points) {
        out["face_uv"] = write_runs(cage.faces.sizes, cage.faces.uv);
    }
    if (!cage.faces.parts.empty()) out["parts"] = cage.faces.parts;
    return out;
}

ordered_json write_triangles(const Mesh& mesh, const PointCache* cache, const FrameRate& rate) {
    ordered_json out = {{"type", "mesh"}};
    if (cache != nullptr) {
        out["points"] = cache->name;
        if (!mesh.deformation.vertex_points.empty()) out["vertex_points"] = mesh.deformation.vertex_points;
    }
    if (cache == nullptr || first_positions(mesh, *cache) != mesh.positions) {
        out["positions"] = write_vectors(mesh.positions);
    }
    ordered_json::array_t triangles;
    triangles.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) triangles.emplace_back(triangle[i]);
    }
    out["triangles"] = std::move(triangles);
    if (!mesh.deformation.normal_samples.empty()) {
        out["normals"] =
            write_samples_of_points(mesh.deformation.normal_sampling, mesh.deformation.normal_samples, rate);
    } else if (!mesh.normals.empty()) {
        out["normals"] = write_vectors(mesh.normals);
    }
    if (!mesh.uv[0].empty()) out["uv"] = write_vectors(mesh.uv[0]);
    if (!mesh.uv[1].empty()) out["uv1"] = write_vectors(mesh.uv[1]);
    if (!mesh.colors.empty()) out["colors"] = write_vectors(mesh.colors);
    return out;
}

}  // namespace aleph
