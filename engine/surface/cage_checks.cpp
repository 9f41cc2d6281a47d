#include "engine/surface/cage_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "engine/base/errors.h"

namespace aleph {

namespace {

// Indices, and those of the points that refinement adds, are 32-bit integers.
constexpr std::size_t max_face_points = std::size_t{1} << 24;

std::uint64_t edge_key(int a, int b) {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::min(a, b))) << 32) |
           static_cast<std::uint32_t>(std::max(a, b));
}

/// Faces at every edge.
using EdgeFaces = std::unordered_map<std::uint64_t, int>;

EdgeFaces count_edge_faces(const Cage& cage) {
    EdgeFaces edges;
    edges.reserve(cage.faces.points.size());
    std::size_t begin = 0;
    for (const int size : cage.faces.sizes) {
        for (int k = 0; k < size; ++k) {
            const int a = cage.faces.points[begin + static_cast<std::size_t>(k)];
            const int b = cage.faces.points[begin + static_cast<std::size_t>((k + 1) % size)];
            ++edges[edge_key(a, b)];
        }
        begin += static_cast<std::size_t>(size);
    }
    return edges;
}

class Checker {
  public:
    Checker(const Cage& cage, std::size_t points) : cage_(cage), points_(points) {}

    void check() const {
        check_faces();
        check_holes_and_parts();
        check_creases();
        check_corners();
        check_uv();
        check_neighbourhoods();
    }

  private:
    [[noreturn]] void refuse(const std::string& reason) const {
        throw InputError("", "cage " + printable(cage_.name), reason);
    }
    bool is_point(int i) const { return i >= 0 && static_cast<std::size_t>(i) < points_; }

    void check_faces() const {
        if (cage_.faces.sizes.empty()) refuse("it has no faces");
        if (points_ > max_face_points || cage_.faces.points.size() > max_face_points) {
            refuse(fmt::format("it has {} points and {} face corners; at most {} are possible", points_,
                               cage_.faces.points.size(), max_face_points));
        }
        std::size_t begin = 0;
        for (std::size_t f = 0; f < cage_.faces.sizes.size(); ++f) {
            const int size = cage_.faces.sizes[f];
            if (size < 3) refuse(fmt::format("face {} has {} points; a face has at least 3", f, size));
            if (cage_.scheme == Cage::Scheme::loop && size != 3) {
                refuse(fmt::format("face {} has {} points; Loop subdivision takes triangles only", f, size));
            }
            const std::size_t end = begin + static_cast<std::size_t>(size);
            if (end > cage_.faces.points.size()) break;
            check_face_points(f, begin, end);
            begin = end;
        }
        std::size_t corners = 0;
        for (const int size : cage_.faces.sizes) corners += static_cast<std::size_t>(size);
        if (corners != cage_.faces.points.size()) {
            refuse(fmt::format("its faces have {} corners, but {} points are given for them", corners,
                               cage_.faces.points.size()));
        }
    }

    void check_face_points(std::size_t face, std::size_t begin, std::size_t end) const {
        std::vector<int> sorted(cage_.faces.points.begin() + static_cast<std::ptrdiff_t>(begin),
                                cage_.faces.points.begin() + static_cast<std::ptrdiff_t>(end));
        for (const int point : sorted) {
            if (!is_point(point)) refuse(fmt::format("face {} names point {} of {}", face, point, points_));
        }
        std::sort(sorted.begin(), sorted.end());
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        if (twice != sorted.end()) refuse(fmt::format("face {} names point {} twice", face, *twice));
    }

    void check_holes_and_parts() const {
        const auto faces = static_cast<int>(cage_.faces.sizes.size());
        for (const int hole : cage_.faces.holes) {
            if (hole < 0 || hole >= faces) refuse(fmt::format("hole {} is no face; there are {}", hole, faces));
        }
        if (cage_.faces.parts.empty()) return;
        if (cage_.faces.parts.size() != cage_.faces.sizes.size()) {
            refuse(fmt::format("{} faces, but parts for {}", faces, cage_.faces.parts.size()));
        }
        for (std::size_t f = 0; f < cage_.faces.parts.size(); ++f) {
            const int part = cage_.faces.parts[f];
            // No more parts than faces, so that what is allocated follows from the file's size.
            if (part < 0 || part >= faces) refuse(fmt::format("face {} belongs to part {}", f, part));
        }
    }

    void check_sharpness(const char* of, std::size_t index, float value) const {
        if (!std::isfinite(value)) refuse(fmt::format("{} {} has a sharpness that is not a finite number", of, index));
    }

    void check_creases() const {
        if (cage_.creases.lengths.size() != cage_.creases.sharpness.size()) {
            refuse(fmt::format("{} creases, but {} sharpnesses", cage_.creases.lengths.size(),
                               cage_.creases.sharpness.size()));
        }
        std::size_t total = 0;
        for (std::size_t c = 0; c < cage_.creases.lengths.size(); ++c) {
            const int length = cage_.creases.lengths[c];
            if (length < 2) refuse(fmt::format("crease {} has {} points; it needs at least 2", c, length));
            check_sharpness("crease", c, cage_.creases.sharpness[c]);
            total += static_cast<std::size_t>(length);
        }
        if (total != cage_.creases.points.size()) {
            refuse(fmt::format("its creases have {} points, but {} are given for them", total,
                               cage_.creases.points.size()));
        }
        for (const int point : cage_.creases.points) {
            if (!is_point(point)) refuse(fmt::format("a crease names point {} of {}", point, points_));
        }
    }

    void check_corners() const {
        if (cage_.corners.points.size() != cage_.corners.sharpness.size()) {
            refuse(fmt::format("{} corners, but {} sharpnesses", cage_.corners.points.size(),
                               cage_.corners.sharpness.size()));
        }
        for (std::size_t c = 0; c < cage_.corners.points.size(); ++c) {
            if (!is_point(cage_.corners.points[c])) {
                refuse(fmt::format("corner {} names point {} of {}", c, cage_.corners.points[c], points_));
            }
            check_sharpness("corner", c, cage_.corners.sharpness[c]);
        }
    }

    void check_uv() const {
        if (cage_.faces.uv.empty()) return;
        if (cage_.faces.uv.size() != cage_.faces.points.size()) {
            refuse(fmt::format("its faces have {} corners, but texture coordinates for {}", cage_.faces.points.size(),
                               cage_.faces.uv.size()));
        }
        if (cage_.uv.size() > max_face_points) refuse("it has too many texture coordinates");
        for (const int i : cage_.faces.uv) {
            if (i < 0 || static_cast<std::size_t>(i) >= cage_.uv.size()) {
                refuse(fmt::format("a face names texture coordinate {} of {}", i, cage_.uv.size()));
            }
        }
        for (std::size_t i = 0; i < cage_.uv.size(); ++i) {
            if (!std::isfinite(cage_.uv[i].x) || !std::isfinite(cage_.uv[i].y)) {
                refuse(fmt::format("texture coordinate {} is not finite", i));
            }
        }
    }

    void check_neighbourhoods() const {
        if (measure_crowding(cage_, points_) > max_crowding) {
            refuse("too many faces meet at its points, or its faces have too many sides; some hundreds are possible");
        }
        std::vector<int> edges(points_, 0);
        std::vector<std::uint8_t> inner(points_, 1), sharp(points_, 0);
        const EdgeFaces edge_faces = count_edge_faces(cage_);
        for (const auto& [key, count] : edge_faces) {
            for (const auto point :
                 {static_cast<std::size_t>(key >> 32), static_cast<std::size_t>(key & 0xffffffffu)}) {
                ++edges[point];
                if (count != 2) inner[point] = 0;
            }
        }
        for_each_crease_edge(cage_, [&](int a, int b, float sharpness) {
            if (!(sharpness > 0.0f) || !edge_faces.contains(edge_key(a, b))) return;
            sharp[a] = sharp[b] = 1;
        });
        for (std::size_t i = 0; i < points_; ++i) {
            if (edges[i] == 2 && inner[i] && sharp[i]) {
                refuse(fmt::format(
                    "point {} lies between two faces only and has a sharp edge; remove the crease or the point", i));
            }
        }
    }

    const Cage& cage_;
    std::size_t points_;
};

}  // namespace

std::size_t measure_crowding(const Cage& cage, std::size_t cage_points) {
    std::vector<std::size_t> faces(cage_points, 0);
    for (const int point : cage.faces.points) ++faces[point];
    std::size_t sum = 0;
    const auto add = [&](std::size_t neighbours) { sum += neighbours > 16 ? neighbours * neighbours : 0; };
    for (const std::size_t count : faces) add(count);
    for (const int size : cage.faces.sizes) add(static_cast<std::size_t>(size));
    return sum;
}

int count_parts(const Cage& cage) {
    return cage.faces.parts.empty() ? 1 : std::ranges::max(cage.faces.parts) + 1;
}

std::size_t count_triangles(const Cage& cage, int level) {
    std::size_t pieces = 0;  // twice the triangles at level 0, were every face a quad or a Loop triangle
    for (const int size : cage.faces.sizes) {
        pieces += cage.scheme == Cage::Scheme::loop ? 2u : static_cast<std::size_t>(size);
    }
    return pieces * (std::size_t{1} << (2 * level)) / 2;
}

void validate(const Cage& cage, std::size_t cage_points) {
    Checker(cage, cage_points).check();
}

std::vector<std::string> list_warnings(const Cage& cage) {
    std::vector<std::string> warnings;
    const std::string start = "cage " + printable(cage.name) + ": ";
    const EdgeFaces edge_faces = count_edge_faces(cage);

    std::size_t missing = 0;
    for_each_crease_edge(cage, [&](int a, int b, float) { missing += edge_faces.contains(edge_key(a, b)) ? 0u : 1u; });
    if (missing > 0)
        warnings.push_back(
            fmt::format("{}{} crease edge(s) follow no edge of a face; they are ignored", start, missing));

    const auto crowded =
        std::count_if(edge_faces.begin(), edge_faces.end(), [](const auto& edge) { return edge.second > 2; });
    if (crowded > 0) {
        warnings.push_back(
            fmt::format("{}more than two faces meet at {} edge(s); the surface is sharp there", start, crowded));
    }
    std::vector<std::vector<int>> faces;
    std::size_t begin = 0;
    for (const int size : cage.faces.sizes) {
        const auto first = cage.faces.points.begin() + static_cast<std::ptrdiff_t>(begin);
        faces.emplace_back(first, first + size);
        std::sort(faces.back().begin(), faces.back().end());
        begin += static_cast<std::size_t>(size);
    }
    std::sort(faces.begin(), faces.end());
    std::size_t repeated = 0;
    for (std::size_t f = 1; f < faces.size(); ++f) repeated += faces[f] == faces[f - 1] ? 1u : 0u;
    if (repeated > 0) warnings.push_back(fmt::format("{}{} face(s) repeat the points of another", start, repeated));
    return warnings;
}

}  // namespace aleph
