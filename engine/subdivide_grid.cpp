#include "engine/subdivide_grid.h"

#include <fmt/format.h>
#include <opensubdiv/far/ptexIndices.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr std::size_t max_triangles = std::size_t{1} << 25;

/// A shared edge's or inner vertex's number is that of its first face's first vertex of the kind.
class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int i) {
        while (parent_[static_cast<std::size_t>(i)] != i) {
            i = parent_[static_cast<std::size_t>(i)] =
                parent_[static_cast<std::size_t>(parent_[static_cast<std::size_t>(i)])];
        }
        return i;
    }
    /// The lowest member names a set.
    void join(int a, int b) {
        a = find(a);
        b = find(b);
        parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }

  private:
    std::vector<int> parent_;
};

class GridBuilder {
  public:
    GridBuilder(const Cage& cage, const Far::TopologyRefiner& refiner, int level)
        : cage_(cage),
          base_(refiner.GetLevel(0)),
          ptex_(refiner),
          regular_size_(cage.scheme == Cage::Scheme::loop ? 3 : 4),
          normal_sets_(static_cast<std::size_t>(base_.GetNumFaceVertices())) {
        bool irregular = false;
        corner_begin_.push_back(0);
        for (int f = 0; f < base_.GetNumFaces(); ++f) {
            const int size = base_.GetFaceVertices(f).size();
            irregular = irregular || size != regular_size_;
            corner_begin_.push_back(corner_begin_.back() + size);
        }
        grid_.level = irregular ? std::max(level, 1) : level;
        grid_.faces.triangular = cage.scheme == Cage::Scheme::loop;
        segments_ = 1 << grid_.level;
    }

    SurfaceGrid build() {
        check_size();
        count_cells();
        join_normals();
        make_corners();
        make_edges();
        make_parts();
        return std::move(grid_);
    }

  private:
    bool is_regular(int f) const { return base_.GetFaceVertices(f).size() == regular_size_; }
    bool is_drawn(int f) const { return !base_.IsFaceHole(f); }
    bool is_sharp(int edge) const {
        return base_.IsEdgeInfSharp(edge) || base_.GetEdgeFaces(edge).size() != 2 || base_.IsEdgeNonManifold(edge) ||
               cage_.scheme == Cage::Scheme::bilinear;
    }
    int corner(int f, int k) const { return corner_begin_[static_cast<std::size_t>(f)] + k; }
    int uv_of(int corner) const { return cage_.face_uv.empty() ? 0 : cage_.face_uv[static_cast<std::size_t>(corner)]; }

    void check_size() const {
        std::size_t triangles = 0;
        for (int f = 0; f < base_.GetNumFaces(); ++f) {
            if (!is_drawn(f)) continue;
            const auto cells = static_cast<std::size_t>(segments_) * static_cast<std::size_t>(segments_);
            const auto size = static_cast<std::size_t>(base_.GetFaceVertices(f).size());
            if (grid_.faces.triangular)
                triangles += cells;
            else
                triangles += is_regular(f) ? 2 * cells : size * cells / 2;
        }
        if (triangles > max_triangles) {
            throw InputError("", "cage " + printable(cage_.name),
                             fmt::format("level {} makes {} triangles of it; at most {} are possible. Lower its level",
                                         grid_.level, triangles, max_triangles));
        }
        if (triangles == 0) {
            throw InputError("", "cage " + printable(cage_.name),
                             "none of its faces is drawn: all are holes, or at a boundary that is not interpolated");
        }
    }

    void count_cells() {
        grid_.faces.cells.resize(static_cast<std::size_t>(ptex_.GetNumFaces()));
        for (int f = 0; f < base_.GetNumFaces(); ++f) {
            const int pieces = is_regular(f) ? 1 : base_.GetFaceVertices(f).size();
            for (int i = 0; i < pieces; ++i) {
                grid_.faces.cells[static_cast<std::size_t>(ptex_.GetFaceId(f) + i)] =
                    static_cast<std::uint16_t>(is_regular(f) ? segments_ : segments_ / 2);
            }
        }
    }

    /// Where point m of `segments_` lies on edge k of a face, as the face sees it.
    LimitLocation edge_location(int f, int k, int m) const {
        const auto at = [](int face, int i, int j, int cells) {
            return LimitLocation{face, static_cast<float>(i) / static_cast<float>(cells),
                                 static_cast<float>(j) / static_cast<float>(cells)};
        };
        const int first = ptex_.GetFaceId(f), n = segments_;
        if (!is_regular(f)) {
            const int size = base_.GetFaceVertices(f).size(), half = n / 2;
            return m <= half ? at(first + k, m, 0, half) : at(first + (k + 1) % size, 0, n - m, half);
        }
        if (grid_.faces.triangular) {
            if (k == 0) return at(first, m, 0, n);
            return k == 1 ? at(first, n - m, m, n) : at(first, 0, n - m, n);
        }
        if (k == 0) return at(first, m, 0, n);
        if (k == 1) return at(first, n, m, n);
        return k == 2 ? at(first, n - m, n, n) : at(first, 0, n - m, n);
    }

    /// Corners of faces that meet smoothly at a point have one normal.
    void join_normals() {
        for (int e = 0; e < base_.GetNumEdges(); ++e) {
            if (is_sharp(e)) continue;
            const auto faces = base_.GetEdgeFaces(e);
            for (const int v : base_.GetEdgeVertices(e)) {
                if (is_sharp_point(v)) continue;
                normal_sets_.join(corner(faces[0], corner_at(faces[0], v)), corner(faces[1], corner_at(faces[1], v)));
            }
        }
    }
    int corner_at(int f, int v) const {
        const auto points = base_.GetFaceVertices(f);
        return static_cast<int>(std::find(points.begin(), points.end(), v) - points.begin());
    }
    /// Where the surface has a tip: every face has a tangent plane of its own there.
    bool is_sharp_point(int v) const {
        if (base_.IsVertexInfSharp(v) || base_.IsVertexNonManifold(v)) return true;
        const auto edges = base_.GetVertexEdges(v);
        return std::count_if(edges.begin(), edges.end(), [&](int e) { return is_sharp(e); }) > 2;
    }

    int add_vertex(const LimitLocation& position, const LimitLocation& normal, const LimitLocation& uv) {
        vertices_.push_back({position, normal, uv});
        return static_cast<int>(vertices_.size()) - 1;
    }

    void make_corners() {
        corner_vertices_.assign(static_cast<std::size_t>(base_.GetNumFaceVertices()), no_index);
        std::vector<int> first_corner(static_cast<std::size_t>(base_.GetNumVertices()), no_index);
        std::vector<LimitLocation> locations(corner_vertices_.size());
        std::vector<int> normal_corner(corner_vertices_.size(), no_index);  // by set: its first drawn corner
        std::map<std::pair<int, int>, int> known;                           // (normal set, uv) to vertex
        for (int f = 0; f < base_.GetNumFaces(); ++f) {
            if (!is_drawn(f)) continue;
            const auto points = base_.GetFaceVertices(f);
            for (int k = 0; k < points.size(); ++k) {
                const auto c = static_cast<std::size_t>(corner(f, k));
                locations[c] = edge_location(f, k, 0);
                int& first = first_corner[static_cast<std::size_t>(points[k])];
                if (first == no_index) first = static_cast<int>(c);
                const int set = normal_sets_.find(static_cast<int>(c));
                int& normal = normal_corner[static_cast<std::size_t>(set)];
                if (normal == no_index) normal = static_cast<int>(c);
                const auto [entry, is_new] = known.try_emplace({set, uv_of(static_cast<int>(c))}, 0);
                if (is_new) {
                    entry->second = add_vertex(locations[static_cast<std::size_t>(first)],
                                               locations[static_cast<std::size_t>(normal)], locations[c]);
                }
                corner_vertices_[c] = entry->second;
            }
        }
    }

    /// Edge k of a face runs from its corner k to the next; `forward` if the edge does too.
    struct Side {
        int f, k;
        bool forward;
    };
    Side find_side(int edge, int f) const {
        const auto edges = base_.GetFaceEdges(f);
        const int k = static_cast<int>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
        return {f, k, base_.GetFaceVertices(f)[k] == base_.GetEdgeVertices(edge)[0]};
    }

    void make_edges() {
        edge_vertices_.assign(static_cast<std::size_t>(base_.GetNumFaceVertices()), no_index);
        for (int e = 0; e < base_.GetNumEdges(); ++e) {
            const Side* position = nullptr;
            Side first{};
            for (const int f : base_.GetEdgeFaces(e)) {
                if (!is_drawn(f)) continue;
                const Side side = find_side(e, f);
                int& begin = edge_vertices_[static_cast<std::size_t>(corner(f, side.k))];
                if (!position) {
                    first = side;
                    position = &first;
                } else if (!is_sharp(e) && is_uv_joined(first, side)) {
                    begin = edge_vertices_[static_cast<std::size_t>(corner(first.f, first.k))];
                    continue;
                }
                const Side& normal = is_sharp(e) ? side : first;
                begin = static_cast<int>(vertices_.size());
                for (int m = 1; m < segments_; ++m) {
                    add_vertex(side_location(first, m), side_location(normal, m), side_location(side, m));
                }
            }
        }
    }
    /// Point m counted along the edge.
    LimitLocation side_location(const Side& side, int m) const {
        return edge_location(side.f, side.k, side.forward ? m : segments_ - m);
    }
    bool is_uv_joined(const Side& a, const Side& b) const {
        const auto uv_at = [&](const Side& side, bool start) {
            const int size = base_.GetFaceVertices(side.f).size();
            return uv_of(corner(side.f, start == side.forward ? side.k : (side.k + 1) % size));
        };
        return uv_at(a, true) == uv_at(b, true) && uv_at(a, false) == uv_at(b, false);
    }

    /// Vertex m of edge k of a face, as the face sees it.
    int edge_vertex(int f, int k, int m) const {
        const int size = base_.GetFaceVertices(f).size();
        if (m == 0) return corner_vertices_[static_cast<std::size_t>(corner(f, k))];
        if (m == segments_) return corner_vertices_[static_cast<std::size_t>(corner(f, (k + 1) % size))];
        const int begin = edge_vertices_[static_cast<std::size_t>(corner(f, k))];
        const bool forward = base_.GetFaceVertices(f)[k] == base_.GetEdgeVertices(base_.GetFaceEdges(f)[k])[0];
        return begin + (forward ? m : segments_ - m) - 1;
    }

    int add_inner_vertex(int face, int i, int j, int cells) {
        const LimitLocation location{face, static_cast<float>(i) / static_cast<float>(cells),
                                     static_cast<float>(j) / static_cast<float>(cells)};
        return add_vertex(location, location, location);
    }

    /// Vertices of a face of the parametrisation: row j, column i at j * (cells + 1) + i.
    using Rows = std::vector<int>;

    Rows make_regular_rows(int f) {
        const int n = segments_, face = ptex_.GetFaceId(f);
        Rows rows(static_cast<std::size_t>((n + 1) * (n + 1)), no_index);
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= (grid_.faces.triangular ? n - j : n); ++i) {
                int& vertex = rows[static_cast<std::size_t>(j * (n + 1) + i)];
                if (j == 0)
                    vertex = edge_vertex(f, 0, i);
                else if (grid_.faces.triangular && i + j == n)
                    vertex = edge_vertex(f, 1, j);
                else if (grid_.faces.triangular && i == 0)
                    vertex = edge_vertex(f, 2, n - j);
                else if (i == 0)
                    vertex = edge_vertex(f, 3, n - j);
                else if (i == n)
                    vertex = edge_vertex(f, 1, j);
                else if (j == n)
                    vertex = edge_vertex(f, 2, n - i);
                else
                    vertex = add_inner_vertex(face, i, j, n);
            }
        }
        return rows;
    }

    /// The quads that an n-gon falls into: corner, middle of the edge after it, centre, middle of the edge before it.
    std::vector<Rows> make_irregular_rows(int f) {
        const int n = segments_ / 2, size = base_.GetFaceVertices(f).size(), face = ptex_.GetFaceId(f);
        const int centre = add_inner_vertex(face, n, n, n);
        const int spokes = static_cast<int>(vertices_.size());  // from the middle of edge k, n - 1 each
        for (int k = 0; k < size; ++k) {
            for (int m = 1; m < n; ++m) add_inner_vertex(face + k, n, m, n);
        }
        const auto spoke_vertex = [&](int k, int m) {
            if (m == 0) return edge_vertex(f, k, n);
            return m == n ? centre : spokes + k * (n - 1) + m - 1;
        };
        std::vector<Rows> pieces;
        for (int k = 0; k < size; ++k) {
            const int before = (k + size - 1) % size;
            Rows rows(static_cast<std::size_t>((n + 1) * (n + 1)), no_index);
            for (int j = 0; j <= n; ++j) {
                for (int i = 0; i <= n; ++i) {
                    int& vertex = rows[static_cast<std::size_t>(j * (n + 1) + i)];
                    if (j == 0)
                        vertex = edge_vertex(f, k, i);
                    else if (i == 0)
                        vertex = edge_vertex(f, before, segments_ - j);
                    else if (i == n)
                        vertex = spoke_vertex(k, j);
                    else if (j == n)
                        vertex = spoke_vertex(before, i);
                    else
                        vertex = add_inner_vertex(face + k, i, j, n);
                }
            }
            pieces.push_back(std::move(rows));
        }
        return pieces;
    }

    void make_parts() {
        const int parts =
            cage_.face_parts.empty() ? 1 : *std::max_element(cage_.face_parts.begin(), cage_.face_parts.end()) + 1;
        grid_.parts.resize(static_cast<std::size_t>(parts));
        for (int f = 0; f < base_.GetNumFaces(); ++f) {
            if (!is_drawn(f)) continue;
            const auto part =
                static_cast<std::size_t>(cage_.face_parts.empty() ? 0 : cage_.face_parts[static_cast<std::size_t>(f)]);
            const int face = ptex_.GetFaceId(f);
            if (is_regular(f)) {
                add_triangles(grid_.parts[part], face, make_regular_rows(f));
                continue;
            }
            const std::vector<Rows> pieces = make_irregular_rows(f);
            for (std::size_t k = 0; k < pieces.size(); ++k) {
                add_triangles(grid_.parts[part], face + static_cast<int>(k), pieces[k]);
            }
        }
        for (PartGrid& part : grid_.parts) number_vertices(part);
    }

    void add_triangles(PartGrid& part, int face, const Rows& rows) {
        const int n = grid_.faces.cells[static_cast<std::size_t>(face)];
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < (grid_.faces.triangular ? n - j : n); ++i) {
                const int halves = grid_.faces.triangular && i + j == n - 1 ? 1 : 2;
                for (int half = 0; half < halves; ++half) {
                    const GridTriangle triangle{face, static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                                                static_cast<std::uint8_t>(half)};
                    glm::ivec2 at[3];
                    grid_.faces.find_corners(triangle, at);
                    const auto vertex = [&](const glm::ivec2& p) {
                        return static_cast<std::uint32_t>(rows[static_cast<std::size_t>(p.y * (n + 1) + p.x)]);
                    };
                    part.triangles.push_back(triangle);
                    part.corners.emplace_back(vertex(at[0]), vertex(at[1]), vertex(at[2]));
                }
            }
        }
    }

    /// From the surface's vertices to those that the part uses, in the order of use.
    void number_vertices(PartGrid& part) {
        std::vector<int> number(vertices_.size(), no_index);
        for (glm::uvec3& corners : part.corners) {
            for (int k = 0; k < 3; ++k) {
                int& own = number[corners[k]];
                if (own == no_index) {
                    own = static_cast<int>(part.vertices.size());
                    part.vertices.push_back(vertices_[corners[k]]);
                }
                corners[k] = static_cast<std::uint32_t>(own);
            }
        }
    }

    const Cage& cage_;
    const Far::TopologyLevel& base_;
    Far::PtexIndices ptex_;
    int regular_size_;
    int segments_ = 1;  ///< of every edge of the cage
    std::vector<int> corner_begin_;
    Sets normal_sets_;
    std::vector<GridVertex> vertices_;
    std::vector<int> corner_vertices_;  ///< by face corner
    std::vector<int> edge_vertices_;    ///< by face corner: first of its edge's inner vertices
    SurfaceGrid grid_;
};

}  // namespace

void FaceGrid::find_corners(const GridTriangle& triangle, glm::ivec2 (&corners)[3]) const {
    const glm::ivec2 cell(triangle.i, triangle.j);
    if (triangular) {
        corners[0] = triangle.half == 0 ? cell : cell + glm::ivec2(1, 0);
        corners[1] = triangle.half == 0 ? cell + glm::ivec2(1, 0) : cell + glm::ivec2(1, 1);
        corners[2] = cell + glm::ivec2(0, 1);
        return;
    }
    corners[0] = cell;
    corners[1] = triangle.half == 0 ? cell + glm::ivec2(1, 0) : cell + glm::ivec2(1, 1);
    corners[2] = triangle.half == 0 ? cell + glm::ivec2(1, 1) : cell + glm::ivec2(0, 1);
}

SurfaceGrid make_surface_grid(const Cage& cage, const Far::TopologyRefiner& refiner, int level) {
    return GridBuilder(cage, refiner, level).build();
}

}  // namespace aleph
