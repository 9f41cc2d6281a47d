#include "engine/surface/grid.h"

#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/surface/cage_checks.h"
#include "engine/surface/sharing.h"

namespace aleph {

namespace {

constexpr std::size_t max_triangles = std::size_t{1} << 25;

class GridBuilder : private SharedVertices {
  public:
    GridBuilder(const Cage& cage, const Far::TopologyRefiner& refiner, int level)
        : SharedVertices(cage, refiner, level) {
        grid_.level = level_;
        grid_.faces.triangular = cage.scheme == Cage::Scheme::loop;
    }

    SurfaceGrid build() {
        check_size();
        count_cells();
        make_shared_vertices();
        make_parts();
        return std::move(grid_);
    }

  private:
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
                grid_.faces.cells[ptex_.GetFaceId(f) + i] =
                    static_cast<std::uint16_t>(is_regular(f) ? segments_ : segments_ / 2);
            }
        }
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
                int& vertex = rows[j * (n + 1) + i];
                if (j == 0)
                    vertex = edge_vertex(f, 0, i);
                else if (i == (grid_.faces.triangular ? n - j : n))
                    vertex = edge_vertex(f, 1, j);
                else if (i == 0)
                    vertex = edge_vertex(f, grid_.faces.triangular ? 2 : 3, n - j);
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
                    int& vertex = rows[j * (n + 1) + i];
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
        grid_.parts.resize(static_cast<std::size_t>(count_parts(cage_)));
        for (int f = 0; f < base_.GetNumFaces(); ++f) {
            if (!is_drawn(f)) continue;
            const auto part = static_cast<std::size_t>(cage_.faces.parts.empty() ? 0 : cage_.faces.parts[f]);
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
        const int n = grid_.faces.cells[face];
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < (grid_.faces.triangular ? n - j : n); ++i) {
                const int halves = grid_.faces.triangular && i + j == n - 1 ? 1 : 2;
                for (int half = 0; half < halves; ++half) {
                    const GridTriangle triangle{face, static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                                                static_cast<std::uint8_t>(half)};
                    glm::ivec2 at[3];
                    grid_.faces.find_corners(triangle, at);
                    const auto vertex = [&](const glm::ivec2& p) {
                        return static_cast<std::uint32_t>(rows[p.y * (n + 1) + p.x]);
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

    SurfaceGrid grid_;
};

}  // namespace

void FaceGrid::find_corners(const GridTriangle& triangle, glm::ivec2 (&corners)[3]) const {
    const glm::ivec2 cell(triangle.i, triangle.j), right = cell + glm::ivec2(1, 0), below = cell + glm::ivec2(0, 1);
    const bool first = triangle.half == 0;
    corners[0] = triangular && !first ? right : cell;
    corners[1] = first ? right : cell + 1;
    corners[2] = first && !triangular ? cell + 1 : below;
}

SurfaceGrid make_surface_grid(const Cage& cage, const Far::TopologyRefiner& refiner, int level) {
    return GridBuilder(cage, refiner, level).build();
}

}  // namespace aleph
