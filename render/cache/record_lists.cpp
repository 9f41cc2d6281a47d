#include "render/cache/record_lists.h"

#include <algorithm>
#include <array>
#include <experimental/simd>
#include <glm/geometric.hpp>

#include "render/cache/record_index.h"

namespace aleph {

namespace {

constexpr std::size_t few_records = 16;  // a longer list is divided
constexpr int max_level = 7;
constexpr float rounding = 1.0f + 1e-5f;

}  // namespace

/// Divides cells until their lists are short.
class RecordLists::Builder {
  public:
    Builder(RecordLists& out, std::span<const IrradianceRecord> records) : out_(out), records_(records) {
        reaches_.reserve(records.size());
        for (const IrradianceRecord& record : records) {
            reaches_.push_back(rounding * RecordReach{record.radius, record.spread()}.at(out.accuracy_));
        }
    }

    void build() {
        std::vector<int> all(records_.size());
        glm::vec3 low(std::numeric_limits<float>::infinity()), high(-low);
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i] = static_cast<int>(i);
            low = glm::min(low, records_[i].position - reaches_[i]);
            high = glm::max(high, records_[i].position + reaches_[i]);
        }
        if (all.empty()) return;
        const glm::vec3 size = high - low;
        out_.center_ = 0.5f * (low + high);
        out_.half_size_ = 0.5f * std::max({size.x, size.y, size.z});
        divide(0, {out_.center_, out_.half_size_, 0}, all);
    }

  private:
    struct Cube {
        glm::vec3 center;
        float half_size;
        int level;
    };

    bool reaches(int record, const Cube& cube) const {
        const std::size_t i = static_cast<std::size_t>(record);
        const glm::vec3 off = glm::abs(records_[i].position - cube.center) - rounding * cube.half_size;
        const glm::vec3 outside = glm::max(off, 0.0f);
        return glm::dot(outside, outside) <= reaches_[i] * reaches_[i];
    }

    void divide(int cell, const Cube& cube, const std::vector<int>& listed) {
        if (listed.size() <= few_records || cube.level == max_level) return add_blocks(cell, listed);
        std::array<std::vector<int>, 8> parts;
        std::size_t sum = 0;
        const float half_size = 0.5f * cube.half_size;
        const auto cube_of = [&](int i) {
            return Cube{octant_center(i, cube.center, half_size), half_size, cube.level + 1};
        };
        for (int i = 0; i < 8; ++i) {
            for (const int record : listed)
                if (reaches(record, cube_of(i))) parts[i].push_back(record);
            sum += parts[i].size();
        }
        // Where records reach much of the cell, its parts have lists nearly as long, which take more time to make than
        // they save.
        if (sum > 3 * listed.size()) return add_blocks(cell, listed);
        const int first = static_cast<int>(out_.cells_.size());
        out_.cells_[cell].parts = first;
        out_.cells_.resize(out_.cells_.size() + 8);
        for (int i = 0; i < 8; ++i) divide(first + i, cube_of(i), parts[i]);
    }

    void add_blocks(int cell, const std::vector<int>& listed) {
        out_.cells_[cell].first = static_cast<int>(out_.blocks_.size());
        for (std::size_t begin = 0; begin < listed.size(); begin += lanes) {
            Block& block = out_.blocks_.emplace_back();
            for (std::size_t i = begin; i < std::min(begin + lanes, listed.size()); ++i)
                set(block, static_cast<int>(i - begin), listed[i]);
        }
        out_.cells_[cell].last = static_cast<int>(out_.blocks_.size());
    }

    void set(Block& block, int lane, int number) const {
        const IrradianceRecord& record = records_[static_cast<std::size_t>(number)];
        for (int axis = 0; axis < 3; ++axis) {
            block.position[axis][lane] = record.position[axis];
            block.normal[axis][lane] = record.normal[axis];
        }
        block.radius[lane] = record.radius;
        block.growth[lane] = record.growth;
        block.headroom[lane] = most_headroom(record);
        block.record[lane] = number;
    }

    RecordLists& out_;
    std::span<const IrradianceRecord> records_;
    std::vector<float> reaches_;
};

RecordLists::RecordLists(std::span<const IrradianceRecord> records, float accuracy) : accuracy_(accuracy) {
    Builder(*this, records).build();
}

const RecordLists::Cell& RecordLists::find_leaf(const glm::vec3& position) const {
    static constexpr Cell nothing{};
    const glm::vec3 off = glm::abs(position - center_);
    if (!(std::max({off.x, off.y, off.z}) <= half_size_)) return nothing;
    glm::vec3 center = center_;
    float half_size = half_size_;
    const Cell* cell = &cells_.front();
    while (cell->parts >= 0) {
        const int octant = octant_of(center, position);
        half_size *= 0.5f;
        center = octant_center(octant, center, half_size);
        cell = &cells_[static_cast<std::size_t>(cell->parts + octant)];
    }
    return *cell;
}

/// interpolation_error, with the same operations.
unsigned RecordLists::find_errors(const Block& block, const glm::vec3& position, const glm::vec3& normal,
                                  float accuracy, float (&errors)[lanes]) {
    using Lanes = std::experimental::simd<float, std::experimental::simd_abi::deduce_t<float, lanes>>;
    using std::experimental::max;
    const auto load = [](const float(&values)[lanes]) { return Lanes(values, std::experimental::vector_aligned); };
    const auto dot = [](const Lanes(&a)[3], const Lanes(&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    Lanes theirs[3], ours[3], offset[3], sum[3], turn[3];
    for (int axis = 0; axis < 3; ++axis) {
        theirs[axis] = load(block.normal[axis]);
        ours[axis] = normal[axis];
        offset[axis] = position[axis] - load(block.position[axis]);
        sum[axis] = ours[axis] + theirs[axis];
        turn[axis] = ours[axis] - theirs[axis];
    }
    const Lanes radius = load(block.radius), height = dot(offset, sum) * 0.5f, distance2 = dot(offset, offset);
    const Lanes error =
        max(max(sqrt(distance2) / radius, distance2 * load(block.growth)), sqrt(dot(turn, turn)) * inverse_root_two);
    const auto usable = dot(ours, theirs) > 0.0f && height >= -max_in_front * radius && height <= max_behind * radius &&
                        dot(offset, theirs) <= load(block.headroom) && error < accuracy;
    error.copy_to(errors, std::experimental::vector_aligned);
    unsigned bits = 0;
    for (int i = 0; i < lanes; ++i) bits |= static_cast<unsigned>(usable[i]) << i;
    return bits;
}

}  // namespace aleph
