// Subdivision cages of a scene file.

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/scene_file/lists.h"
#include "engine/scene_file/reader.h"
#include "engine/scene_file/tracks.h"
#include "engine/surface/cage_checks.h"
#include "engine/surface/limit_surface.h"

namespace aleph {

namespace {

/// The points that the cage names under "points" or holds under "positions".
int read_cage_points(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const auto positions = at.find("positions"), points = at.find("points");
    if (positions.has_value() == points.has_value()) {
        at.fail("expected either \"positions\" or \"points\" with a name from the scene's points");
    }
    return points ? reader.names.points.require(*points)
                  : add_points(reader, *positions, reader.names.points.unused(name));
}

void read_faces(const JsonRef& at, std::size_t points, Cage& cage) {
    for (const JsonRef face : at.elements()) {
        const std::vector<int> indices = read_indices(face, 1, points, "point");
        if (indices.size() < 3) face.fail(fmt::format("has {} points; a face has at least 3", indices.size()));
        cage.faces.sizes.push_back(static_cast<int>(indices.size()));
        cage.faces.points.insert(cage.faces.points.end(), indices.begin(), indices.end());
    }
}

void read_uv(const JsonRef& at, Cage& cage) {
    const auto uv = at.find("uv"), faces = at.find("face_uv");
    if (faces && !uv) faces->fail("\"face_uv\" numbers the entries of \"uv\", which is missing");
    if (!uv) return;
    cage.uv = read_vectors<glm::vec2>(*uv);
    if (!faces) {
        const int max_point = *std::max_element(cage.faces.points.begin(), cage.faces.points.end());
        if (max_point >= std::ssize(cage.uv)) {
            uv->fail(
                fmt::format("has {} texture coordinates, but faces name point {}: one for each point was "
                            "expected, or \"face_uv\"",
                            cage.uv.size(), max_point));
        }
        cage.faces.uv = cage.faces.points;
        return;
    }
    if (faces->array_size() != cage.faces.sizes.size()) {
        faces->fail(fmt::format("has {} lists for {} faces", faces->array_size(), cage.faces.sizes.size()));
    }
    for (std::size_t i = 0; i < faces->array_size(); ++i) {
        const JsonRef face = (*faces)[i];
        const std::vector<int> indices = read_indices(face, 1, cage.uv.size(), "texture coordinate");
        if (std::ssize(indices) != cage.faces.sizes[i]) {
            face.fail(
                fmt::format("has {} texture coordinates for a face of {} points", indices.size(), cage.faces.sizes[i]));
        }
        cage.faces.uv.insert(cage.faces.uv.end(), indices.begin(), indices.end());
    }
}

void read_sharp_parts(const JsonRef& at, std::size_t points, Cage& cage) {
    for_each_element(at, "creases", [&](const JsonRef& crease, std::size_t) {
        const std::vector<int> indices = read_indices(crease.require("points"), 1, points, "point");
        cage.creases.lengths.push_back(static_cast<int>(indices.size()));
        cage.creases.points.insert(cage.creases.points.end(), indices.begin(), indices.end());
        cage.creases.sharpness.push_back(static_cast<float>(crease.require("sharpness").number()));
    });
    for_each_element(at, "corners", [&](const JsonRef& corner, std::size_t) {
        cage.corners.points.push_back(read_index(corner.require("point"), points, "point"));
        cage.corners.sharpness.push_back(static_cast<float>(corner.require("sharpness").number()));
    });
}

}  // namespace

int add_cage(SceneReader& reader, const JsonRef& at, const std::string& name) {
    if (reader.scene.cages.size() >= max_scene_cages) {
        at.fail(fmt::format("more than {} cages; join some and separate them by \"parts\"", max_scene_cages));
    }
    Cage cage;
    cage.name = name;
    if (const auto word = at.find("scheme")) cage.scheme = read_word<Cage::Scheme>(*word, scheme_words);
    if (const auto word = at.find("boundary")) cage.boundary = read_word<Cage::Boundary>(*word, boundary_words);
    if (const auto word = at.find("uv_rule")) cage.uv_rule = read_word<Cage::UvRule>(*word, uv_rule_words);
    cage.points = read_cage_points(reader, at, name);
    const std::size_t points = reader.scene.point_caches[cage.points].point_count();
    read_faces(at.require("faces"), points, cage);
    read_sharp_parts(at, points, cage);
    read_uv(at, cage);
    const std::size_t count = cage.faces.sizes.size();
    if (const auto holes = at.find("holes")) cage.faces.holes = read_indices(*holes, 1, count, "face");
    if (const auto parts = at.find("parts")) {
        cage.faces.parts = read_indices(*parts, 1, count, "part");
        if (cage.faces.parts.size() != count) {
            parts->fail(fmt::format("has {} numbers for {} faces", cage.faces.parts.size(), count));
        }
    }
    cage.level = static_cast<int>(at.find_integer("level", 0, max_subdivision_level).value_or(cage.level));
    cage.max_level = static_cast<int>(at.find_integer("max_level", 0, max_subdivision_level).value_or(cage.max_level));
    if (cage.max_level < cage.level) {
        at.fail(fmt::format("\"max_level\" ({}) is below \"level\" ({})", cage.max_level, cage.level));
    }
    try {
        validate(cage, points);
    } catch (const InputError& error) {
        at.fail(error.reason());
    }
    reader.cage_places.push_back(at.pointer());
    return SceneReader::add(std::move(cage), reader.scene.cages, reader.names.cages);
}

void make_cage_meshes(SceneReader& reader) {
    for (std::size_t i = 0; i < reader.scene.cages.size(); ++i) {
        try {
            tessellate_cage(reader.scene, static_cast<int>(i));
        } catch (const InputError& error) {
            throw InputError(reader.file, reader.cage_places[i], error.reason());
        }
    }
}

}  // namespace aleph
