#pragma once
// Which faces of a cage share which vertices of its triangles. Internal to limit_surface.cpp and
// its parts.

#include <opensubdiv/far/ptexIndices.h>

#include <vector>

#include "engine/surface/grid.h"

namespace aleph {

/// The vertices at the cage's points and along its edges, and their sharing: faces that meet smoothly have one vertex,
/// but for seams of the texture; infinitely sharp edges have one per side.
class SharedVertices {
  public:
    /// @param level  every edge of the cage gets 2^level segments, 2 at least where some face is no quad (Loop:
    /// triangle)
    SharedVertices(const Cage& cage, const Far::TopologyRefiner& refiner, int level);

  protected:
    bool is_regular(int f) const { return base_.GetFaceVertices(f).size() == regular_size_; }
    bool is_drawn(int f) const { return !base_.IsFaceHole(f); }
    /// Vertex m of edge k of a face, as the face sees it.
    int edge_vertex(int f, int k, int m) const;
    int add_vertex(const LimitLocation& position, const LimitLocation& normal, const LimitLocation& uv);
    /// Fills the vertices of points, then those of edges.
    void make_shared_vertices();

    const Cage& cage_;
    const Far::TopologyLevel& base_;
    Far::PtexIndices ptex_;
    int level_ = 0;
    int segments_ = 1;  ///< of every edge of the cage
    std::vector<GridVertex> vertices_;

  private:
    /// Edge k of a face runs from its corner k to the next; `forward` if the edge does too.
    struct Side {
        int f, k;
        bool forward;
    };
    /// Sets of corners of faces, each named by its lowest member.
    class Sets {
      public:
        explicit Sets(std::size_t count);
        int find(int i);
        void join(int a, int b);

      private:
        std::vector<int> parent_;
    };

    bool is_sharp(int edge) const;
    bool is_sharp_point(int v) const;
    bool is_uv_joined(const Side& a, const Side& b) const;
    int corner(int f, int k) const { return corner_begin_[f] + k; }
    int corner_at(int f, int v) const;
    int uv_of(int corner) const { return cage_.faces.uv.empty() ? 0 : cage_.faces.uv[corner]; }
    Side find_side(int edge, int f) const;
    LimitLocation edge_location(int f, int k, int m) const;
    LimitLocation side_location(const Side& side, int m) const;
    void join_normals();
    void make_corners();
    void make_edges();

    int regular_size_;
    std::vector<int> corner_begin_;  ///< by face
    Sets normal_sets_;
    std::vector<int> corner_vertices_;  ///< by face corner
    std::vector<int> edge_vertices_;    ///< by face corner: first of its edge's inner vertices
};

}  // namespace aleph
