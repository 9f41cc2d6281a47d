#include "engine/rays/refit.h"

#include <algorithm>
#include <numeric>

#include "engine/rays/state.h"

namespace aleph {
namespace {

/// Refitted boxes overlap more as neighbours drift apart; from about this factor a new tree pays off.
constexpr double max_spread_growth = 2.0;

constexpr std::size_t cluster_size = 32;

double half_area(const Bounds& box) {
    const glm::dvec3 d = box.high - box.low;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// The bits of a number below 1024 with two zeros between each.
std::uint32_t spread_bits(std::uint32_t v) {
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
}

/// Triangles along a Morton curve through their first corners.
std::vector<std::uint32_t> sort_neighbours(const std::vector<glm::uvec3>& triangles,
                                           const std::vector<glm::vec3>& points) {
    Bounds box;
    for (const glm::vec3& p : points) box.add(glm::dvec3(p));
    const glm::vec3 low(box.low), scale = 1023.0f / glm::max(glm::vec3(box.high) - low, glm::vec3(1e-30f));
    std::vector<std::uint32_t> codes(triangles.size());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const glm::vec3 cell = glm::clamp((points[triangles[i].x] - low) * scale, 0.0f, 1023.0f);
        codes[i] = spread_bits(static_cast<std::uint32_t>(cell.x)) |
                   spread_bits(static_cast<std::uint32_t>(cell.y)) << 1 |
                   spread_bits(static_cast<std::uint32_t>(cell.z)) << 2;
    }
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return codes[i]; });
    return order;
}

}  // namespace

RefitMesh::RefitMesh(const EmbreeDevice& device, const DeformingMesh& mesh) : device_(device), mesh_(mesh) {}

RefitMesh::Change RefitMesh::update(const std::vector<glm::dvec3>& positions) {
    if (positions.size() != mesh_.vertex_count || mesh_.triangles.empty()) return Change::unusable;
    bool moved = !current_;
    current_ = false;
    if (!are_traceable(positions)) return Change::unusable;
    points_.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec3 point(positions[i]);
        moved = moved || point != points_[i];
        points_[i] = point;
    }
    current_ = true;
    if (!moved) return Change::none;
    if (!is_filled() || measure_spread() > max_spread_growth * spread_) {
        build();
    } else {
        tree_->move(points_, mesh_.triangles);
    }
    return Change::moved;
}

void RefitMesh::build() {
    const TreeMesh mesh{{mesh_.place, false, mesh_.cutout}, points_, mesh_.triangles};
    tree_ = std::make_unique<TriangleTree>(device_, std::span(&mesh, 1), TriangleTree::Kind::refitted);
    neighbours_ = sort_neighbours(mesh_.triangles, points_);
    spread_ = measure_spread();
}

/// Area of the boxes about runs of neighbours, relative to that of the box of all points: a measure of the tree's lower
/// levels that does not depend on the size of the whole.
double RefitMesh::measure_spread() const {
    Bounds all;
    for (const glm::vec3& p : points_) all.add(glm::dvec3(p));
    double sum = 0.0;
    for (std::size_t begin = 0; begin < neighbours_.size(); begin += cluster_size) {
        Bounds box;
        const std::size_t end = std::min(begin + cluster_size, neighbours_.size());
        for (std::size_t i = begin; i < end; ++i)
            for (int corner = 0; corner < 3; ++corner)
                box.add(glm::dvec3(points_[mesh_.triangles[neighbours_[i]][corner]]));
        sum += half_area(box);
    }
    const double whole = half_area(all);
    return whole > 0.0 ? sum / whole : 0.0;
}

}  // namespace aleph
