#include "scenes/common/cages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "engine/surface/limit_surface.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

double rounded(double value, double steps_per_metre) {
    return std::round(value * steps_per_metre) / steps_per_metre;
}

void add_face(Cage& cage, const std::vector<int>& points, const std::vector<glm::dvec2>& uv) {
    cage.faces.sizes.push_back(static_cast<int>(points.size()));
    for (const int point : points) cage.faces.points.push_back(point);
    for (const glm::dvec2& at : uv) {
        const glm::vec2 value(rounded(at.x, 1e3), rounded(at.y, 1e3));
        // Adjacent faces share texture coordinates, so that these are smooth across edges.
        const auto found = std::find(cage.uv.begin(), cage.uv.end(), value);
        cage.faces.uv.push_back(static_cast<int>(found - cage.uv.begin()));
        if (found == cage.uv.end()) cage.uv.push_back(value);
    }
}

void add_crease(Cage& cage, const std::vector<int>& chain) {
    cage.creases.lengths.push_back(static_cast<int>(chain.size()));
    cage.creases.points.insert(cage.creases.points.end(), chain.begin(), chain.end());
    cage.creases.sharpness.push_back(10.0f);
}

/// To the left of a direction in the plane.
glm::dvec2 left_of(const glm::dvec2& direction) {
    return {-direction.y, direction.x};
}

/// The offset of a corner that is at distance 1 from both sides of the path.
glm::dvec2 mitre(const std::vector<glm::dvec2>& path, std::size_t i, bool closed) {
    const std::size_t n = path.size();
    const glm::dvec2 before = closed || i > 0 ? path[i] - path[(i + n - 1) % n] : path[1] - path[0];
    const glm::dvec2 after = closed || i + 1 < n ? path[(i + 1) % n] - path[i] : before;
    const glm::dvec2 a = left_of(glm::normalize(before)), b = left_of(glm::normalize(after));
    return (a + b) / (1.0 + glm::dot(a, b));
}

}  // namespace

int add_cage(Scene& scene, const std::string& name, const CageShape& shape, int material) {
    PointCache points;
    points.name = name;
    points.positions.emplace_back();
    for (const glm::dvec3& p : shape.points)
        points.positions.front().emplace_back(rounded(p.x, 1e4), rounded(p.y, 1e4), rounded(p.z, 1e4));

    Cage cage = shape.cage;
    cage.name = name;
    cage.points = append(scene.point_caches, points);

    Mesh mesh;
    mesh.name = name;
    mesh.material = material;
    mesh.subdivision.cage = append(scene.cages, cage);
    const int index = append(scene.meshes, mesh);
    tessellate_cage(scene, mesh.subdivision.cage);
    return index;
}

int add_cage_node(const Group& group, const std::string& name, const CageShape& shape, int material,
                  const glm::dvec3& translation, const glm::dquat& rotation) {
    return group.add_mesh(name, add_cage(group.scene, name, shape, material), translation, rotation);
}

CageShape make_moulding(const std::vector<glm::dvec2>& path, bool closed, const std::vector<glm::dvec2>& profile) {
    CageShape result;
    result.cage.level = 2;
    // A repeated point is one point of the cage.
    std::vector<glm::dvec2> outline;
    std::vector<bool> sharp;
    for (const glm::dvec2& point : profile) {
        if (!outline.empty() && outline.back() == point) {
            sharp.back() = true;
        } else {
            outline.push_back(point);
            sharp.push_back(false);
        }
    }
    const int across = static_cast<int>(outline.size()), corners = static_cast<int>(path.size());
    std::vector<double> u = {0.0}, v = {0.0};
    for (int i = 0; i < corners; ++i) {
        const glm::dvec2 offset = mitre(path, static_cast<std::size_t>(i), closed);
        for (const glm::dvec2& at : outline) result.points.emplace_back(path[i] + at.x * offset, at.y);
        u.push_back(u.back() + glm::distance(path[i], path[(i + 1) % corners]));
    }
    for (std::size_t j = 1; j < outline.size(); ++j) v.push_back(v.back() + glm::distance(outline[j], outline[j - 1]));

    const auto index = [&](int i, int j) { return (i % corners) * across + j; };
    for (int i = 0; i < (closed ? corners : corners - 1); ++i) {
        for (int j = 0; j + 1 < across; ++j) {
            const auto at = [&](int a, int b) { return glm::dvec2(u[i + a], v[j + b]); };
            add_face(result.cage, {index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)},
                     {at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
        }
    }
    for (int i = closed ? 0 : 1; i < (closed ? corners : corners - 1); ++i) {
        std::vector<int> chain;
        for (int j = 0; j < across; ++j) chain.push_back(index(i, j));
        add_crease(result.cage, chain);
    }
    for (int j = 1; j + 1 < across; ++j) {
        if (!sharp[j]) continue;
        std::vector<int> chain;
        for (int i = 0; i < corners; ++i) chain.push_back(index(i, j));
        if (closed) chain.push_back(index(0, j));
        add_crease(result.cage, chain);
    }
    return result;
}

CageShape make_rectangle_moulding(const glm::dvec2& size, const std::vector<glm::dvec2>& profile, bool outwards) {
    const glm::dvec2 h = 0.5 * size;
    std::vector<glm::dvec2> path = {{-h.x, -h.y}, {h.x, -h.y}, {h.x, h.y}, {-h.x, h.y}};
    if (outwards) std::swap(path[1], path[3]);
    return make_moulding(path, true, profile);
}

CageShape make_cushion(const glm::dvec3& size, double rounding, const glm::dvec3& swell, int level) {
    CageShape result;
    result.cage.level = level;
    std::array<std::vector<double>, 3> lines;
    for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * size[axis], inner = std::max(half - rounding, 0.25 * half);
        lines[axis] = {-half, -inner, 0.0, inner, half};
    }
    const int last = 4;
    std::map<std::array<int, 3>, int> index;
    const auto find = [&](const std::array<int, 3>& at) {
        const auto [found, added] = index.try_emplace(at, static_cast<int>(result.points.size()));
        if (added) {
            glm::dvec3 point, middle;
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                point[axis] = lines[a][at[a]];
                middle[axis] = 1.0 - std::pow(std::abs(2.0 * point[axis] / size[axis]), 2.0);
            }
            for (int axis = 0; axis < 3; ++axis) {
                const int end = at[axis];
                if (end != 0 && end != last) continue;
                const double out = swell[axis] * middle[(axis + 1) % 3] * middle[(axis + 2) % 3];
                point[axis] += end == 0 ? -out : out;
            }
            result.points.push_back(point);
        }
        return found->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        for (const int end : {0, last}) {
            for (int i = 0; i < last; ++i) {
                for (int j = 0; j < last; ++j) {
                    std::vector<int> face;
                    std::vector<glm::dvec2> uv;
                    for (int corner = 0; corner < 4; ++corner) {
                        std::array<int, 3> at{};
                        at[axis] = end;
                        at[b] = i + (corner == 1 || corner == 2 ? 1 : 0);
                        at[c] = j + (corner >= 2 ? 1 : 0);
                        face.push_back(find(at));
                        uv.emplace_back(lines[b][at[b]], lines[c][at[c]]);
                    }
                    if (end == 0) {
                        std::reverse(face.begin(), face.end());
                        std::reverse(uv.begin(), uv.end());
                    }
                    add_face(result.cage, face, uv);
                }
            }
        }
    }
    return result;
}

CageShape make_closed_tube(const std::function<glm::dvec3(double)>& curve, int steps, int sides,
                           const glm::dvec2& radii, int half_turns) {
    CageShape result;
    result.cage.level = 2;
    const auto tangent = [&](int i) {
        const double at = static_cast<double>(i) / steps, d = 1e-4;
        return glm::normalize(curve(at + d) - curve(at - d));
    };
    // A normal transported along the curve without twist; the angle left after one round is distributed over the curve.
    std::vector<glm::dvec3> normals;
    const glm::dvec3 first = tangent(0);
    normals.push_back(
        glm::normalize(glm::cross(first, std::abs(first.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0))));
    for (int i = 1; i <= steps; ++i) {
        const glm::dvec3 along = tangent(i);
        normals.push_back(glm::normalize(normals.back() - glm::dot(normals.back(), along) * along));
    }
    const glm::dvec3 side = glm::cross(first, normals.front());
    const double missing = -std::atan2(glm::dot(normals.back(), side), glm::dot(normals.back(), normals.front()));
    double length = 0.0;
    std::vector<double> u = {0.0};
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 along = tangent(i), n = normals[i], b = glm::cross(along, n);
        const glm::dvec3 middle = curve(static_cast<double>(i) / steps);
        const double turn = (missing + pi * half_turns) * i / steps;
        for (int j = 0; j < sides; ++j) {
            const double angle = 2.0 * pi * j / sides;
            const glm::dvec2 at = radii * glm::dvec2(std::cos(angle), std::sin(angle));
            result.points.push_back(middle + (std::cos(turn) * n + std::sin(turn) * b) * at.x +
                                    (std::cos(turn) * b - std::sin(turn) * n) * at.y);
        }
        length += glm::distance(middle, curve(static_cast<double>(i + 1) / steps));
        u.push_back(length);
    }
    // After an odd number of half turns the last section joins the first one rotated by 180 degrees.
    const int shift = half_turns % 2 == 0 ? 0 : sides / 2;
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < sides; ++j) {
            const auto index = [&](int a, int b) {
                const int ring = i + a;
                const int around = ring == steps ? j + b + shift : j + b;
                return (ring % steps) * sides + around % sides;
            };
            const auto at = [&](int a, int b) { return glm::dvec2(u[i + a], static_cast<double>(j + b) / sides); };
            add_face(result.cage, {index(0, 0), index(0, 1), index(1, 1), index(1, 0)},
                     {at(0, 0), at(0, 1), at(1, 1), at(1, 0)});
        }
    }
    return result;
}

CageShape make_leaf(double length, double width, double droop) {
    CageShape result;
    result.cage.level = 1;
    const std::array<double, 6> widths = {0.1, 0.7, 1.0, 0.86, 0.48, 0.04};
    const int rows = static_cast<int>(widths.size());
    for (int i = 0; i < rows; ++i) {
        const double t = i / (rows - 1.0), half = 0.5 * width * widths[i];
        const double y = length * t * (1.0 - 0.3 * droop * t), z = -length * droop * t * t;
        for (const int side : {-1, 0, 1}) result.points.emplace_back(side * half, y, z + std::abs(side) * 0.35 * half);
    }
    for (int i = 0; i + 1 < rows; ++i) {
        for (int j = 0; j < 2; ++j) {
            const int p = 3 * i + j;
            const auto at = [&](int a, int b) { return glm::dvec2(0.5 * (j + a), 1.0 - (i + b) / (rows - 1.0)); };
            add_face(result.cage, {p, p + 1, p + 4, p + 3}, {at(0, 0), at(1, 0), at(1, 1), at(0, 1)});
        }
    }
    return result;
}

}  // namespace aleph
