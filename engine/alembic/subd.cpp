// Subdivision surfaces: cages with creases, corners, holes and texture coordinates.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "engine/alembic/surface.h"
#include "engine/base/errors.h"
#include "engine/surface/limit_surface.h"

namespace aleph {
namespace {

constexpr std::uint64_t bytes_per_face = 1024;  // memory of refinement, about
constexpr std::size_t many_faces = 30000;       // a finer cage begins at level 1

/// An optional property's numbers at a time; empty where it is missing.
template <class T>
std::vector<T> read_optional(const AlembicReader& reader, const AlembicCompound& geom, const char* name,
                             double seconds) {
    const AlembicProperty* property = geom.find_sampled(name);
    if (property == nullptr) return {};
    return reader.archive.numbers<T>(*property, sample_at(reader.archive, *property, seconds));
}

int read_rule(const AlembicReader& reader, const AlembicCompound& geom, const char* name, double seconds) {
    const std::vector<int> values = read_optional<int>(reader, geom, name, seconds);
    return values.empty() ? 0 : values.front();
}

Cage::Scheme read_scheme(AlembicReader& reader, int object, const AlembicCompound& geom) {
    const std::string name = read_text(reader, geom, ".scheme");
    if (name == "loop") return Cage::Scheme::loop;
    if (name == "bilinear") return Cage::Scheme::bilinear;
    if (!name.empty() && name != "catmull-clark")
        reader.warn(object, fmt::format("the scheme \"{}\" is unknown; catmull-clark is used", printable(name)));
    return Cage::Scheme::catmull_clark;
}

Cage::Boundary read_boundary(AlembicReader& reader, int object, const AlembicCompound& geom, double seconds) {
    constexpr std::array rules{Cage::Boundary::none, Cage::Boundary::edge_and_corner, Cage::Boundary::edge_only};
    const int rule = read_rule(reader, geom, ".interpolateBoundary", seconds);
    if (rule >= 0 && rule < std::ssize(rules)) return rules[rule];
    reader.warn(object, "its boundary rule is unknown; edges and corners are kept");
    return Cage::Boundary::edge_and_corner;
}

/// RenderMan's numbers as OpenSubdiv's rules.
Cage::UvRule read_uv_rule(const AlembicReader& reader, const AlembicCompound& geom, double seconds) {
    const bool propagate = read_rule(reader, geom, ".faceVaryingPropagateCorners", seconds) != 0;
    switch (read_rule(reader, geom, ".faceVaryingInterpolateBoundary", seconds)) {
        case 1:
            return propagate ? Cage::UvRule::linear_corners_plus2 : Cage::UvRule::linear_corners_plus1;
        case 2:
            return Cage::UvRule::linear_none;
        case 3:
            return Cage::UvRule::linear_boundaries;
        default:
            return Cage::UvRule::linear_all;
    }
}

/// Corners of a face counter-clockwise: the first stays, the others come backwards.
std::size_t turned(const SurfaceRun& run, std::size_t face, int i) {
    return run.first_corner[face] + (i == 0 ? 0 : run.face_counts[face] - i);
}

void add_uv(AlembicReader& reader, int object, const AlembicCompound& geom, const SurfaceRun& run, Cage& cage) {
    const auto parameter = find_parameter(reader.archive, geom, "uv", 2);
    if (!parameter) return;
    const auto sample = read_fitting(reader, object, *parameter, run, run.begin, "its texture coordinates");
    if (!sample) return;
    if (!is_constant(*parameter))
        reader.warn(object, "its texture coordinates change over time; their first state is used");
    reader.archive.budget().charge(run.corner_count(), 100);
    // Corners that share point and coordinates are joined there; where the coordinates differ is a seam.
    std::map<std::tuple<int, float, float>, int> known;
    for (std::size_t f = 0; f < run.face_counts.size(); ++f) {
        if (run.face_counts[f] < 3) continue;
        for (int i = 0; i < run.face_counts[f]; ++i) {
            const std::size_t corner = turned(run, f, i);
            const float* uv = sample->at(scope_item(parameter->scope, run, f, corner));
            const auto [found, is_new] =
                known.try_emplace({run.face_points[corner], uv[0], uv[1]}, static_cast<int>(cage.uv.size()));
            if (is_new) cage.uv.emplace_back(uv[0], 1.0f - uv[1]);
            cage.faces.uv.push_back(found->second);
        }
    }
}

/// Faces, holes and parts; faces of fewer than 3 points are left out.
void add_faces(AlembicReader& reader, int object, const SurfaceRun& run, const SurfaceParts& parts,
               const std::vector<int>& holes, Cage& cage) {
    std::vector<int> new_number(run.face_counts.size(), -1);
    for (std::size_t f = 0; f < run.face_counts.size(); ++f) {
        if (run.face_counts[f] < 3) {
            reader.warn(object, "faces of fewer than 3 points are left out");
            continue;
        }
        new_number[f] = static_cast<int>(cage.faces.sizes.size());
        cage.faces.sizes.push_back(run.face_counts[f]);
        if (parts.materials.size() > 1) cage.faces.parts.push_back(parts.face_parts[f]);
        for (int i = 0; i < run.face_counts[f]; ++i) cage.faces.points.push_back(run.face_points[turned(run, f, i)]);
    }
    for (const int hole : holes) {
        if (hole < 0 || hole >= std::ssize(new_number)) {
            reader.warn(object, "holes are named for faces that the surface does not have");
        } else if (const int number = new_number[hole]; number >= 0) {
            cage.faces.holes.push_back(number);
        }
    }
    std::ranges::sort(cage.faces.holes);
    cage.faces.holes.erase(std::unique(cage.faces.holes.begin(), cage.faces.holes.end()), cage.faces.holes.end());
}

void warn_of_changes(AlembicReader& reader, int object, const AlembicCompound& geom) {
    for (const char* name : {".creaseIndices", ".creaseLengths", ".creaseSharpnesses", ".cornerIndices",
                             ".cornerSharpnesses", ".holes", ".interpolateBoundary"}) {
        const AlembicProperty* property = geom.find(name);
        if (property == nullptr || property->is_constant()) continue;
        reader.warn(object, "its creases, corners or holes change over time; their first state is used");
        return;
    }
}

/// Makes the triangles. Many writers leave the boundary rule at its default, with which an open surface may have no
/// face to draw: such a surface keeps its edges and corners.
void tessellate(AlembicReader& reader, int object, int number) {
    Cage& cage = reader.part.cages[number];
    try {
        try {
            tessellate_cage(reader.part, number);
        } catch (const InputError&) {
            if (cage.boundary != Cage::Boundary::none) throw;
            cage.boundary = Cage::Boundary::edge_and_corner;
            tessellate_cage(reader.part, number);
            reader.warn(object, "its boundary rule would draw nothing; edges and corners are kept");
        }
    } catch (const InputError& error) {
        reader.archive.fail(object, error.reason());
    }
}

}  // namespace

std::vector<int> read_subdivision(AlembicReader& reader, int object, const AlembicCompound& top,
                                  const AlembicCompound& geom) {
    const AlembicArchive& archive = reader.archive;
    const std::vector<SurfaceRun> runs = read_runs(reader, object, geom);
    const std::string& name = archive.objects()[object].name;
    std::vector<int> meshes;
    for (const SurfaceRun& run : runs) {
        const SurfaceParts parts = read_parts(reader, object, top, run);
        archive.budget().charge(run.face_counts.size(), bytes_per_face);
        warn_of_changes(reader, object, geom);
        Cage cage;
        cage.name = archive.path(object);
        cage.points = run.points;
        cage.scheme = read_scheme(reader, object, geom);
        cage.boundary = read_boundary(reader, object, geom, run.begin);
        cage.uv_rule = read_uv_rule(reader, geom, run.begin);
        cage.creases.points = read_optional<int>(reader, geom, ".creaseIndices", run.begin);
        cage.creases.lengths = read_optional<int>(reader, geom, ".creaseLengths", run.begin);
        cage.creases.sharpness = read_optional<float>(reader, geom, ".creaseSharpnesses", run.begin);
        cage.corners.points = read_optional<int>(reader, geom, ".cornerIndices", run.begin);
        cage.corners.sharpness = read_optional<float>(reader, geom, ".cornerSharpnesses", run.begin);
        add_faces(reader, object, run, parts, read_optional<int>(reader, geom, ".holes", run.begin), cage);
        if (cage.faces.holes.size() == cage.faces.sizes.size()) continue;  // nothing to draw, as in an empty mesh
        if (cage.faces.sizes.size() > many_faces) cage.level = 1;
        add_uv(reader, object, geom, run, cage);

        const int number = append(reader.part.cages, std::move(cage));
        for (std::size_t part = 0; part < parts.materials.size(); ++part) {
            Mesh mesh;
            mesh.name = name;
            mesh.material = parts.materials[part];
            mesh.subdivision.cage = number;
            mesh.subdivision.part = static_cast<int>(part);
            mesh.present = run.present;
            meshes.push_back(append(reader.part.meshes, std::move(mesh)));
        }
        tessellate(reader, object, number);
    }
    return meshes;
}

}  // namespace aleph
