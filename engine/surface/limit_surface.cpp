#include "engine/surface/limit_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/color.h"
#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/scene/points.h"
#include "engine/surface/cage_checks.h"
#include "engine/surface/grid.h"
#include "engine/surface/patches.h"
#include "engine/surface/topology.h"

namespace aleph {

namespace {

struct SurfaceVertex {
    LimitSample position, normal;
    LimitLocation normal_location;
};

struct Part {
    std::vector<SurfaceVertex> vertices;
    std::vector<GridTriangle> triangles;
    std::vector<glm::uvec3> corners;
    std::vector<glm::vec2> uv;
};

/// Unit, or 0 where the tangents are parallel or nothing.
glm::dvec3 normal_of(const Tangents& tangents) {
    const double longest = std::max(glm::length(tangents.ds), glm::length(tangents.dt));
    if (!(longest > 0.0)) return glm::dvec3(0.0);
    const glm::dvec3 normal = glm::cross(tangents.ds / longest, tangents.dt / longest);
    const double length = glm::length(normal);
    return length > 1e-9 ? normal / length : glm::dvec3(0.0);
}

}  // namespace

struct LimitSurface::State {
    std::unique_ptr<Far::TopologyRefiner> refiner;
    std::unique_ptr<LimitPatches> patches;
    int level = 0;
    FaceGrid faces;
    std::vector<Part> parts;

    const Part& part(int index) const {
        ALEPH_CHECK(index >= 0 && static_cast<std::size_t>(index) < parts.size(),
                    fmt::format("part {} of {}", index, parts.size()));
        return parts[index];
    }

    glm::dvec3 compute_normal(std::span<const glm::dvec3> control, const SurfaceVertex& vertex) const {
        glm::dvec3 normal = normal_of(patches->tangents(control, vertex.normal));
        // Where the tangents fail (a degenerate cage, a point between two faces) the surface close by says which way is
        // out.
        const double centre = faces.triangular ? 1.0 / 3.0 : 0.5;
        const LimitLocation& at = vertex.normal_location;
        for (double step = 1.0 / 1024.0; step <= 1.0 && normal == glm::dvec3(0.0); step *= 32.0) {
            Tangents tangents;
            patches->evaluate(control, at.face, at.s + step * (centre - at.s), at.t + step * (centre - at.t),
                              &tangents);
            normal = normal_of(tangents);
        }
        return normal == glm::dvec3(0.0) ? glm::dvec3(0.0, 1.0, 0.0) : normal;
    }
};

LimitSurface::LimitSurface(const Cage& cage, std::size_t cage_points, int level) : state_(std::make_unique<State>()) {
    if (level < 0 || level > max_subdivision_level) {
        throw InputError("", "cage " + printable(cage.name),
                         fmt::format("level {} is not within 0 to {}", level, max_subdivision_level));
    }
    State& state = *state_;
    state.refiner = make_refiner(cage, cage_points);
    SurfaceGrid grid = make_surface_grid(cage, *state.refiner, level);
    state.level = grid.level;
    state.faces = std::move(grid.faces);
    state.patches = std::make_unique<LimitPatches>(*state.refiner, measure_crowding(cage, cage_points));
    for (PartGrid& from : grid.parts) {
        Part& part = state.parts.emplace_back();
        part.triangles = std::move(from.triangles);
        part.corners = std::move(from.corners);
        part.vertices.reserve(from.vertices.size());
        std::vector<LimitLocation> uv;
        for (const GridVertex& vertex : from.vertices) {
            const LimitSample position = state.patches->make_sample(vertex.position);
            part.vertices.push_back(
                {position, vertex.normal == vertex.position ? position : state.patches->make_sample(vertex.normal),
                 vertex.normal});
            uv.push_back(vertex.uv);
        }
        if (!cage.faces.uv.empty()) part.uv = state.patches->evaluate_uv(cage.uv, uv);
    }
    state.patches->finish_samples();
}

LimitSurface::~LimitSurface() = default;

int LimitSurface::level() const {
    return state_->level;
}

int LimitSurface::part_count() const {
    return static_cast<int>(state_->parts.size());
}

const std::vector<glm::uvec3>& LimitSurface::triangles(int part) const {
    return state_->part(part).corners;
}

std::vector<glm::dvec3> LimitSurface::make_control_points(std::span<const glm::dvec3> cage_points) const {
    return state_->patches->make_control_points(cage_points);
}

void LimitSurface::evaluate_vertices(int part, std::span<const glm::dvec3> control, std::vector<glm::dvec3>& positions,
                                     std::vector<glm::vec3>& normals) const {
    const std::vector<SurfaceVertex>& vertices = state_->part(part).vertices;
    positions.resize(vertices.size());
    normals.resize(vertices.size());
    constexpr std::size_t vertices_per_chunk = 4096;
    parallel_each(vertices.size(), vertices_per_chunk, [&](std::size_t i) {
        positions[i] = state_->patches->position(control, vertices[i].position);
        normals[i] = glm::vec3(state_->compute_normal(control, vertices[i]));
    });
}

glm::dvec3 LimitSurface::evaluate(int part, std::span<const glm::dvec3> control, int primitive, double u,
                                  double v) const {
    const std::vector<GridTriangle>& triangles = state_->part(part).triangles;
    ALEPH_CHECK(primitive >= 0 && static_cast<std::size_t>(primitive) < triangles.size(),
                fmt::format("triangle {} of {}", primitive, triangles.size()));
    ALEPH_CHECK(!std::isnan(u) && !std::isnan(v), fmt::format("({}, {})", u, v));
    u = std::clamp(u, 0.0, 1.0);
    v = std::clamp(v, 0.0, 1.0 - u);
    const GridTriangle& triangle = triangles[primitive];
    glm::ivec2 corners[3];
    state_->faces.find_corners(triangle, corners);
    const glm::dvec2 place =
        (1.0 - u - v) * glm::dvec2(corners[0]) + u * glm::dvec2(corners[1]) + v * glm::dvec2(corners[2]);
    const glm::dvec2 st = place / static_cast<double>(state_->faces.cells[triangle.face]);
    return state_->patches->evaluate(control, triangle.face, st.x, st.y);
}

Mesh LimitSurface::make_mesh(int part, std::span<const glm::dvec3> control) const {
    Mesh mesh;
    std::vector<glm::dvec3> positions;
    evaluate_vertices(part, control, positions, mesh.normals);
    mesh.positions.assign(positions.begin(), positions.end());
    mesh.uv[0] = state_->part(part).uv;
    mesh.triangles = state_->part(part).corners;
    mesh.subdivision.part = part;
    return mesh;
}

namespace {

const PointCache& find_points(const Scene& scene, const Cage& cage) {
    const auto require = [&](bool holds, const char* reason) {
        if (!holds) throw InputError(scene.source.file, "cage " + printable(cage.name), reason);
    };
    require(cage.points >= 0 && cage.points < std::ssize(scene.point_caches), "it has no points");
    const PointCache& cache = scene.point_caches[cage.points];
    require(!cache.positions.empty(), "it has no points");
    for (const auto& sample : cache.positions) {
        require(sample.size() == cache.point_count(), "its number of points changes");
        for (const glm::vec3& p : sample) require(is_finite(p), "one of its points is not finite");
    }
    return cache;
}

}  // namespace

void tessellate_cage(Scene& scene, int cage_index) {
    const Cage& cage = scene.cages[cage_index];
    const PointCache& cache = find_points(scene, cage);
    std::shared_ptr<const LimitSurface> surface;
    try {
        surface = std::make_shared<const LimitSurface>(cage, cache.point_count(), cage.level);
    } catch (const InputError& error) {
        throw InputError(scene.source.file, error.place(), error.reason());
    }
    for (const Mesh& mesh : scene.meshes) {
        const auto& [used, part, limit] = mesh.subdivision;
        if (used != cage_index || (part >= 0 && part < surface->part_count())) continue;
        throw InputError(scene.source.file, "mesh " + printable(mesh.name),
                         fmt::format("cage {} has no faces for part {}", printable(cage.name), part));
    }
    std::vector<std::string>& warnings = scene.source.warnings;
    for (const std::string& warning : list_warnings(cage))
        if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
    const std::vector<glm::dvec3> first(cache.positions.front().begin(), cache.positions.front().end());
    const std::vector<glm::dvec3> control = surface->make_control_points(first);
    for (Mesh& mesh : scene.meshes) {
        if (mesh.subdivision.cage != cage_index) continue;
        Mesh made = surface->make_mesh(mesh.subdivision.part, control);
        mesh.positions = std::move(made.positions);
        mesh.normals = std::move(made.normals);
        mesh.uv[0] = std::move(made.uv[0]);
        mesh.triangles = std::move(made.triangles);
        mesh.subdivision.limit.surface = surface;
    }
}

}  // namespace aleph
