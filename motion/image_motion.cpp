#include "motion/image_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/base/errors.h"
#include "engine/base/opponent_color.h"
#include "engine/base/pixel_loops.h"
#include "engine/base/pyramid.h"

namespace aleph {

namespace {

constexpr int level_count = 3;                   // A(0..2)
constexpr int exhaustive_radius = 8;             // pixels of the coarsest level
constexpr std::array<int, 3> steps = {4, 2, 1};  // of the three-step search
constexpr int shortest_side = 8;                 // of a level that is searched
constexpr int rows_per_chunk = 8;
constexpr std::size_t spare_bytes = 4;  // a window's row is read as four bytes

/// In pixels of a level.
struct Offset {
    int x = 0, y = 0;
};

/// Smaller |d|^2 first, then dy, then dx: the first of equals wins.
bool comes_first(const Offset& a, const Offset& b) {
    const int a2 = a.x * a.x + a.y * a.y, b2 = b.x * b.x + b.y * b.y;
    if (a2 != b2) return a2 < b2;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

/// Offsets within a square, nearest first.
std::vector<Offset> list_offsets(int radius) {
    std::vector<Offset> offsets;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) offsets.push_back({x, y});
    }
    std::sort(offsets.begin(), offsets.end(), comes_first);
    return offsets;
}

/// Bits set in every byte of a row's differences.
void hamming_row(const std::uint8_t* a, const std::uint8_t* b, int count, std::uint8_t* out) {
    for (int x = 0; x < count; ++x) {
        const std::uint8_t bits = a[x] ^ b[x];
        const std::uint8_t pairs = static_cast<std::uint8_t>(bits - ((bits >> 1) & 0x55));
        const std::uint8_t fours = static_cast<std::uint8_t>((pairs & 0x33) + ((pairs >> 2) & 0x33));
        out[x] = static_cast<std::uint8_t>((fours + (fours >> 4)) & 0x0f);
    }
}

/// Best costs and offsets of some rows, and the rows of differences from which costs are summed.
struct ExhaustiveBuffers {
    std::vector<std::uint8_t> cost, difference;
    std::vector<std::int8_t> x, y;
};

/// Tries one offset on rows [begin, end): the 3x3 sums of what differs, kept where they are below the best so far.
void try_offset(const CensusLevel& now, const CensusLevel& other, const Offset& offset, int begin, int end,
                ExhaustiveBuffers& buffers) {
    const int first_x = std::max(0, -offset.x), last_x = std::min(now.width, now.width - offset.x);
    const int first_y = std::max(begin, -offset.y), last_y = std::min(end, now.height - offset.y);
    const int count = last_x - first_x;
    if (count <= 0 || first_y >= last_y) return;
    const auto stride = static_cast<std::size_t>(now.width + 2);
    // Differences of row y lie at slot (y + 1) % 3, of columns first_x - 1 to last_x.
    const auto slot = [&](int y) { return buffers.difference.data() + static_cast<std::size_t>((y + 1) % 3) * stride; };
    const auto fill = [&](int y) {
        hamming_row(now.row(y) + first_x - 1, other.row(y + offset.y) + first_x - 1 + offset.x, count + 2, slot(y));
    };
    fill(first_y - 1);
    fill(first_y);
    const auto ox = static_cast<std::int8_t>(offset.x), oy = static_cast<std::int8_t>(offset.y);
    for (int y = first_y; y < last_y; ++y) {
        fill(y + 1);
        const std::uint8_t *const r0 = slot(y - 1), *const r1 = slot(y), *const r2 = slot(y + 1);
        const std::size_t at = static_cast<std::size_t>(y - begin) * static_cast<std::size_t>(now.width) +
                               static_cast<std::size_t>(first_x);
        std::uint8_t* const cost = buffers.cost.data() + at;
        std::int8_t *const best_x = buffers.x.data() + at, *const best_y = buffers.y.data() + at;
        for (int x = 0; x < count; ++x) {
            const auto sum = static_cast<std::uint8_t>(r0[x] + r0[x + 1] + r0[x + 2] + r1[x] + r1[x + 1] + r1[x + 2] +
                                                       r2[x] + r2[x + 1] + r2[x + 2]);
            const bool better = sum < cost[x];
            cost[x] = better ? sum : cost[x];
            best_x[x] = better ? ox : best_x[x];
            best_y[x] = better ? oy : best_y[x];
        }
    }
}

/// The best offset of every pixel within the exhaustive radius.
Image<Offset> search_exhaustively(const CensusLevel& now, const CensusLevel& other) {
    static const std::vector<Offset> offsets = list_offsets(exhaustive_radius);
    Image<Offset> best(now.width, now.height);
    parallel_rows(now.height, rows_per_chunk, [&](int begin, int end) {
        const std::size_t count = (end - begin) * static_cast<std::size_t>(now.width);
        ExhaustiveBuffers buffers{std::vector<std::uint8_t>(count, 255),
                                  std::vector<std::uint8_t>(3 * static_cast<std::size_t>(now.width + 2)),
                                  std::vector<std::int8_t>(count), std::vector<std::int8_t>(count)};
        for (const Offset& offset : offsets) {
            try_offset(now, other, offset, begin, end, buffers);
        }
        Offset* const out = best.row(begin);
        for (std::size_t i = 0; i < count; ++i) out[i] = {buffers.x[i], buffers.y[i]};
    });
    return best;
}

/// Three bytes of a window's row, x - 1 to x + 1, in one word; the top byte is undefined.
std::uint32_t load_window_row(const CensusLevel& level, int x, int y) {
    std::uint32_t word;
    std::memcpy(&word, level.row(y) + x - 1, sizeof word);
    return word;
}

/// The 3x3 window around a pixel of frame N.
struct Window {
    std::uint32_t rows[3];
};

Window load_window(const CensusLevel& level, int x, int y) {
    return {{load_window_row(level, x, y - 1), load_window_row(level, x, y), load_window_row(level, x, y + 1)}};
}

int compute_cost(const Window& a, const Window& b) {
    constexpr std::uint32_t three_bytes = std::endian::native == std::endian::little ? 0x00ffffffu : 0xffffff00u;
    int cost = 0;
    for (int i = 0; i < 3; ++i) cost += std::popcount((a.rows[i] ^ b.rows[i]) & three_bytes);
    return cost;
}

/// Three steps of eight candidates each around the best offset so far.
Offset search_in_steps(const CensusLevel& now, const CensusLevel& other, int x, int y, Offset offset) {
    static constexpr std::array<Offset, 8> around = {
        {{0, -1}, {-1, 0}, {1, 0}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    const Window window = load_window(now, x, y);
    offset.x = std::clamp(offset.x, -x, now.width - 1 - x);
    offset.y = std::clamp(offset.y, -y, now.height - 1 - y);
    int best = compute_cost(window, load_window(other, x + offset.x, y + offset.y));
    for (const int step : steps) {
        if (best == 0 && offset.x == 0 && offset.y == 0) break;  // no other offset can win
        const Offset middle = offset;
        for (const Offset& direction : around) {
            const Offset candidate{middle.x + step * direction.x, middle.y + step * direction.y};
            const int tx = x + candidate.x, ty = y + candidate.y;
            if (tx < 0 || ty < 0 || tx >= now.width || ty >= now.height) continue;
            const int cost = compute_cost(window, load_window(other, tx, ty));
            if (cost > best || (cost == best && !comes_first(candidate, offset))) continue;
            best = cost;
            offset = candidate;
        }
    }
    return offset;
}

Image<Offset> refine(const CensusLevel& now, const CensusLevel& other, const Image<Offset>& coarse) {
    Image<Offset> fine(now.width, now.height);
    parallel_pixels(fine, rows_per_chunk, [&](int x, int y) {
        const Offset& half = coarse(x / 2, y / 2);
        fine(x, y) = search_in_steps(now, other, x, y, {2 * half.x, 2 * half.y});
    });
    return fine;
}

}  // namespace

CensusLevel make_census_level(const Image<float>& level) {
    const int w = level.width, h = level.height;
    CensusLevel census{w, h, {}};
    const auto stride = static_cast<std::size_t>(w + 2);
    census.bits.resize(stride * static_cast<std::size_t>(h + 2) + spare_bytes);
    const auto row_at = [&](int y) { return census.bits.data() + static_cast<std::size_t>(y + 1) * stride; };
    parallel_rows(h, rows_per_chunk, [&](int begin, int end) {
        std::vector<float> padded(3 * stride);  // rows y - 1 to y + 1, with a border
        for (int y = begin; y < end; ++y) {
            for (int k = 0; k < 3; ++k) {
                float* const row = padded.data() + static_cast<std::size_t>(k) * stride;
                std::copy_n(level.row(std::clamp(y + k - 1, 0, h - 1)), w, row + 1);
                row[0] = row[1];
                row[w + 1] = row[w];
            }
            const float *const up = padded.data(), *const here = up + stride, *const down = here + stride;
            std::uint8_t* const out = row_at(y);
            for (int x = 0; x < w; ++x) {
                const float center = here[x + 1];
                out[x + 1] = static_cast<std::uint8_t>((up[x] >= center) << 7 | (up[x + 1] >= center) << 6 |
                                                       (up[x + 2] >= center) << 5 | (here[x] >= center) << 4 |
                                                       (here[x + 2] >= center) << 3 | (down[x] >= center) << 2 |
                                                       (down[x + 1] >= center) << 1 | (down[x + 2] >= center) << 0);
            }
            out[0] = out[1];
            out[w + 1] = out[w];
        }
    });
    std::copy_n(row_at(0), stride, row_at(-1));
    std::copy_n(row_at(h - 1), stride, row_at(h));
    return census;
}

CensusPyramid make_census_pyramid(const Image<Rgb>& frame) {
    if (frame.empty()) throw InputError("", "image-based motion", "the frame has no pixels");
    const int side = std::min(frame.width, frame.height);
    int count = 1;
    while (count < level_count && side >= shortest_side << count) ++count;
    CensusPyramid pyramid;
    for (const Image<float>& level : make_gaussian_pyramid(compute_opponent(frame, OpponentChannel::a, false), count)) {
        pyramid.push_back(make_census_level(level));
    }
    return pyramid;
}

MotionField compute_image_motion(const CensusPyramid& now, const CensusPyramid& other) {
    if (now.empty() || other.empty()) throw InputError("", "image-based motion", "a frame has no pixels");
    const CensusLevel &finest = now.front(), &target = other.front();
    if (finest.width != target.width || finest.height != target.height) {
        throw InputError(
            "", "image-based motion",
            fmt::format("frames of {}x{} and {}x{} pixels", finest.width, finest.height, target.width, target.height));
    }
    MotionField field = make_motion_field(finest.width, finest.height, MotionValidity::valid);
    Image<Offset> offsets = search_exhaustively(now.back(), other.back());
    for (std::size_t level = now.size() - 1; level-- > 0;) offsets = refine(now[level], other[level], offsets);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const Offset& offset = offsets.pixels[i];
        field.displacement.pixels[i] = glm::dvec2(offset.x, offset.y);
        field.path_length.pixels[i] = std::hypot(offset.x, offset.y);
    }
    return field;
}

MotionField compute_image_motion(const Image<Rgb>& now, const Image<Rgb>& other) {
    return compute_image_motion(make_census_pyramid(now), make_census_pyramid(other));
}

}  // namespace aleph
