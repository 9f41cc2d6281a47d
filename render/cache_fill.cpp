#include "render/cache_fill.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr int first_stride = 64;         // pixels between the samples of the first tiles
constexpr int most_reviews = 16;         // looks at all pixels after the last stride
constexpr std::size_t test_grain = 256;  // look-ups per parallel chunk

/// A pixel whose sample nothing covers yet.
struct Candidate {
    int x = 0, y = 0;
    CacheQuery query;
    RadiusBounds bounds;
};

/// The samples of a stride that coarser strides have not visited.
std::vector<glm::ivec2> list_tiles(int width, int height, int stride, bool first_pass) {
    std::vector<glm::ivec2> tiles;
    for (int y = 0; y < height; y += stride) {
        for (int x = 0; x < width; x += stride) {
            const bool visited = first_pass && stride < first_stride && x % (2 * stride) == 0 && y % (2 * stride) == 0;
            if (!visited) tiles.push_back({x, y});
        }
    }
    return tiles;
}

/// Which tiles' samples nothing covers, in tile order.
std::vector<Candidate> find_uncovered(const IrradianceCache& cache, const IndirectContext& context,
                                      const SampleHits& sample, const std::vector<glm::ivec2>& tiles,
                                      FillStatistics& statistics) {
    std::vector<std::vector<Candidate>> found((tiles.size() + test_grain - 1) / test_grain);
    std::atomic<std::uint64_t> lookups{0};
    parallel_for(tiles.size(), test_grain, [&](std::size_t begin, std::size_t end) {
        std::uint64_t asked = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const auto [x, y] = std::pair(tiles[i].x, tiles[i].y);
            if (sample.hits(x, y).instance == no_index) continue;
            const PixelSurface surface = make_pixel_surface(context.lighting.shading, context.view, sample, x, y);
            if (!needs_irradiance(sample, surface, x, y)) continue;
            const float accuracy = context.accuracy(x, y);
            const CacheQuery query{surface.point.position, surface.point.normal, accuracy};
            ++asked;
            if (!cache.covers(query)) {
                found[begin / test_grain].push_back({x, y, query, radius_bounds(context, surface, accuracy)});
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

/// Splits candidates into those gathered now and those that wait, since one before them may come to cover them. A
/// record's radius is not known before its gather; neighbour clamping bounds it, and that bound is what is expected.
std::vector<Candidate> accept_proposals(const IrradianceCache& cache, const IndirectContext& context,
                                        const IrradianceCache& empty, std::vector<Candidate>& waiting) {
    IrradianceCache expected = empty;
    std::vector<Candidate> accepted, later;
    for (const Candidate& candidate : waiting) {
        if (expected.covers(candidate.query)) {
            later.push_back(candidate);
            continue;
        }
        IrradianceRecord record;
        record.position = candidate.query.position;
        record.normal = candidate.query.normal;
        record.smallest_radius = candidate.bounds.smallest;
        record.radius = std::max(cache.radius_bound(record.position, record.normal, context.largest_radius),
                                 candidate.bounds.smallest);
        expected.insert(record);
        accepted.push_back(candidate);
    }
    waiting = std::move(later);
    return accepted;
}

}  // namespace

IrradianceSample gather_at(const IndirectContext& context, Tracer& tracer, const PixelSurface& surface, int x, int y,
                           int sample, GatherScratch& scratch, RayCounts& counts) {
    const std::uint32_t pixel =
        static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(context.view.width) + static_cast<std::uint32_t>(x);
    const RandomKey key{context.settings.seed ^ 0x67617468u, context.frame, pixel, static_cast<std::uint32_t>(sample)};
    return gather_irradiance(context.lighting, tracer, surface.point, choose_strata(context.settings.gather), key,
                             scratch, counts);
}

bool needs_irradiance(const SampleHits& sample, const PixelSurface& surface, int x, int y) {
    return sample.hits(x, y).instance != no_index && surface.material.has_diffuse();
}

RadiusBounds radius_bounds(const IndirectContext& context, const PixelSurface& surface, float accuracy) {
    const float smallest =
        static_cast<float>(context.settings.min_radius_pixels) * surface.footprint / std::clamp(accuracy, 1e-3f, 1.0f);
    return {std::min(smallest, context.largest_radius), context.largest_radius};
}

namespace {

/// Rounds over the tiles until something covers every one. Returns how many records that took.
std::size_t fill_tiles(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample,
                       int sample_index, std::vector<glm::ivec2> tiles, Image<float>& records, RayCounts& counts,
                       FillStatistics& statistics) {
    const IrradianceCache empty = make_cache(context.lighting.shading);
    const std::size_t records_before = cache.records().size();
    std::mutex counts_mutex;
    while (!tiles.empty()) {
        std::vector<Candidate> waiting = find_uncovered(cache, context, sample, tiles, statistics);
        if (waiting.empty()) break;
        const std::vector<Candidate> accepted = accept_proposals(cache, context, empty, waiting);
        std::vector<IrradianceRecord> added(accepted.size());
        parallel_for(accepted.size(), 1, [&](std::size_t begin, std::size_t end) {
            thread_local GatherScratch scratch;
            Tracer tracer(context.lighting.rays);
            RayCounts local;
            for (std::size_t i = begin; i < end; ++i) {
                const Candidate& candidate = accepted[i];
                const PixelSurface surface =
                    make_pixel_surface(context.lighting.shading, context.view, sample, candidate.x, candidate.y);
                const IrradianceSample value =
                    gather_at(context, tracer, surface, candidate.x, candidate.y, sample_index, scratch, local);
                added[i] = make_record(candidate.query.position, candidate.query.normal, value, candidate.bounds);
            }
            const std::lock_guard lock(counts_mutex);
            counts += local;
        });
        for (std::size_t i = 0; i < accepted.size(); ++i) {
            cache.insert(added[i]);
            records(accepted[i].x, accepted[i].y) += 1.0f;
        }
        ++statistics.rounds;
        tiles.clear();
        for (const Candidate& candidate : waiting) tiles.push_back({candidate.x, candidate.y});
    }
    return cache.records().size() - records_before;
}

}  // namespace

void fill_cache(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample, int sample_index,
                Image<float>& records, RayCounts& counts, FillStatistics& statistics) {
    const int width = sample.hits.width, height = sample.hits.height;
    const bool first_pass = sample_index == 0;
    for (int stride = first_pass ? first_stride : 1; stride >= 1; stride /= 2) {
        fill_tiles(cache, context, sample, sample_index, list_tiles(width, height, stride, first_pass), records, counts,
                   statistics);
    }
    // A record that finds a wall near shrinks its neighbours, and what they covered before lies bare: without another
    // look, shading would gather anew at each such pixel. Later samples look everywhere anyway.
    for (int again = 0; first_pass && again < most_reviews; ++again) {
        if (fill_tiles(cache, context, sample, sample_index, list_tiles(width, height, 1, false), records, counts,
                       statistics) == 0)
            break;
    }
}

namespace {

SceneBounds bounds_or_unit(const ShadingScene& shading) {
    const SceneBounds& bounds = shading.bounds;
    if (!(bounds.low.x <= bounds.high.x)) return {glm::vec3(-1.0f), glm::vec3(1.0f)};
    return bounds;
}

}  // namespace

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
