#pragma once
// An octree over the records of an irradiance cache, by their numbers. A record goes into the cell whose size is about
// its reach, so that a look-up visits few cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace aleph {

/// How far a record may be used: at accuracy alpha, within alpha * radius and sqrt(alpha) * spread.
struct RecordReach {
    float radius = 0.0f, spread = std::numeric_limits<float>::infinity();  ///< m

    float at(float accuracy) const { return std::min(accuracy * radius, std::sqrt(accuracy) * spread); }
};

/// The part of a cube where a position is: bit i is set where it is above the center along axis i.
inline int octant_of(const glm::vec3& center, const glm::vec3& position) {
    return (position.x > center.x ? 1 : 0) | (position.y > center.y ? 2 : 0) | (position.z > center.z ? 4 : 0);
}

/// @param half_size  of the part
inline glm::vec3 octant_center(int octant, const glm::vec3& center, float half_size) {
    return center + half_size * glm::vec3(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1);
}

class RecordIndex {
  public:
    /// A cube of the octree.
    struct Cell {
        glm::vec3 center{0.0f};
        float half_size = 0.0f;
        /// At least the largest reach of all records in it and below; not lowered when records shrink.
        RecordReach most{0.0f, 0.0f};
        float min_radius = std::numeric_limits<float>::infinity();  ///< at most their least radius
        int first_record = -1;                                      ///< head of a list
        std::array<int, 8> children{-1, -1, -1, -1, -1, -1, -1, -1};

        /// m, 0 inside.
        float distance_to(const glm::vec3& position) const {
            return glm::length(glm::max(glm::abs(position - center) - half_size, 0.0f));
        }
    };

    /// @param low, high  box of the octree, m; records outside of it are found too, but more slowly
    RecordIndex(const glm::vec3& low, const glm::vec3& high);

    /// Adds the record whose number is that of the records before it.
    /// @param accuracy  alpha at which most look-ups will be: chooses the cell's size
    void add(const glm::vec3& position, const RecordReach& reach, float accuracy);

    /// Notes that a record's radius shrank.
    void lower_radius(const glm::vec3& position, float radius);

    /// Returns an index of the same box, without records.
    RecordIndex emptied() const;

    /// The records in an order in which those of one cell, and of cells beside each other, are together.
    std::vector<int> ordered() const;

    /// Calls visit_record(number) for the records of all cells that enter(cell) accepts, until it returns false. What
    /// is below a cell that is not accepted is left out. The root, where the records outside of the box are, always is.
    template <class EnterCell, class VisitRecord>
    void visit(const EnterCell& enter, const VisitRecord& visit_record) const {
        int stack[max_level * 8 + 8];
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Cell& cell = cells_[stack[--top]];
            for (int record = cell.first_record; record >= 0; record = members_[record].next) {
                if (!visit_record(record)) return;
            }
            for (const int child : cell.children) {
                if (child >= 0 && enter(cells_[child])) stack[top++] = child;
            }
        }
    }

    /// Calls visit_record(number) for every record whose reach at an accuracy, plus extra_reach, may hold a position.
    template <class VisitRecord>
    void visit_near(const glm::vec3& position, float accuracy, float extra_reach,
                    const VisitRecord& visit_record) const {
        const float root_accuracy = std::sqrt(accuracy);
        visit(
            [&](const Cell& cell) {
                const float most = std::min(accuracy * cell.most.radius, root_accuracy * cell.most.spread);
                const float reach = cell.half_size + most + extra_reach;
                const glm::vec3 off = glm::abs(position - cell.center);
                return std::max({off.x, off.y, off.z}) <= reach;
            },
            visit_record);
    }

    /// The same for the records whose reach holds the position, and hardly any other.
    template <class VisitRecord>
    void visit_reaching(const glm::vec3& position, float accuracy, const VisitRecord& visit_record) const {
        constexpr float rounding = 1.0f + 1e-5f;
        visit_near(position, accuracy, 0.0f, [&](int record) {
            const Member& member = members_[record];
            const glm::vec3 off = position - member.position;
            const float reach = member.most.at(accuracy);
            return glm::dot(off, off) > rounding * reach * reach || visit_record(record);
        });
    }

  private:
    static constexpr int max_level = 24;

    int add_child(int cell, int octant);

    /// The part that decides about most records, closer together in memory than the records.
    struct Member {
        glm::vec3 position{0.0f};
        RecordReach most;  ///< not lowered when the record shrinks
        int next = -1;     ///< in the same cell
    };

    std::vector<Cell> cells_;
    std::vector<Member> members_;
};

}  // namespace aleph
