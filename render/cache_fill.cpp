#include "render/cache_fill.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include "engine/base/parallel.h"
#include "render/carried_point.h"

namespace aleph {

namespace {

constexpr int first_stride = 64;           // pixels, size of the first tiles
constexpr int max_reviews = 16;            // passes over all pixels after the last tile size
constexpr std::size_t lookup_grain = 256;  // look-ups per parallel chunk

/// Keeps the random numbers of gathers apart from those of direct light: combined with the seed by exclusive or. Any
/// constant but 0 would do.
constexpr std::uint32_t gather_seed_mask = 0x67617468u;

constexpr float place_cells = 256.0f;  // along each side of a triangle, for random numbers

/// A pixel whose sample is not covered yet.
struct Candidate {
    int x = 0, y = 0;
    CacheQuery query;
    RadiusBounds bounds;
};

/// Corners of the tiles of this size that larger tiles do not share, where light is needed.
/// @param dark  0 where light is known without records
std::vector<glm::ivec2> list_tiles(const Image<std::uint8_t>& dark, int stride, bool first_pass) {
    std::vector<glm::ivec2> tiles;
    for (int y = 0; y < dark.height; y += stride) {
        for (int x = 0; x < dark.width; x += stride) {
            const bool visited = first_pass && stride < first_stride && x % (2 * stride) == 0 && y % (2 * stride) == 0;
            if (!visited && dark(x, y) != 0) tiles.push_back({x, y});
        }
    }
    return tiles;
}

/// The surface that a pixel shows, in the pose whose light is wanted; nothing if it is not there.
std::optional<PixelSurface> find_surface(const IndirectContext& context, const SampleHits& sample, int x, int y) {
    const ShadingScene& wanted = context.lighting.shading;
    if (context.seen == nullptr) return make_pixel_surface(wanted, context.view, sample, x, y);
    PixelSurface surface = make_pixel_surface(*context.seen, context.view, sample, x, y);
    const std::optional<SurfacePoint> point = carry_point(wanted, surface.hit, surface.point);
    if (!point) return std::nullopt;
    surface.point = *point;
    return surface;
}

/// 1 for pixels that show a surface whose light is not known (CarriedLight), else 0.
Image<std::uint8_t> find_dark(const IndirectContext& context, const SampleHits& sample) {
    Image<std::uint8_t> dark(sample.hits.width, sample.hits.height, 0);
    parallel_rows(dark.height, 1, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < dark.width; ++x) {
                if (sample.hits(x, y).instance == no_index) continue;
                const std::optional<PixelSurface> surface = find_surface(context, sample, x, y);
                if (!surface || !surface->material.has_diffuse()) continue;
                dark(x, y) = context.carried == nullptr || !context.carried->find(*surface, context.accuracy(x, y));
            }
        }
    });
    return dark;
}

/// The tiles whose samples no record covers, in tile order.
std::vector<Candidate> find_uncovered(const IrradianceCache& cache, const IndirectContext& context,
                                      const SampleHits& sample, const std::vector<glm::ivec2>& tiles,
                                      FillStatistics& statistics) {
    std::vector<std::vector<Candidate>> found((tiles.size() + lookup_grain - 1) / lookup_grain);
    std::atomic<std::uint64_t> lookups{0};
    parallel_for(tiles.size(), lookup_grain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t asked = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const int x = tiles[i].x, y = tiles[i].y;
            const PixelSurface surface = *find_surface(context, sample, x, y);
            const float accuracy = context.accuracy(x, y);
            const CacheQuery query{surface.point.position, surface.point.normal, accuracy};
            ++asked;
            if (!cache.covers(query)) {
                found[begin / lookup_grain].push_back({x, y, query, radius_bounds(context, surface, accuracy)});
            }
        }
        lookups += asked;
    });
    std::vector<Candidate> uncovered;
    for (const auto& chunk : found) uncovered.insert(uncovered.end(), chunk.begin(), chunk.end());
    statistics.lookups += lookups;
    statistics.hits += lookups - uncovered.size();
    return uncovered;
}

/// Takes those candidates out of `waiting` whose records are computed in this round. The others wait, because the
/// record of an accepted candidate may cover them. A record's radius is not known before its gather: the bound that
/// neighbour clamping sets is expected.
std::vector<Candidate> accept_candidates(const IrradianceCache& cache, const IndirectContext& context,
                                         std::vector<Candidate>& waiting) {
    IrradianceCache expected = make_cache(context.lighting.shading);
    std::vector<Candidate> accepted, later;
    for (const Candidate& candidate : waiting) {
        if (expected.covers(candidate.query)) {
            later.push_back(candidate);
            continue;
        }
        IrradianceRecord record;
        record.position = candidate.query.position;
        record.normal = candidate.query.normal;
        record.min_radius = candidate.bounds.min;
        record.radius =
            std::max(cache.radius_bound(record.position, record.normal, context.max_radius), record.min_radius);
        expected.insert(record);
        accepted.push_back(candidate);
    }
    waiting = std::move(later);
    return accepted;
}

/// The candidates' records, computed in parallel; nothing for a gather that is not finite.
std::vector<std::optional<IrradianceRecord>> gather_records(const IndirectContext& context, const SampleHits& sample,
                                                            const std::vector<Candidate>& candidates,
                                                            RayCounts& counts) {
    std::vector<std::optional<IrradianceRecord>> records(candidates.size());
    std::mutex counts_mutex;
    parallel_for(candidates.size(), 1, [&](std::size_t begin, std::size_t end) {
        thread_local GatherScratch scratch;
        RayTask task(context.lighting.rays);
        for (std::size_t i = begin; i < end; ++i) {
            const Candidate& candidate = candidates[i];
            const PixelSurface surface = *find_surface(context, sample, candidate.x, candidate.y);
            const IrradianceSample value = gather_at(context, task, surface, scratch);
            records[i] = make_record(candidate.query.position, candidate.query.normal, value, candidate.bounds);
        }
        const std::lock_guard lock(counts_mutex);
        counts += task.counts;
    });
    return records;
}

/// Rounds over the tiles until every one is covered or has been tried. Returns the number of records added.
std::size_t fill_tiles(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample,
                       std::vector<glm::ivec2> tiles, FrameTally& tally) {
    const std::size_t records_before = cache.records().size();
    while (!tiles.empty()) {
        std::vector<Candidate> waiting = find_uncovered(cache, context, sample, tiles, tally.counts.cache);
        if (waiting.empty()) break;
        const std::vector<Candidate> accepted = accept_candidates(cache, context, waiting);
        const auto records = gather_records(context, sample, accepted, tally.counts.rays);
        for (std::size_t i = 0; i < accepted.size(); ++i) {
            tally.records(accepted[i].x, accepted[i].y) += 1.0f;
            if (records[i]) {
                cache.insert(*records[i]);
            } else {
                tally.invalid_samples(accepted[i].x, accepted[i].y) += 1.0f;
                ++tally.counts.invalid_samples;
            }
        }
        tally.counts.records += accepted.size();
        ++tally.counts.cache.rounds;
        tiles.clear();
        for (const Candidate& candidate : waiting) tiles.push_back({candidate.x, candidate.y});
    }
    return cache.records().size() - records_before;
}

/// Records have random numbers of their place: a surface at rest that a camera at rest sees has the same noise at every
/// time. Places are cells of a triangle, so that the last bits of a hit hardly ever matter. Without records, the noise
/// of every sample is its own.
RandomKey choose_key(const IndirectContext& context, const PixelSurface& surface) {
    const std::uint32_t seed = context.settings.seed ^ gather_seed_mask;
    if (!(context.settings.accuracy > 0.0)) {
        return {seed, context.frame, surface.pixel, static_cast<std::uint32_t>(surface.sample)};
    }
    const Hit& hit = surface.hit;
    const auto cell = [](float at) { return static_cast<std::uint32_t>(std::max(at, 0.0f) * place_cells); };
    return {seed, static_cast<std::uint32_t>(hit.instance), static_cast<std::uint32_t>(hit.primitive),
            cell(hit.u) << 16 | cell(hit.v)};
}

SceneBounds bounds_or_unit(const ShadingScene& shading) {
    const SceneBounds& bounds = shading.bounds;
    if (!(bounds.low.x <= bounds.high.x)) return {glm::vec3(-1.0f), glm::vec3(1.0f)};
    return bounds;
}

}  // namespace

IrradianceSample gather_at(const IndirectContext& context, RayTask& task, const PixelSurface& surface,
                           GatherScratch& scratch) {
    const RandomKey key = choose_key(context, surface);
    return gather_irradiance(context.lighting, task, surface.point, choose_strata(context.settings.gather), key,
                             scratch, std::max(0, context.settings.path_depth - 2));
}

RadiusBounds radius_bounds(const IndirectContext& context, const PixelSurface& surface, float accuracy) {
    const float min =
        static_cast<float>(context.settings.min_radius_pixels) * surface.footprint / std::clamp(accuracy, 1e-3f, 1.0f);
    return {std::min(min, context.max_radius), context.max_radius};
}

void fill_cache(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample, FrameTally& tally) {
    const Image<std::uint8_t> dark = find_dark(context, sample);
    const bool first_pass = sample.place.index == 0;
    for (int stride = first_pass ? first_stride : 1; stride >= 1; stride /= 2) {
        fill_tiles(cache, context, sample, list_tiles(dark, stride, first_pass), tally);
    }
    // A new record near a wall shrinks its neighbours' radii, and pixels that they covered before are uncovered again.
    // Without these reviews, shading would gather at each such pixel. Later samples look at every pixel anyway.
    for (int review = 0; first_pass && review < max_reviews; ++review) {
        if (fill_tiles(cache, context, sample, list_tiles(dark, 1, false), tally) == 0) break;
    }
}

IrradianceCache make_cache(const ShadingScene& shading) {
    const SceneBounds bounds = bounds_or_unit(shading);
    const glm::vec3 margin(1e-3f * glm::length(bounds.high - bounds.low));
    return {bounds.low - margin, bounds.high + margin};
}

float scene_radius(const ShadingScene& shading) {
    const SceneBounds bounds = bounds_or_unit(shading);
    return 0.5f * glm::length(bounds.high - bounds.low);
}

}  // namespace aleph
