#pragma once
// Reference for subdivision, written from the papers: Catmull and Clark 1978 with the creases of DeRose, Kass and
// Truong 1998, Loop 1987, and the closed forms of their limit positions.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace aleph {

/// A polygon mesh with sharp edges and points. Manifold; boundary edges are infinitely sharp.
struct ReferenceMesh {
    using Edge = std::pair<int, int>;  ///< lower point first
    std::vector<glm::dvec3> points;
    std::vector<std::vector<int>> faces;
    std::map<Edge, double> creases;
    std::map<int, double> corners;

    static Edge edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

    std::map<Edge, std::vector<int>> edge_faces() const {
        std::map<Edge, std::vector<int>> result;
        for (std::size_t f = 0; f < faces.size(); ++f) {
            for (std::size_t k = 0; k < faces[f].size(); ++k) {
                result[edge(faces[f][k], faces[f][(k + 1) % faces[f].size()])].push_back(static_cast<int>(f));
            }
        }
        return result;
    }
};

inline constexpr double reference_infinite = 10.0;

/// The properties of a point that the rules need.
struct ReferencePoint {
    std::vector<int> neighbours, faces;
    std::vector<int> sharp_neighbours;
    std::vector<double> sharpness;  ///< of those
    double corner = 0.0;
};

inline std::vector<ReferencePoint> reference_points(const ReferenceMesh& mesh) {
    std::vector<ReferencePoint> points(mesh.points.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (const int p : mesh.faces[f]) points[p].faces.push_back(static_cast<int>(f));
    }
    for (const auto& [edge, faces] : mesh.edge_faces()) {
        const auto crease = mesh.creases.find(edge);
        double sharpness = crease == mesh.creases.end() ? 0.0 : crease->second;
        if (faces.size() == 1) sharpness = reference_infinite;
        for (const auto& [a, b] : {edge, std::pair(edge.second, edge.first)}) {
            ReferencePoint& point = points[a];
            point.neighbours.push_back(b);
            if (sharpness > 0.0) {
                point.sharp_neighbours.push_back(b);
                point.sharpness.push_back(sharpness);
            }
        }
    }
    for (const auto& [p, sharpness] : mesh.corners) points[p].corner = sharpness;
    return points;
}

inline double reduce_sharpness(double sharpness) {
    return sharpness >= reference_infinite ? sharpness : std::max(0.0, sharpness - 1.0);
}

/// Blends between the sharp and the smooth vertex rule by sharpness below 1.
inline double crease_share(const ReferencePoint& point) {
    double sum = 0.0;
    for (const double s : point.sharpness) sum += std::min(1.0, s);
    return point.sharpness.empty() ? 0.0 : sum / static_cast<double>(point.sharpness.size());
}

/// A point after one step, given what the smooth rule says. Sharp edges at one point are alike in our tests.
inline glm::dvec3 apply_sharp_rules(const ReferenceMesh& mesh, const ReferencePoint& point, const glm::dvec3& old,
                                    const glm::dvec3& smooth) {
    glm::dvec3 result = smooth;
    if (point.sharp_neighbours.size() == 2) {
        const glm::dvec3 crease =
            (6.0 * old + mesh.points[point.sharp_neighbours[0]] + mesh.points[point.sharp_neighbours[1]]) / 8.0;
        result += crease_share(point) * (crease - result);
    } else if (point.sharp_neighbours.size() > 2) {
        result += crease_share(point) * (old - result);
    }
    return result + std::min(1.0, point.corner) * (old - result);
}

/// Edges and corners of the next level but for faces.
inline ReferenceMesh start_next_level(const ReferenceMesh& mesh, std::map<ReferenceMesh::Edge, int>& middle) {
    ReferenceMesh next;
    next.points.resize(mesh.points.size());
    for (const auto& [edge, faces] : mesh.edge_faces()) {
        middle[edge] = static_cast<int>(next.points.size());
        next.points.emplace_back();
    }
    for (const auto& [edge, sharpness] : mesh.creases) {
        if (reduce_sharpness(sharpness) <= 0.0) continue;
        next.creases[ReferenceMesh::edge(edge.first, middle.at(edge))] = reduce_sharpness(sharpness);
        next.creases[ReferenceMesh::edge(edge.second, middle.at(edge))] = reduce_sharpness(sharpness);
    }
    for (const auto& [p, sharpness] : mesh.corners) {
        if (reduce_sharpness(sharpness) > 0.0) next.corners[p] = reduce_sharpness(sharpness);
    }
    return next;
}

inline double edge_share(const ReferenceMesh& mesh, const ReferenceMesh::Edge& edge, std::size_t faces) {
    if (faces == 1) return 1.0;
    const auto crease = mesh.creases.find(edge);
    return crease == mesh.creases.end() ? 0.0 : std::min(1.0, crease->second);
}

inline ReferenceMesh subdivide_catmull_clark(const ReferenceMesh& mesh) {
    std::map<ReferenceMesh::Edge, int> middle;
    ReferenceMesh next = start_next_level(mesh, middle);
    const auto first_centre = next.points.size();
    for (const auto& face : mesh.faces) {
        glm::dvec3 sum(0.0);
        for (const int p : face) sum += mesh.points[p];
        next.points.push_back(sum / static_cast<double>(face.size()));
    }
    for (const auto& [edge, faces] : mesh.edge_faces()) {
        const glm::dvec3 ends = mesh.points[edge.first] + mesh.points[edge.second];
        glm::dvec3 smooth = ends;
        for (const int f : faces) smooth += next.points[first_centre + static_cast<std::size_t>(f)];
        smooth /= static_cast<double>(2 + faces.size());
        const glm::dvec3 sharp = ends / 2.0;
        next.points[middle.at(edge)] = smooth + edge_share(mesh, edge, faces.size()) * (sharp - smooth);
    }
    const auto points = reference_points(mesh);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto n = static_cast<double>(points[p].neighbours.size());
        glm::dvec3 edges(0.0), faces(0.0);
        for (const int e : points[p].neighbours) edges += mesh.points[e];
        for (const int f : points[p].faces) faces += next.points[first_centre + static_cast<std::size_t>(f)];
        const glm::dvec3 smooth = ((n - 2.0) * mesh.points[p] + edges / n + faces / n) / n;
        next.points[p] = apply_sharp_rules(mesh, points[p], mesh.points[p], smooth);
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const auto& face = mesh.faces[f];
        for (std::size_t k = 0; k < face.size(); ++k) {
            const int before = face[(k + face.size() - 1) % face.size()], after = face[(k + 1) % face.size()];
            next.faces.push_back({face[k], middle.at(ReferenceMesh::edge(face[k], after)),
                                  static_cast<int>(first_centre + f), middle.at(ReferenceMesh::edge(before, face[k]))});
        }
    }
    return next;
}

/// Loop's weight of every neighbour of an inner point of n neighbours.
inline double loop_beta(double n) {
    const double c = 3.0 / 8.0 + std::cos(2.0 * std::numbers::pi / n) / 4.0;
    return (5.0 / 8.0 - c * c) / n;
}

inline ReferenceMesh subdivide_loop(const ReferenceMesh& mesh) {
    std::map<ReferenceMesh::Edge, int> middle;
    ReferenceMesh next = start_next_level(mesh, middle);
    for (const auto& [edge, faces] : mesh.edge_faces()) {
        const glm::dvec3 ends = mesh.points[edge.first] + mesh.points[edge.second];
        glm::dvec3 smooth = 3.0 * ends;
        for (const int f : faces) {
            for (const int p : mesh.faces[f]) {
                if (p != edge.first && p != edge.second) smooth += mesh.points[p];
            }
        }
        smooth /= 8.0;
        next.points[middle.at(edge)] = smooth + edge_share(mesh, edge, faces.size()) * (ends / 2.0 - smooth);
    }
    const auto points = reference_points(mesh);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto n = static_cast<double>(points[p].neighbours.size());
        glm::dvec3 smooth = (1.0 - n * loop_beta(n)) * mesh.points[p];
        for (const int e : points[p].neighbours) smooth += loop_beta(n) * mesh.points[e];
        next.points[p] = apply_sharp_rules(mesh, points[p], mesh.points[p], smooth);
    }
    for (const auto& face : mesh.faces) {
        const int a = middle.at(ReferenceMesh::edge(face[0], face[1])),
                  b = middle.at(ReferenceMesh::edge(face[1], face[2])),
                  c = middle.at(ReferenceMesh::edge(face[2], face[0]));
        next.faces.insert(next.faces.end(), {{face[0], a, c}, {a, face[1], b}, {c, b, face[2]}, {a, b, c}});
    }
    return next;
}

/// Limit positions of a mesh's points. Every sharpness is infinite or 0. Catmull-Clark: all faces are quads (subdivide
/// once before).
inline std::vector<glm::dvec3> reference_limits(const ReferenceMesh& mesh, bool loop) {
    const auto points = reference_points(mesh);
    std::vector<glm::dvec3> limits(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        const ReferencePoint& point = points[p];
        const glm::dvec3& own = mesh.points[p];
        const auto n = static_cast<double>(point.neighbours.size());
        glm::dvec3 edges(0.0);
        for (const int e : point.neighbours) edges += mesh.points[e];
        if (point.corner > 0.0 || point.sharp_neighbours.size() > 2) {
            limits[p] = own;
        } else if (point.sharp_neighbours.size() == 2) {
            limits[p] =
                (4.0 * own + mesh.points[point.sharp_neighbours[0]] + mesh.points[point.sharp_neighbours[1]]) / 6.0;
        } else if (loop) {
            const double chi = 1.0 / (3.0 / (8.0 * loop_beta(n)) + n);
            limits[p] = (1.0 - n * chi) * own + chi * edges;
        } else {
            glm::dvec3 opposite(0.0);
            for (const int f : point.faces) {
                const auto& face = mesh.faces[f];
                const auto at = std::find(face.begin(), face.end(), static_cast<int>(p)) - face.begin();
                opposite += mesh.points[face[static_cast<std::size_t>(at + 2) % 4]];
            }
            limits[p] = (n * n * own + 4.0 * edges + opposite) / (n * (n + 5.0));
        }
    }
    return limits;
}

}  // namespace aleph
