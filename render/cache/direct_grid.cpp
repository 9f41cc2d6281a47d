#include "render/cache/direct_grid.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <iterator>
#include <tuple>

#include "engine/base/parallel.h"
#include "engine/base/sampling.h"
#include "render/cache/gather.h"

namespace aleph {

namespace {

constexpr std::size_t first_capacity = 1u << 14;

/// Widths of a cell, along the normal: planes at round coordinates would lie between two cells, and rounding decide.
constexpr float plane_shift = 0.37f;

/// The nearest power of two to the width, as an exponent.
int level_of(float width) {
    const float bounded = std::clamp(width, 1e-18f, 1e18f);
    // Times root two: rounds the exponent instead of cutting it.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(bounded * 1.41421356f);
    return static_cast<int>(bits >> 23) - 127;
}

float power_of_two(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

/// Direction that the normal faces most: 0 to 5.
unsigned axis_of(const glm::vec3& n) {
    const glm::vec3 size = glm::abs(n);
    const unsigned axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (n[static_cast<int>(axis)] < 0.0f ? 1 : 0);
}

std::int64_t quantize(float x) {
    constexpr float limit = 1e9f;
    return static_cast<std::int64_t>(std::floor(std::clamp(x, -limit, limit)));
}

}  // namespace

DirectGrid::DirectGrid(float unit) : cells_(first_capacity), inverse_unit_(1.0f / unit), mask_(first_capacity - 1) {}

std::uint64_t DirectGrid::key_of(std::uint64_t surface, const glm::vec3& position, const glm::vec3& geometric,
                                 float width) const {
    const int level = level_of(width * inverse_unit_);
    const glm::vec3 at = position * inverse_unit_ * power_of_two(-level);
    const unsigned facing = axis_of(geometric);
    const int across = facing / 2 == 0 ? 1 : 0, along = facing / 2 == 2 ? 1 : 2;
    const std::int64_t a = quantize(at[across]), b = quantize(at[along]),
                       c = quantize(at[static_cast<int>(facing / 2)] + plane_shift);
    // Blocks of 8 x 8 cells in the plane that the surface is next to.
    const std::uint64_t side = surface * 6 + facing;
    const std::uint64_t block = static_cast<std::uint64_t>(a >> 3) * 0x9e3779b97f4a7c15ull +
                                static_cast<std::uint64_t>(b >> 3) * 0xc2b2ae3d27d4eb4full +
                                static_cast<std::uint64_t>(c) * 0x165667b19e3779f9ull + side * 0xd6e8feb86659fd93ull +
                                static_cast<std::uint64_t>(level + 128) * 0xa0761d6478bd642full;
    constexpr std::uint64_t used = 1ull << 63;
    return used | (mix_bits(block) & ~63ull) | static_cast<std::uint64_t>((a & 7) | (b & 7) << 3);
}

DirectGrid::Cell& DirectGrid::place_of(std::uint64_t key) {
    return const_cast<Cell&>(find(key));
}

void DirectGrid::grow() {
    std::vector<Cell> old(2 * cells_.size());
    old.swap(cells_);
    mask_ = cells_.size() - 1;
    // Where a cell lies depends on which is first; what is found does not.
    parallel_each(old.size(), 4096, [&](std::size_t i) {
        const Cell& cell = old[i];
        if (cell.key == 0) return;
        std::uint64_t at = cell.key & mask_, none = 0;
        for (; !std::atomic_ref(cells_[at].key).compare_exchange_strong(none, cell.key); none = 0)
            at = next_place(at, cell.key);
        Cell& place = cells_[at];
        std::tie(place.sum, place.count) = std::tie(cell.sum, cell.count);
        std::tie(place.multi_bounce_sum, place.multi_bounce_count) =
            std::tie(cell.multi_bounce_sum, cell.multi_bounce_count);
    });
}

std::vector<DirectGrid::Cell> DirectGrid::save() const {
    std::vector<Cell> cells;
    std::ranges::copy_if(cells_, std::back_inserter(cells), [](const Cell& cell) { return cell.key != 0; });
    return cells;
}

void DirectGrid::restore(const std::vector<Cell>& cells) {
    cells_.assign(std::max(first_capacity, std::bit_ceil(2 * (cells.size() + 1))), {});
    mask_ = cells_.size() - 1;
    for (const Cell& cell : cells) place_of(cell.key) = cell;
    used_ = cells.size();
}

void DirectGrid::insert(std::span<const DirectSample> samples) {
    for (const DirectSample& sample : samples) {
        if (!is_finite(sample.light)) continue;
        if (2 * (used_ + 1) > cells_.size()) grow();
        Cell& cell = place_of(sample.cell);
        if (cell.key == 0) ++used_;
        cell.key = sample.cell;
        cell.sum += sample.light;
        ++cell.count;
        if (sample.multi_bounce) {
            cell.multi_bounce_sum += *sample.multi_bounce;
            ++cell.multi_bounce_count;
        }
    }
}

}  // namespace aleph
