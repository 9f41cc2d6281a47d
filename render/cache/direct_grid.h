#pragma once
// Direct light that gathers share. The direct irradiance of a Lambert surface is averaged over small cells of space,
// so that gather rays which meet a cell that is already known cast no shadow ray.
//
// A cell is about as wide as the part of the surface that one gather ray represents, rounded to a power of two. Cells
// belong to one instance, or to one bright surface of it (bright_surfaces.h), and to one of six directions that its
// true normal can face most.
//
// The grid does not change while gathers run. A gather that meets a cell with too few samples computes one of its own,
// and notes it; after a round, the notes are inserted in the order of the records. So the light does not depend on the
// number of threads. The light is biased by averaging over the cell, and gathers that share a cell share its noise.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/color.h"

namespace aleph {

/// One sample of direct light in a cell.
struct DirectSample {
    std::uint64_t cell = 0;
    Rgb light{0.0f};  ///< radiance that a white Lambert surface scatters
    /// The same of further bounces, which is part of `light`; nothing if it is not known without noise.
    std::optional<Rgb> multi_bounce{};
};

class DirectGrid {
  public:
    /// Samples after which a cell's mean is used alone. Its noise is common to all gathers that meet the cell, so that
    /// it shows as a change of brightness of the whole picture.
    static constexpr std::uint32_t enough = 26;

    /// Sum and number of a cell's samples.
    struct Cell {
        std::uint64_t key = 0;  ///< 0: none
        Rgb sum{0.0f};          ///< of DirectSample::light
        std::uint32_t count = 0;
        std::uint32_t multi_bounce_count = 0;
        Rgb multi_bounce_sum{0.0f};  ///< of DirectSample::multi_bounce

        /// That of further samples need not be looked up.
        std::optional<Rgb> multi_bounce() const {
            if (multi_bounce_count == 0) return std::nullopt;
            return multi_bounce_sum / static_cast<float>(multi_bounce_count);
        }
    };

    /// @param unit  m, such as the scene's size: cells are as wide as it times a power of two
    explicit DirectGrid(float unit = 1.0f);

    /// The cell of a surface point; never 0.
    /// @param surface    a number for an instance, or a part of one
    /// @param position   m, relative to the instance's origin, so that the cells move along with it
    /// @param width      m, of the part of the surface that the ray represents
    std::uint64_t key_of(std::uint64_t surface, const glm::vec3& position, const glm::vec3& geometric,
                         float width) const;

    /// A cell with a count of 0 if there is none.
    const Cell& find(std::uint64_t key) const {
        std::uint64_t i = key & mask_;
        while (cells_[i].key != 0 && cells_[i].key != key) i = next_place(i, key);
        return cells_[i];
    }
    /// Fetches the cell's place in memory, for a find soon afterwards.
    void prefetch(std::uint64_t key) const { __builtin_prefetch(&cells_[key & mask_]); }

    /// Not while other threads use the grid. Samples that are not finite are left out.
    void insert(std::span<const DirectSample> samples);

    /// The cells that have samples, to go on with in another process.
    std::vector<Cell> save() const;
    void restore(const std::vector<Cell>& cells);

  private:
    std::uint64_t next_place(std::uint64_t i, std::uint64_t key) const { return (i + (key >> 40 | 1)) & mask_; }
    Cell& place_of(std::uint64_t key);
    void grow();

    /// Open addressing; a power of two of them, at most half used. Cells of one block are neighbours in memory too: the
    /// hits of a packet are found in few pages.
    std::vector<Cell> cells_;
    float inverse_unit_ = 1.0f;
    std::uint64_t mask_ = 0;
    std::size_t used_ = 0;
};

}  // namespace aleph
