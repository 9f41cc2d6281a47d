#pragma once
// The records of a finished irradiance cache for look-ups at one accuracy, or somewhat below it. Each leaf of an octree
// lists the records whose reach comes into it, and the errors of a list are found eight at a time.

#include <bit>
#include <span>
#include <vector>

#include "render/cache/irradiance_record.h"

namespace aleph {

class RecordLists {
  public:
    RecordLists() = default;
    /// @param accuracy  largest alpha of the look-ups
    RecordLists(std::span<const IrradianceRecord> records, float accuracy);

    float accuracy() const { return accuracy_; }

    /// Calls visit(number, error) for every record whose interpolation_error is below the accuracy, by number. A record
    /// is visited once.
    template <class Visit>
    void visit(const glm::vec3& position, const glm::vec3& normal, float accuracy, const Visit& visit) const {
        const Cell& leaf = find_leaf(position);
        for (int i = leaf.first; i < leaf.last; ++i) {
            const Block& block = blocks_[static_cast<std::size_t>(i)];
            alignas(32) float errors[lanes];
            unsigned usable = find_errors(block, position, normal, accuracy, errors);
            for (; usable != 0; usable &= usable - 1) {
                const int lane = std::countr_zero(usable);
                visit(block.record[lane], errors[lane]);
            }
        }
    }

  private:
    static constexpr int lanes = 8;

    /// Eight records; one that faces nowhere where there are fewer.
    struct alignas(32) Block {
        float position[3][lanes]{}, normal[3][lanes]{};
        float radius[lanes]{}, growth[lanes]{}, headroom[lanes]{};
        int record[lanes]{};
    };

    struct Cell {
        int parts = -1;           ///< the first of eight, by octant; -1: a leaf
        int first = 0, last = 0;  ///< blocks of a leaf
    };

    class Builder;

    const Cell& find_leaf(const glm::vec3& position) const;
    /// @return bit i: the error of record i is below the accuracy
    static unsigned find_errors(const Block& block, const glm::vec3& position, const glm::vec3& normal, float accuracy,
                                float (&errors)[lanes]);

    float accuracy_ = 0.0f;
    glm::vec3 center_{0.0f};
    float half_size_ = 0.0f;  ///< of the cube around all that records reach
    std::vector<Cell> cells_{Cell{}};
    std::vector<Block> blocks_;
};

}  // namespace aleph
