// Meshes of a scene file: shapes, lists of triangles, parts of cages; and their points.

#include <fmt/format.h>

#include <algorithm>

#include "engine/scene_file/lists.h"
#include "engine/scene_file/reader.h"
#include "engine/scene_file/tracks.h"
#include "engine/surface/cage_checks.h"
#include "engine/surface/shapes.h"

namespace aleph {

namespace {

/// Refuses keys that this kind of shape does not have. They would have no effect.
void check_shape_keys(const JsonRef& at, const char* kind, const std::vector<std::string>& known) {
    for (const auto& member : at.json().items()) {
        if (member.key() == "type" || std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
        at.require(member.key()).fail(fmt::format("a {} has no \"{}\"", kind, member.key()));
    }
}

Shape read_shape(const JsonRef& at, Shape::Kind kind) {
    Shape shape{.kind = kind};
    const std::size_t index = index_of(kind);
    check_shape_keys(at, shape_words[index], shape_keys[index]);
    if (const auto value = at.find("size")) {
        const bool flat = kind == Shape::Kind::quad;
        if (value->array_size() != (flat ? 2u : 3u)) {
            value->fail(flat ? "the size of a quad is 2 numbers" : "the size of a box is 3 numbers");
        }
        shape.size = flat ? glm::dvec3(read_dvec2(*value), 1.0) : read_dvec3(*value);
    }
    for (const auto& field : shape_numbers) {
        if (const auto value = at.find(field.key)) field.in(shape) = value->number();
    }
    for_each_element(at, "profile",
                     [&](const JsonRef& point, std::size_t) { shape.profile.push_back(read_dvec2(point)); });
    if (const auto value = at.find("smooth")) shape.smooth = value->boolean();
    if (const auto value = at.find("uv_scale")) shape.uv_scale = read_dvec2(*value);
    shape.segments =
        static_cast<int>(at.find_integer("segments", min_shape_segments, max_shape_segments).value_or(shape.segments));
    validate(shape, at.file(), at.pointer());
    return shape;
}

/// Samples of points or normals over time. All samples have the same number.
TimeSampling read_point_samples(const JsonRef& at, const FrameRate& rate,
                                std::vector<std::vector<glm::vec3>>& samples) {
    return read_samples(at, rate, [&](const JsonRef& value) {
        samples.push_back(read_vectors<glm::vec3>(value));
        if (samples.back().size() != samples.front().size()) {
            value.fail(fmt::format("has {} points, the first key has {}: their number cannot change",
                                   samples.back().size(), samples.front().size()));
        }
    });
}

void expect_count(const JsonRef& at, std::size_t found, std::size_t vertices, const char* kind) {
    if (found != vertices) {
        at.fail(fmt::format("has {} {} for {} vertices: one for each was expected", found, kind, vertices));
    }
}

/// Deformation::points, vertex_points and positions.
void read_vertices(SceneReader& reader, const JsonRef& at, Mesh& mesh) {
    const auto positions = at.find("positions"), points = at.find("points"), map = at.find("vertex_points");
    const bool keyed = positions && positions->json().is_object();
    if (!positions && !points) at.fail("a mesh needs \"positions\", or \"points\" with a name from the scene's points");
    if (keyed && points) positions->fail("keyed positions already are points over time: leave out \"points\"");
    if (points) mesh.deformation.points = reader.names.points.require(*points);
    if (keyed) mesh.deformation.points = add_points(reader, *positions, reader.names.points.unused(mesh.name));
    if (positions && !keyed) mesh.positions = read_vectors<glm::vec3>(*positions);
    if (mesh.deformation.points == no_index) {
        if (map) map->fail("\"vertex_points\" goes with \"points\" or keyed positions");
        return;
    }
    const PointCache& cache = reader.scene.point_caches[mesh.deformation.points];
    if (map) {
        for (const int point : read_indices(*map, 1, cache.point_count(), "point")) {
            mesh.deformation.vertex_points.push_back(static_cast<std::uint32_t>(point));
        }
        if (mesh.deformation.vertex_points.empty())
            map->fail("is empty; leave it out if each vertex is the point of the same number");
    }
    const std::vector<glm::vec3> first = first_positions(mesh, cache);
    if (positions && !keyed) {
        expect_count(*positions, mesh.positions.size(), first.size(), "positions");
    } else {
        mesh.positions = first;
    }
}

void read_triangles(SceneReader& reader, const JsonRef& at, Mesh& mesh) {
    check_shape_keys(at, "mesh", mesh_keys);
    read_vertices(reader, at, mesh);
    const std::size_t vertices = mesh.positions.size();
    const std::vector<int> indices = read_indices(at.require("triangles"), 3, vertices, "vertex");
    mesh.triangles.reserve(indices.size() / 3);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        mesh.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }
    if (const auto normals = at.find("normals")) {
        if (normals->json().is_array()) {
            mesh.normals = read_vectors<glm::vec3>(*normals);
        } else {
            if (mesh.deformation.points == no_index) normals->fail("normals over time go with points over time");
            mesh.deformation.normal_sampling =
                read_point_samples(*normals, reader.scene.film.frame_rate, mesh.deformation.normal_samples);
            mesh.normals = mesh.deformation.normal_samples.front();
        }
        expect_count(*normals, mesh.normals.size(), vertices, "normals");
    }
    for (int set = 0; set < 2; ++set) {
        const auto uv = at.find(set == 0 ? "uv" : "uv1");
        if (!uv) continue;
        mesh.uv[set] = read_vectors<glm::vec2>(*uv);
        expect_count(*uv, mesh.uv[set].size(), vertices, "texture coordinates");
    }
    if (const auto colors = at.find("colors")) {
        mesh.colors = read_vectors<glm::vec4>(*colors);
        expect_count(*colors, mesh.colors.size(), vertices, "colors");
    }
}

// Bytes per triangle with its share of vertices; for cages with OpenSubdiv's tables.
constexpr std::size_t shape_triangle_bytes = 28, cage_triangle_bytes = 200;
constexpr std::size_t mesh_bytes = sizeof(Mesh) + 1000;

}  // namespace

int add_points(SceneReader& reader, const JsonRef& at, const std::string& name) {
    PointCache cache;
    cache.name = name;
    if (at.json().is_array()) {
        cache.positions.push_back(read_vectors<glm::vec3>(at));
    } else {
        cache.sampling = read_point_samples(at, reader.scene.film.frame_rate, cache.positions);
    }
    if (cache.point_count() == 0) at.fail("has no points");
    return SceneReader::add(std::move(cache), reader.scene.point_caches, reader.names.points);
}

std::vector<glm::vec3> first_positions(const Mesh& mesh, const PointCache& cache) {
    const std::vector<glm::vec3>& points = cache.positions.front();
    if (mesh.deformation.vertex_points.empty()) return points;
    std::vector<glm::vec3> positions;
    positions.reserve(mesh.deformation.vertex_points.size());
    for (const std::uint32_t point : mesh.deformation.vertex_points) positions.push_back(points.at(point));
    return positions;
}

int read_mesh(SceneReader& reader, const JsonRef& at, const std::optional<JsonRef>& material,
              const std::optional<JsonRef>& present, const std::string& name) {
    reader.charge(mesh_bytes, at, "let nodes share meshes");
    Mesh mesh;
    mesh.name = name;
    const JsonRef type = at.require("type");
    if (type.string() == "mesh") {
        read_triangles(reader, at, mesh);
    } else if (type.string() == "cage") {
        check_shape_keys(at, "cage", {"cage", "part"});
        mesh.subdivision.cage = read_use(reader, at.require("cage"), reader.names.cages, name, add_cage);
        const Cage& used = reader.scene.cages[mesh.subdivision.cage];
        mesh.subdivision.part = static_cast<int>(at.find_integer("part", 0, count_parts(used) - 1).value_or(0));
        reader.charge(cage_triangle_bytes * count_triangles(used, std::max(used.level, 1)), at,
                      "lower the cage's \"level\"");
    } else {
        mesh.shape = read_shape(at, read_word<Shape::Kind>(type, shape_words));
        reader.charge(shape_triangle_bytes * shape_triangle_count(*mesh.shape), at, "lower \"segments\"");
    }
    if (material) mesh.material = read_use(reader, *material, reader.names.materials, name, add_material);
    if (present) mesh.present = read_visibility(*present, reader.scene.film.frame_rate);
    return SceneReader::add(std::move(mesh), reader.scene.meshes, reader.names.meshes);
}

void make_meshes(SceneReader& reader) {
    for (Mesh& mesh : reader.scene.meshes) {
        if (!mesh.shape) continue;
        Mesh made = make_shape_mesh(*mesh.shape, mesh.material, mesh.name);
        made.present = std::move(mesh.present);
        mesh = std::move(made);
    }
    make_cage_meshes(reader);
}

}  // namespace aleph
