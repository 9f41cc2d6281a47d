#include "render/cache/record_index.h"

namespace aleph {

RecordIndex::RecordIndex(const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 size = high - low;
    Cell root;
    root.center = 0.5f * (low + high);
    root.half_size = std::max({0.5f * size.x, 0.5f * size.y, 0.5f * size.z, 1e-6f});
    cells_.push_back(root);
}

int RecordIndex::add_child(int cell, int octant) {
    Cell added;
    added.half_size = 0.5f * cells_[cell].half_size;
    added.center = octant_center(octant, cells_[cell].center, added.half_size);
    cells_[cell].children[octant] = static_cast<int>(cells_.size());
    cells_.push_back(added);
    return cells_[cell].children[octant];
}

void RecordIndex::add(const glm::vec3& position, const RecordReach& reach, float accuracy) {
    const glm::vec3 off = glm::abs(position - cells_[0].center);
    const bool inside = std::max({off.x, off.y, off.z}) <= cells_[0].half_size;
    const float size = reach.at(accuracy);
    int cell = 0;
    for (int level = 0;; ++level) {
        Cell& here = cells_[cell];
        here.most.radius = std::max(here.most.radius, reach.radius);
        here.most.spread = std::max(here.most.spread, reach.spread);
        here.min_radius = std::min(here.min_radius, reach.radius);
        if (!inside || level == max_level || here.half_size * 0.5f < size) break;
        const int octant = octant_of(here.center, position);
        const int child = here.children[octant];
        cell = child >= 0 ? child : add_child(cell, octant);
    }
    members_.push_back({position, reach, cells_[cell].first_record});
    cells_[cell].first_record = static_cast<int>(members_.size()) - 1;
}

void RecordIndex::lower_radius(const glm::vec3& position, float radius) {
    for (int cell = 0; cell >= 0; cell = cells_[cell].children[octant_of(cells_[cell].center, position)]) {
        cells_[cell].min_radius = std::min(cells_[cell].min_radius, radius);
    }
}

RecordIndex RecordIndex::emptied() const {
    RecordIndex index({}, {});
    index.cells_[0].center = cells_[0].center;
    index.cells_[0].half_size = cells_[0].half_size;
    return index;
}

std::vector<int> RecordIndex::ordered() const {
    std::vector<int> order;
    order.reserve(members_.size());
    visit([](const Cell&) { return true; },
          [&](int record) {
              order.push_back(record);
              return true;
          });
    return order;
}

}  // namespace aleph
