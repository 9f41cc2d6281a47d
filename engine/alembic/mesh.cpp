// Polygon meshes: triangles with vertices where point, normal or texture coordinate differ.

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>

#include "engine/alembic/polygons.h"
#include "engine/alembic/surface.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

constexpr std::uint64_t polygon_effort = 20'000'000;  // point-in-triangle tests for one surface, about 0.1 s

/// Normals of a surface over a run: one sample, or several under a sampling of their own.
struct RunNormals {
    GeometryScope scope = GeometryScope::constant;
    TimeSampling sampling;
    std::vector<ParameterSample> samples;
    bool fixed_indices = false;  ///< indices do not change: corners that share a value share it at all times
};

/// The surface of one topology, ready to be cut into meshes.
struct RunSurface {
    const SurfaceRun& run;
    const std::vector<glm::vec3>& points;  ///< first sample
    std::optional<RunNormals> normals{};
    std::optional<ParameterSample> uv{};
    GeometryScope uv_scope = GeometryScope::constant;
    bool clockwise = true;  ///< faces as stored

    std::span<const int> face(std::size_t f) const {
        return {run.face_points.data() + run.first_corner[f], static_cast<std::size_t>(run.face_counts[f])};
    }
};

std::optional<RunNormals> read_normals(AlembicReader& reader, int object, const AlembicCompound& geom,
                                       const SurfaceRun& run, bool single_run) {
    const auto parameter = find_parameter(reader.archive, geom, "N", 3);
    if (!parameter) return std::nullopt;
    RunNormals normals;
    normals.scope = parameter->scope;
    normals.fixed_indices = parameter->indices && parameter->indices->is_constant();
    std::vector<double> times{run.begin};
    if (!is_constant(*parameter)) {
        // Under their own times; where the topology changes, under those of this topology's points.
        const AlembicProperty& timed = parameter->values.is_constant() ? *parameter->indices : parameter->values;
        reader.widen(timed);
        if (single_run) {
            const AlembicSamples own = reader.archive.samples(timed);
            normals.sampling = own.sampling;
            times.clear();
            for (std::size_t i = 0; i < own.indices.size(); ++i) times.push_back(own.time(i));
        } else if (run.point_samples.size() > 1) {
            normals.sampling = run.sampling;
            times = run.sampling.times;
        }
    }
    for (const double seconds : times) {
        auto sample = read_fitting(reader, object, *parameter, run, seconds, "its normals");
        if (!sample) return std::nullopt;
        normals.samples.push_back(std::move(*sample));
    }
    return normals;
}

std::vector<glm::vec3> face_positions(const RunSurface& surface, std::size_t face) {
    std::vector<glm::vec3> positions;
    for (const int point : surface.face(face)) positions.push_back(surface.points[point]);
    return positions;
}

glm::vec3 normal_at(const ParameterSample& sample, std::size_t item) {
    const float* n = sample.at(item);
    return {n[0], n[1], n[2]};
}

/// Faces of archives are clockwise by convention. Where there are normals they tell: most of them decide.
bool are_faces_clockwise(const RunSurface& surface) {
    if (!surface.normals) return true;
    std::int64_t clockwise = 0;
    for (std::size_t f = 0; f < surface.run.face_counts.size(); ++f) {
        if (surface.run.face_counts[f] < 3) continue;
        const glm::dvec3 normal = polygon_normal(face_positions(surface, f));
        const std::size_t item = scope_item(surface.normals->scope, surface.run, f, surface.run.first_corner[f]);
        const double side = glm::dot(normal, glm::dvec3(normal_at(surface.normals->samples.front(), item)));
        clockwise += side < 0.0 ? 1 : side > 0.0 ? -1 : 0;
    }
    return clockwise >= 0;
}

/// A corner, and what makes it one vertex with others.
struct CornerKey {
    std::array<std::uint32_t, 6> value{};
    std::uint32_t face = 0, corner = 0;

    auto operator<=>(const CornerKey&) const = default;
};

CornerKey make_key(const RunSurface& surface, std::size_t face, std::size_t corner) {
    CornerKey key;
    key.face = static_cast<std::uint32_t>(face);
    key.corner = static_cast<std::uint32_t>(corner);
    key.value[0] = static_cast<std::uint32_t>(surface.run.face_points[corner]);
    if (surface.normals) {
        const RunNormals& normals = *surface.normals;
        const std::size_t item = scope_item(normals.scope, surface.run, face, corner);
        const ParameterSample& first = normals.samples.front();
        if (normals.samples.size() == 1) {
            for (int k = 0; k < 3; ++k) key.value[1 + k] = std::bit_cast<std::uint32_t>(first.at(item)[k]);
        } else {
            key.value[1] = static_cast<std::uint32_t>(normals.fixed_indices ? first.element(item) : item);
        }
    }
    if (surface.uv) {
        const float* uv = surface.uv->at(scope_item(surface.uv_scope, surface.run, face, corner));
        for (int k = 0; k < 2; ++k) key.value[4 + k] = std::bit_cast<std::uint32_t>(uv[k]);
    }
    return key;
}

/// @param vertices  one corner of each
std::vector<glm::vec3> vertex_normals(const RunSurface& surface, const ParameterSample& sample,
                                      const std::vector<CornerKey>& vertices) {
    std::vector<glm::vec3> normals;
    normals.reserve(vertices.size());
    for (const CornerKey& key : vertices) {
        const std::size_t item = scope_item(surface.normals->scope, surface.run, key.face, key.corner);
        glm::vec3 normal = safe_normalize(normal_at(sample, item));
        if (normal == glm::vec3(0.0f)) {  // none was given: the face's own
            const glm::dvec3 own = polygon_normal(face_positions(surface, key.face));
            normal = glm::vec3(safe_normalize(surface.clockwise ? -own : own));
        }
        normals.push_back(normal == glm::vec3(0.0f) ? glm::vec3(0.0f, 1.0f, 0.0f) : normal);
    }
    return normals;
}

/// Cuts a surface into meshes, one for each part.
class SurfaceCutter {
  public:
    /// @param effort  for all polygons of the object (triangulate_polygon)
    SurfaceCutter(AlembicReader& reader, int object, const RunSurface& surface, std::uint64_t& effort)
        : reader_(reader),
          object_(object),
          surface_(surface),
          effort_(effort),
          vertex_of_(surface.run.corner_count()) {}

    Mesh cut(const std::vector<std::size_t>& faces) {
        Mesh mesh;
        mesh.name = reader_.archive.objects()[object_].name;
        mesh.deformation.points = surface_.run.points;
        mesh.present = surface_.run.present;
        add_vertices(find_vertices(faces), mesh);
        for (const std::size_t face : faces) add_triangles(face, mesh);
        return mesh;
    }

  private:
    /// One corner of each vertex; numbers the corners' vertices in vertex_of_.
    std::vector<CornerKey> find_vertices(const std::vector<std::size_t>& faces) {
        std::vector<CornerKey> keys;
        std::size_t corners = 0;
        for (const std::size_t f : faces) corners += surface_.face(f).size();
        reader_.archive.budget().charge(corners, 2 * sizeof(CornerKey) + 100);
        keys.reserve(corners);
        for (const std::size_t f : faces) {
            for (std::size_t i = 0; i < surface_.face(f).size(); ++i)
                keys.push_back(make_key(surface_, f, surface_.run.first_corner[f] + i));
        }
        std::ranges::sort(keys);
        std::vector<CornerKey> vertices;
        for (const CornerKey& key : keys) {
            if (vertices.empty() || vertices.back().value != key.value) vertices.push_back(key);
            vertex_of_[key.corner] = static_cast<std::uint32_t>(vertices.size() - 1);
        }
        return vertices;
    }

    void add_vertices(const std::vector<CornerKey>& vertices, Mesh& mesh) {
        for (const CornerKey& key : vertices) {
            mesh.deformation.vertex_points.push_back(key.value[0]);
            mesh.positions.push_back(surface_.points[key.value[0]]);
            if (!surface_.uv) continue;
            const float* uv = surface_.uv->at(scope_item(surface_.uv_scope, surface_.run, key.face, key.corner));
            mesh.uv[0].emplace_back(uv[0], 1.0f - uv[1]);
        }
        if (!surface_.normals) return;
        const RunNormals& normals = *surface_.normals;
        mesh.normals = vertex_normals(surface_, normals.samples.front(), vertices);
        if (normals.samples.size() == 1) return;
        reader_.archive.budget().charge(normals.samples.size() * vertices.size(), sizeof(glm::vec3));
        mesh.deformation.normal_sampling = normals.sampling;
        for (const ParameterSample& sample : normals.samples)
            mesh.deformation.normal_samples.push_back(vertex_normals(surface_, sample, vertices));
    }

    void add_triangles(std::size_t face, Mesh& mesh) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        if (!triangulate_polygon(face_positions(surface_, face), effort_, triangles))
            reader_.warn(object_, "a face crosses itself or is too intricate; it is cut into a fan of triangles");
        const std::size_t first = surface_.run.first_corner[face];
        for (auto [a, b, c] : triangles) {
            if (surface_.clockwise) std::swap(b, c);
            mesh.triangles.emplace_back(vertex_of_[first + a], vertex_of_[first + b], vertex_of_[first + c]);
        }
    }

    AlembicReader& reader_;
    int object_;
    const RunSurface& surface_;
    std::uint64_t& effort_;
    std::vector<std::uint32_t> vertex_of_;  ///< per corner of the surface
};

/// Returns whether the surface has this one topology throughout: then samples of its other properties are all of it.
bool keeps_topology(const SurfaceRun& run) {
    return !is_animated(run.present);
}

}  // namespace

std::vector<int> read_polygon_mesh(AlembicReader& reader, int object, const AlembicCompound& top,
                                   const AlembicCompound& geom) {
    const std::vector<SurfaceRun> runs = read_runs(reader, object, geom);
    const auto uv = find_parameter(reader.archive, geom, "uv", 2);
    std::vector<int> meshes;
    std::uint64_t effort = polygon_effort;
    for (const SurfaceRun& run : runs) {
        RunSurface surface{.run = run,
                           .points = reader.part.point_caches[run.points].positions.front(),
                           .normals = read_normals(reader, object, geom, run, keeps_topology(run))};
        if (uv) {
            surface.uv = read_fitting(reader, object, *uv, run, run.begin, "its texture coordinates");
            surface.uv_scope = uv->scope;
            if (!is_constant(*uv) && keeps_topology(run))
                reader.warn(object, "its texture coordinates change over time; their first state is used");
        }
        const SurfaceParts parts = read_parts(reader, object, top, run);
        surface.clockwise = are_faces_clockwise(surface);
        std::vector<std::vector<std::size_t>> faces(parts.materials.size());
        for (std::size_t f = 0; f < run.face_counts.size(); ++f) {
            if (run.face_counts[f] >= 3) {
                faces[parts.face_parts[f]].push_back(f);
            } else {
                reader.warn(object, "faces of fewer than 3 points are left out");
            }
        }
        SurfaceCutter cutter(reader, object, surface, effort);
        for (std::size_t part = 0; part < faces.size(); ++part) {
            if (faces[part].empty()) continue;
            Mesh mesh = cutter.cut(faces[part]);
            mesh.material = parts.materials[part];
            meshes.push_back(append(reader.part.meshes, std::move(mesh)));
        }
    }
    return meshes;
}

}  // namespace aleph
