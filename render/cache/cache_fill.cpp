#include "render/cache/cache_fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <span>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cache/gather_at.h"

namespace aleph {

namespace {

constexpr int first_stride = 64;            // pixels, size of the first tiles
constexpr float least_reach_pixels = 0.7f;  // of a record at its own accuracy
constexpr int max_reviews = 16;             // passes over all pixels after the last tile size
/// A record may reach so much farther than expected: candidates within that wait.
constexpr float waiting_reach = 1.2f;
constexpr std::size_t lookup_grain = 256;  // look-ups per parallel chunk
/// Gathers between two reports of progress.
constexpr std::size_t checkpoint_gathers = 256;  // with a checkpoint, whatever the number of threads
constexpr std::size_t thread_gathers = 64;       // per thread
/// Candidates per thread whose reviews are made before any of them is accepted: some are made in vain.
constexpr std::size_t thread_reviews = 8;

/// A pixel whose sample is not covered yet.
struct Candidate {
    int x = 0, y = 0;
    CacheQuery query;
    RadiusBounds bounds;
    int rays = 0;  ///< of its gather
};

/// A record, unless its gather was not finite, and the direct light that it found for the cells of the grid.
struct Gathered {
    std::optional<IrradianceRecord> record;
    std::vector<DirectSample> direct;
    KeptRays rays;  ///< of FillPlaces::gathered
};

/// Corners of the tiles of this size that larger tiles do not share, where light is needed.
std::vector<glm::ivec2> list_tiles(const Image<FillPoint>& points, int stride, bool first_pass) {
    std::vector<glm::ivec2> tiles;
    for (int y = 0; y < points.height; y += stride) {
        for (int x = 0; x < points.width; x += stride) {
            const bool visited = first_pass && stride < first_stride && x % (2 * stride) == 0 && y % (2 * stride) == 0;
            if (!visited && points(x, y).footprint >= 0.0f) tiles.push_back({x, y});
        }
    }
    return tiles;
}

/// Rays of a candidate's record.
/// @param expected  nothing if it is the first
int choose_record_rays(const IndirectContext& context, const Candidate& candidate, float reflected,
                       const std::optional<ExpectedRecord>& expected) {
    const int rays = choose_rays(context.settings, candidate.query.accuracy,
                                 expected ? std::optional(expected->ray_variance) : std::nullopt);
    if (context.tolerance == nullptr || !expected) return rays;
    return add_rays_for_noise(rays, *expected, reflected, (*context.tolerance)(candidate.x, candidate.y),
                              candidate.bounds.min);
}

/// The tiles whose samples no record covers, in tile order.
std::vector<Candidate> find_uncovered(const IrradianceCache& cache, const IndirectContext& context,
                                      const Image<FillPoint>& points, const std::vector<glm::ivec2>& tiles,
                                      FrameCounts& counts) {
    std::vector<std::vector<Candidate>> found((tiles.size() + lookup_grain - 1) / lookup_grain);
    std::atomic<std::uint64_t> missed = 0;
    cast_parallel(tiles.size(), lookup_grain, context.lighting.rays, counts.rays, [&](int i, RayTask& task) {
        const int x = tiles[i].x, y = tiles[i].y;
        const FillPoint& point = points(x, y);
        const float accuracy = context.accuracy(x, y);
        const CacheQuery query{point.position, point.normal, accuracy, &task};
        if (cache.covers(query)) return;
        ++missed;
        found[i / lookup_grain].push_back(
            {x, y, {query.position, query.normal, accuracy}, radius_bounds(context, point.footprint, accuracy)});
    });
    counts.cache.lookups += tiles.size();
    counts.cache.hits += tiles.size() - missed;
    std::vector<Candidate> uncovered;
    for (const auto& chunk : found) uncovered.insert(uncovered.end(), chunk.begin(), chunk.end());
    return uncovered;
}

bool may_cover(const IrradianceCache& accepted, CacheQuery query) {
    query.accuracy *= waiting_reach;
    return accepted.covers(query);
}

/// The expected record of a candidate. Not made for those that will probably wait.
struct Review {
    bool is_made = false;
    std::optional<ExpectedRecord> expected;
};

std::vector<Review> review(const IrradianceCache& cache, const IrradianceCache& accepted,
                           std::span<const Candidate> candidates, float max_radius) {
    std::vector<Review> reviews(candidates.size());
    parallel_each(reviews.size(), 4, [&](std::size_t i) {
        if (!may_cover(accepted, candidates[i].query))
            reviews[i] = {true, cache.expect(candidates[i].query, max_radius)};
    });
    return reviews;
}

/// Takes those candidates out of `waiting` whose records are computed in this round. The others wait, because the
/// record of an accepted candidate may cover them. A record's radius is not known before its gather: the bound that
/// neighbour clamping sets is expected.
std::vector<Candidate> accept_candidates(const IrradianceCache& cache, const IndirectContext& context,
                                         const FillPlaces& places, std::vector<Candidate>& waiting) {
    IrradianceCache records = make_cache(context.lighting.shading);
    std::vector<Candidate> accepted, later;
    std::vector<Review> reviews;
    const std::size_t size = thread_reviews * static_cast<std::size_t>(thread_count());
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        if (i % size == 0)
            reviews = review(cache, records, std::span(waiting).subspan(i, std::min(size, waiting.size() - i)),
                             context.max_radius);
        Candidate& candidate = waiting[i];
        if (may_cover(records, candidate.query)) {
            later.push_back(candidate);
            continue;
        }
        const Review& own = reviews[i % size];
        const auto known = own.is_made ? own.expected : cache.expect(candidate.query, context.max_radius);
        const float radius = known ? known->radius : context.max_radius;
        records.insert({.position = candidate.query.position,
                        .radius = std::max(radius, candidate.bounds.min),
                        .normal = candidate.query.normal,
                        .min_radius = candidate.bounds.min,
                        .accuracy = candidate.query.accuracy});
        const float reflected = places.points(candidate.x, candidate.y).reflected;
        candidate.rays = places.rays > 0 ? choose_rays_for_noise(known ? known->ray_variance : 0.0f, places.noise,
                                                                 places.rays, places.most_rays)
                                         : choose_record_rays(context, candidate, reflected, known);
        accepted.push_back(candidate);
    }
    waiting = std::move(later);
    return accepted;
}

/// The candidates' records, computed in parallel.
std::vector<Gathered> gather_records(const IndirectContext& context, const FillPlaces& places,
                                     std::span<const Candidate> candidates, RayCounts& counts) {
    std::vector<Gathered> records(candidates.size());
    cast_parallel(candidates.size(), 1, context.lighting.rays, counts, [&](int i, RayTask& task) {
        thread_local GatherScratch scratch;
        const Candidate& candidate = candidates[i];
        const PixelSurface surface = places.surface_at(candidate.x, candidate.y);
        const IrradianceSample value = gather_at(context, task, surface, scratch, candidate.rays, &records[i].direct);
        records[i].record = make_record(candidate.query.position, candidate.query.normal, candidate.query.accuracy,
                                        value, candidate.bounds);
        if (places.gathered != nullptr) records[i].rays = keep_rays(scratch);
    });
    return records;
}

/// Results of gathers for a checkpoint.
FrameCheckpoint::Gathers save_gathers(std::span<const Gathered> gathered, const RayCounts& counts) {
    ByteWriter results, found;
    results.add(counts);
    for (const Gathered& one : gathered) {
        results.add(one.record.has_value());
        if (one.record) results.add(*one.record);
        found.add(one.direct);
    }
    return {results.take(), found.take()};
}

/// @param counts  increased by the rays of these gathers
void restore_gathers(const FrameCheckpoint::Gathers& saved, std::span<Gathered> gathered, RayCounts& counts) {
    ByteReader results(saved.results), found(saved.found);
    counts += results.read<RayCounts>();
    for (Gathered& one : gathered) {
        if (results.read<bool>()) one.record = results.read<IrradianceRecord>();
        if (!saved.found.empty()) one.direct = found.read_all<DirectSample>();
    }
    ALEPH_CHECK(results.is_good() && results.at_end(), fmt::format("{} gathers", gathered.size()));
}

/// The same in pieces, with a report of progress after each. With a checkpoint those are taken from it that an earlier
/// process has computed.
std::vector<Gathered> gather_in_pieces(const IndirectContext& context, const FillPlaces& places,
                                       std::span<const Candidate> candidates, FrameCheckpoint* checkpoint,
                                       RayCounts& counts) {
    const std::size_t size =
        checkpoint != nullptr ? checkpoint_gathers : thread_gathers * static_cast<std::size_t>(thread_count());
    const auto find_light = [&context] {
        ByteWriter out;
        if (context.direct != nullptr) out.add(context.direct->save());
        return out.take();
    };
    std::vector<Gathered> all(candidates.size());
    for (std::size_t begin = 0; begin < all.size(); begin += size) {
        const std::span<Gathered> piece = std::span(all).subspan(begin, std::min(size, all.size() - begin));
        if (checkpoint != nullptr && checkpoint->has_gathers()) {
            const FrameCheckpoint::Gathers& saved = checkpoint->next_gathers();
            restore_gathers(saved, piece, counts);
            // Before the first round that had not ended.
            const bool is_last = !saved.found.empty() || !checkpoint->has_gathers();
            if (!is_last || context.direct == nullptr) continue;
            const std::string light = checkpoint->take_shared_light();
            if (!light.empty()) context.direct->restore(ByteReader(light).read_all<DirectGrid::Cell>());
            continue;
        }
        RayCounts own;
        std::ranges::move(gather_records(context, places, candidates.subspan(begin, piece.size()), own), piece.begin());
        counts += own;
        if (checkpoint != nullptr) {
            checkpoint->add_gathers(save_gathers(piece, own));
            checkpoint->offer({}, find_light);
        }
        if (context.progress) context.progress(0.0, "fill");
    }
    return all;
}

/// Rounds over the tiles until every one is covered or has been tried. Returns the number of records added.
std::size_t fill_tiles(IrradianceCache& cache, const IndirectContext& context, FillPlaces& places,
                       std::vector<glm::ivec2> tiles, FrameTally& tally) {
    const std::size_t records_before = cache.records().size();
    while (!tiles.empty()) {
        std::vector<Candidate> waiting = find_uncovered(cache, context, places.points, tiles, tally.counts);
        if (waiting.empty()) break;
        const std::vector<Candidate> accepted = accept_candidates(cache, context, places, waiting);
        FrameCheckpoint* const checkpoint = places.gathered == nullptr ? context.checkpoint : nullptr;
        auto records = gather_in_pieces(context, places, accepted, checkpoint, tally.counts.rays);
        for (std::size_t i = 0; i < accepted.size(); ++i) {
            tally.records(accepted[i].x, accepted[i].y) += 1.0f;
            if (context.direct != nullptr) context.direct->insert(records[i].direct);
            if (records[i].record) {
                cache.insert(*records[i].record);
                if (places.gathered != nullptr) places.gathered->push_back(std::move(records[i].rays));
            } else {
                tally.invalid_samples(accepted[i].x, accepted[i].y) += 1.0f;
                ++tally.counts.invalid_samples;
            }
        }
        tally.counts.records += accepted.size();
        ++tally.counts.cache.rounds;
        if (checkpoint != nullptr) checkpoint->end_round();
        tiles.clear();
        for (const Candidate& candidate : waiting) tiles.push_back({candidate.x, candidate.y});
    }
    return cache.records().size() - records_before;
}

BoundingBox bounds_or_unit(const ShadingScene& shading) {
    const BoundingBox& bounds = shading.bounds.all;
    if (bounds.empty()) return {glm::vec3(-1.0f), glm::vec3(1.0f)};
    return bounds;
}

}  // namespace

RadiusBounds radius_bounds(const IndirectContext& context, float footprint, float accuracy) {
    const float alpha = std::clamp(accuracy, 1e-3f, 1.0f);
    const float pixels =
        std::max(static_cast<float>(context.settings.cache.min_radius_pixels), least_reach_pixels / alpha);
    const float min = std::min(pixels * footprint, context.max_radius);
    return {min, context.max_radius, footprint / std::sqrt(alpha)};
}

void fill_places(IrradianceCache& cache, const IndirectContext& context, FillPlaces places, FrameTally& tally) {
    const bool coarse = places.coarse_first;
    for (int stride = coarse ? first_stride : places.finest; stride >= places.finest; stride /= 2) {
        fill_tiles(cache, context, places, list_tiles(places.points, stride, coarse), tally);
    }
    // A new record near a wall shrinks its neighbours' radii, and pixels that they covered before are uncovered again.
    const bool reviews = coarse && context.tolerance == nullptr;
    for (int review = 0; reviews && review < max_reviews; ++review) {
        if (fill_tiles(cache, context, places, list_tiles(places.points, places.finest, false), tally) == 0) break;
    }
}

void fill_cache(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample, FrameTally& tally,
                int finest) {
    const auto surface_at = [&](int x, int y) { return *find_surface(context, sample, x, y); };
    fill_places(cache, context,
                {find_points(context, sample, finest, tally.counts.rays), surface_at, sample.place.index == 0, finest},
                tally);
}

IrradianceCache make_cache(const ShadingScene& shading) {
    const BoundingBox bounds = bounds_or_unit(shading);
    const glm::vec3 margin(1e-3f * glm::length(bounds.high - bounds.low));
    return {bounds.low - margin, bounds.high + margin};
}

float scene_radius(const ShadingScene& shading) {
    const BoundingBox bounds = bounds_or_unit(shading);
    return 0.5f * glm::length(bounds.high - bounds.low);
}

}  // namespace aleph
