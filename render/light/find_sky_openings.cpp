#include "render/light/find_sky_openings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <limits>

#include "engine/base/sampling.h"
#include "render/pixels/pixel_sequence.h"

namespace aleph {

namespace {

constexpr int first_paths = 256, usual_paths = 4096, most_paths = 65536, most_bounces = 3;
constexpr std::uint32_t path_key = 0x6f70656eu;  // no other random numbers have it
constexpr int grid = 32;                         // cells along each edge of the box
constexpr double most_escapes = 1.0 / 3.0;       // of the rays
/// With fewer, cells of a narrow opening are missed, whose light then comes by few samples; more paths are followed.
constexpr std::size_t enough_escapes = 256;
constexpr std::size_t least_escapes = 16;
constexpr double outliers = 0.01;  // of the places that the box leaves out, at each side
/// Openings of more than this share of the box are no openings.
constexpr float most_open = 0.35f;

/// Places that a short path met.
struct RoomPath {
    std::array<glm::vec3, most_bounces + 1> places;
    int count = 0;
    bool escaped = false;  ///< from the last place
    glm::vec3 direction{0.0f};
};

RoomPath follow(const LightingContext& context, RayTask& task, SurfacePlace place, RandomStream random) {
    RoomPath path;
    while (true) {
        path.places[path.count++] = place.ray_origin();
        if (path.count > most_bounces) return path;
        path.direction = make_basis(place.normal).to_world(sample_cosine_hemisphere(random.next_2d()));
        if (!(glm::dot(path.direction, place.geometric) > 0.0f)) return path;
        Ray ray{place.ray_origin(), path.direction};
        Rgb passed(1.0f);
        const Hit hit = find_beyond_sheets(context, task, ray, passed, task.counts.shadow);
        path.escaped = hit.instance == no_index;
        if (path.escaped) return path;
        place = make_surface_place(context.shading, hit, ray.direction);
    }
}

std::vector<RoomPath> follow_paths(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                   int count, RayCounts& counts) {
    std::vector<RoomPath> paths(static_cast<std::size_t>(count));
    cast_parallel(paths.size(), 64, context.rays, counts, [&](int i, RayTask& task) {
        const glm::vec2 at = lattice_point(i, count, {0.5f, 0.5f}) * glm::vec2(view.width, view.height);
        const auto x = static_cast<int>(at.x), y = static_cast<int>(at.y);
        if (centers.hits(x, y).instance == no_index) return;
        const PixelSurface surface = make_pixel_surface(context.shading, view, centers, x, y);
        paths[i] = follow(context, task, surface.point, RandomStream({path_key, 0, static_cast<std::uint32_t>(i), 0}));
    });
    return paths;
}

std::size_t count_escapes(const std::vector<RoomPath>& paths) {
    return static_cast<std::size_t>(std::ranges::count(paths, true, &RoomPath::escaped));
}

/// Few enough rays reach the sky for openings.
bool is_room(const std::vector<RoomPath>& paths) {
    std::size_t rays = 0;
    for (const RoomPath& path : paths) rays += static_cast<std::size_t>(path.count);
    return static_cast<double>(count_escapes(paths)) <= most_escapes * static_cast<double>(rays);
}

/// All but the outermost places.
void set_box(const std::vector<RoomPath>& paths, SkyOpenings& box) {
    std::array<std::vector<float>, 3> values;
    for (const RoomPath& path : paths)
        for (int i = 0; i < path.count; ++i)
            for (int axis = 0; axis < 3; ++axis) values[axis].push_back(path.places[i][axis]);
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::sort(values[axis]);
        const auto out = static_cast<std::size_t>(outliers * static_cast<double>(values[axis].size()));
        box.low[axis] = values[axis][out];
        box.high[axis] = values[axis][values[axis].size() - 1 - out];
    }
    const glm::vec3 margin(1e-3f * glm::length(box.high - box.low));
    box.low -= margin;
    box.high += margin;
}

/// Cells of a side, both ends included.
struct CellRange {
    int side = 0;
    glm::ivec2 low{grid}, high{-1};

    bool empty() const { return high.x < low.x || high.y < low.y; }
    void add(const CellRange& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    int area() const { return (high.x - low.x + 1) * (high.y - low.y + 1); }
    bool touches(const CellRange& other) const {
        return side == other.side && low.x <= other.high.x + 2 && other.low.x <= high.x + 2 &&
               low.y <= other.high.y + 2 && other.low.y <= high.y + 2;
    }
};

int growth(CellRange a, const CellRange& b) {
    const int apart = a.area() + b.area();
    a.add(b);
    return a.area() - apart;
}

/// Ranges that touch become one, and then those that grow least, until there are few.
void join(std::vector<CellRange>& ranges) {
    const auto join_two = [&](std::size_t i, std::size_t j) {
        ranges[i].add(ranges[j]);
        ranges.erase(ranges.begin() + static_cast<std::ptrdiff_t>(j));
    };
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        for (std::size_t j = 0; j < ranges.size(); ++j) {
            if (i == j || !ranges[i].touches(ranges[j])) continue;
            join_two(std::min(i, j), std::max(i, j));
            i = 0;
            j = 0;
        }
    }
    std::ranges::sort(ranges, std::greater{}, &CellRange::area);
    while (ranges.size() > SkyOpenings::most) {
        std::size_t a = 0, b = ranges.size() - 1;
        int least = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i + 1 < ranges.size(); ++i) {
            if (ranges[i].side == ranges[b].side && growth(ranges[i], ranges[b]) < least) {
                least = growth(ranges[i], ranges[b]);
                a = i;
            }
        }
        if (least == std::numeric_limits<int>::max()) {
            ranges.pop_back();
        } else {
            join_two(a, b);
        }
    }
}

/// The cells through which paths reach the sky.
std::vector<CellRange> find_open_cells(const std::vector<RoomPath>& paths, const SkyOpenings& box) {
    std::vector<bool> open(6 * grid * grid);
    const glm::vec3 size = box.high - box.low;
    for (const RoomPath& path : paths) {
        if (!path.escaped || !is_inside(box, path.places[path.count - 1])) continue;
        const BoxExit exit = leave_box(box, path.places[path.count - 1], path.direction);
        const auto [a, b] = other_axes(exit.side / 2);
        const glm::vec2 share = (exit.at - glm::vec2(box.low[a], box.low[b])) / glm::vec2(size[a], size[b]);
        const glm::ivec2 cell = glm::clamp(glm::ivec2(share * float{grid}), 0, grid - 1);
        open[(exit.side * grid + cell.y) * grid + cell.x] = true;
    }
    std::vector<CellRange> cells;
    for (int i = 0; i < 6 * grid * grid; ++i) {
        const glm::ivec2 cell(i % grid, i / grid % grid);
        if (open[i]) cells.push_back({i / (grid * grid), cell, cell});
    }
    return cells;
}

SkyOpening make_opening(const SkyOpenings& box, const CellRange& range) {
    const int axis = range.side / 2;
    const std::array<int, 2> along = other_axes(axis);
    SkyOpening opening{range.side, {}, {}, {}};
    for (int i = 0; i < 2; ++i) {
        const float low = box.low[along[i]], size = (box.high - box.low)[along[i]];
        opening.low[i] = low + size * static_cast<float>(range.low[i]) / grid;
        opening.high[i] = low + size * static_cast<float>(range.high[i] + 1) / grid;
    }
    for (int k = 0; k < 4; ++k) {
        glm::vec3& corner = opening.corners[k];
        corner[axis] = (range.side % 2 == 0 ? box.low : box.high)[axis];
        corner[along[0]] = (k == 1 || k == 2 ? opening.high : opening.low)[0];
        corner[along[1]] = (k >= 2 ? opening.high : opening.low)[1];
    }
    return opening;
}

/// The cells of a box that an opening of another one is in.
CellRange find_cells(const SkyOpenings& box, const SkyOpening& opening) {
    CellRange range{opening.side, {}, {}};
    const std::array<int, 2> along = other_axes(opening.side / 2);
    for (int i = 0; i < 2; ++i) {
        const float low = box.low[along[i]], cell = (box.high - box.low)[along[i]] / grid;
        // In this order NaN becomes 0.
        const auto place = [&](float at) { return std::fmin(std::fmax((at - low) / cell, 0.0f), float{grid}); };
        range.low[i] = static_cast<int>(std::floor(place(opening.low[i])));
        range.high[i] = static_cast<int>(std::ceil(place(opening.high[i]))) - 1;
    }
    return range;
}

void set_openings(std::vector<CellRange>& cells, SkyOpenings& box) {
    join(cells);
    box.openings.clear();
    for (const CellRange& range : cells) box.openings.push_back(make_opening(box, range));
}

}  // namespace

void add_openings(const SkyOpenings& other, std::optional<SkyOpenings>& openings) {
    if (!openings) {
        openings = other;
        return;
    }
    std::vector<CellRange> cells;
    for (const SkyOpenings* of : {static_cast<const SkyOpenings*>(&*openings), &other}) {
        for (const SkyOpening& opening : of->openings) {
            const CellRange range = find_cells(*openings, opening);
            if (!range.empty()) cells.push_back(range);
        }
    }
    set_openings(cells, *openings);
}

void move_openings(const glm::vec3& shift, SkyOpenings& openings) {
    openings.low += shift;
    openings.high += shift;
    for (SkyOpening& opening : openings.openings) {
        const auto [a, b] = other_axes(opening.side / 2);
        opening.low += glm::vec2(shift[a], shift[b]);
        opening.high += glm::vec2(shift[a], shift[b]);
        for (glm::vec3& corner : opening.corners) corner += shift;
    }
}

std::optional<SkyOpenings> find_sky_openings(const LightingContext& context, const CameraView& view,
                                             const SampleHits& centers, RayCounts& counts) {
    if (!context.lights.has_environment || context.shading.skipped.contains(Effect::direct_light)) return std::nullopt;
    if (!is_room(follow_paths(context, view, centers, first_paths, counts))) return std::nullopt;
    std::vector<RoomPath> paths = follow_paths(context, view, centers, usual_paths, counts);
    const std::size_t escapes = count_escapes(paths);
    if (escapes == 0 || !is_room(paths)) return std::nullopt;
    if (escapes < enough_escapes) {
        const auto count = static_cast<int>(usual_paths * enough_escapes / escapes);
        paths = follow_paths(context, view, centers, std::min(count, most_paths), counts);
    }
    if (count_escapes(paths) < least_escapes) return std::nullopt;
    SkyOpenings found;
    set_box(paths, found);
    std::vector<CellRange> ranges = find_open_cells(paths, found);
    set_openings(ranges, found);
    int open = 0;
    for (const CellRange& range : ranges) open += range.area();
    if (static_cast<float>(open) > most_open * 6 * grid * grid) return std::nullopt;
    return found;
}

}  // namespace aleph
