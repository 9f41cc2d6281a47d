#include "engine/surface/sharing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace aleph {

SharedVertices::Sets::Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
}

int SharedVertices::Sets::find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
}

void SharedVertices::Sets::join(int a, int b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
}

SharedVertices::SharedVertices(const Cage& cage, const Far::TopologyRefiner& refiner, int level)
    : cage_(cage),
      base_(refiner.GetLevel(0)),
      ptex_(refiner),
      regular_size_(cage.scheme == Cage::Scheme::loop ? 3 : 4),
      normal_sets_(static_cast<std::size_t>(base_.GetNumFaceVertices())) {
    bool irregular = false;
    corner_begin_.push_back(0);
    for (int f = 0; f < base_.GetNumFaces(); ++f) {
        irregular = irregular || !is_regular(f);
        corner_begin_.push_back(corner_begin_.back() + base_.GetFaceVertices(f).size());
    }
    level_ = irregular ? std::max(level, 1) : level;
    segments_ = 1 << level_;
}

void SharedVertices::make_shared_vertices() {
    join_normals();
    make_corners();
    make_edges();
}

bool SharedVertices::is_sharp(int edge) const {
    return base_.IsEdgeInfSharp(edge) || base_.GetEdgeFaces(edge).size() != 2 || base_.IsEdgeNonManifold(edge) ||
           cage_.scheme == Cage::Scheme::bilinear;
}

/// Where point m of `segments_` lies on edge k of a face, as the face sees it.
LimitLocation SharedVertices::edge_location(int f, int k, int m) const {
    const auto at = [](int face, int i, int j, int cells) {
        return LimitLocation{face, static_cast<float>(i) / static_cast<float>(cells),
                             static_cast<float>(j) / static_cast<float>(cells)};
    };
    const int first = ptex_.GetFaceId(f), n = segments_;
    if (!is_regular(f)) {
        const int size = base_.GetFaceVertices(f).size(), half = n / 2;
        return m <= half ? at(first + k, m, 0, half) : at(first + (k + 1) % size, 0, n - m, half);
    }
    if (k == 0) return at(first, m, 0, n);
    if (regular_size_ == 3) return k == 1 ? at(first, n - m, m, n) : at(first, 0, n - m, n);
    if (k == 1) return at(first, n, m, n);
    return k == 2 ? at(first, n - m, n, n) : at(first, 0, n - m, n);
}

/// Corners of faces that meet smoothly at a point have one normal.
void SharedVertices::join_normals() {
    for (int e = 0; e < base_.GetNumEdges(); ++e) {
        if (is_sharp(e)) continue;
        const auto faces = base_.GetEdgeFaces(e);
        for (const int v : base_.GetEdgeVertices(e)) {
            if (is_sharp_point(v)) continue;
            normal_sets_.join(corner(faces[0], corner_at(faces[0], v)), corner(faces[1], corner_at(faces[1], v)));
        }
    }
}

int SharedVertices::corner_at(int f, int v) const {
    const auto points = base_.GetFaceVertices(f);
    return static_cast<int>(std::find(points.begin(), points.end(), v) - points.begin());
}

/// Where the surface has a tip: every face has a tangent plane of its own there.
bool SharedVertices::is_sharp_point(int v) const {
    if (base_.IsVertexInfSharp(v) || base_.IsVertexNonManifold(v)) return true;
    const auto edges = base_.GetVertexEdges(v);
    return std::count_if(edges.begin(), edges.end(), [&](int e) { return is_sharp(e); }) > 2;
}

int SharedVertices::add_vertex(const LimitLocation& position, const LimitLocation& normal, const LimitLocation& uv) {
    vertices_.push_back({position, normal, uv});
    return static_cast<int>(vertices_.size()) - 1;
}

void SharedVertices::make_corners() {
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
            int& first = first_corner[points[k]];
            if (first == no_index) first = static_cast<int>(c);
            const int set = normal_sets_.find(static_cast<int>(c));
            int& normal = normal_corner[set];
            if (normal == no_index) normal = static_cast<int>(c);
            const auto [entry, is_new] = known.try_emplace({set, uv_of(static_cast<int>(c))}, 0);
            if (is_new) {
                entry->second = add_vertex(locations[first], locations[normal], locations[c]);
            }
            corner_vertices_[c] = entry->second;
        }
    }
}

SharedVertices::Side SharedVertices::find_side(int edge, int f) const {
    const auto edges = base_.GetFaceEdges(f);
    const int k = static_cast<int>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
    return {f, k, base_.GetFaceVertices(f)[k] == base_.GetEdgeVertices(edge)[0]};
}

void SharedVertices::make_edges() {
    edge_vertices_.assign(static_cast<std::size_t>(base_.GetNumFaceVertices()), no_index);
    for (int e = 0; e < base_.GetNumEdges(); ++e) {
        const Side* position = nullptr;
        Side first{};
        for (const int f : base_.GetEdgeFaces(e)) {
            if (!is_drawn(f)) continue;
            const Side side = find_side(e, f);
            int& begin = edge_vertices_[corner(f, side.k)];
            if (!position) {
                first = side;
                position = &first;
            } else if (!is_sharp(e) && is_uv_joined(first, side)) {
                begin = edge_vertices_[corner(first.f, first.k)];
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
LimitLocation SharedVertices::side_location(const Side& side, int m) const {
    return edge_location(side.f, side.k, side.forward ? m : segments_ - m);
}

bool SharedVertices::is_uv_joined(const Side& a, const Side& b) const {
    const auto uv_at = [&](const Side& side, bool start) {
        const int size = base_.GetFaceVertices(side.f).size();
        return uv_of(corner(side.f, start == side.forward ? side.k : (side.k + 1) % size));
    };
    return uv_at(a, true) == uv_at(b, true) && uv_at(a, false) == uv_at(b, false);
}

/// Vertex m of edge k of a face, as the face sees it.
int SharedVertices::edge_vertex(int f, int k, int m) const {
    const int size = base_.GetFaceVertices(f).size();
    if (m == 0) return corner_vertices_[corner(f, k)];
    if (m == segments_) return corner_vertices_[corner(f, (k + 1) % size)];
    const int begin = edge_vertices_[corner(f, k)];
    const bool forward = base_.GetFaceVertices(f)[k] == base_.GetEdgeVertices(base_.GetFaceEdges(f)[k])[0];
    return begin + (forward ? m : segments_ - m) - 1;
}

}  // namespace aleph
