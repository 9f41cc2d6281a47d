#include "render/cache/further_bounces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/base/parallel.h"
#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr int most_links = 4;                // records that the irradiance of a hit is interpolated from
constexpr int most_random_rays = 16;         // one after the other, until one hits a place with records around
constexpr float negligible_change = 1e-5f;   // of any place's irradiance, by one bounce more
constexpr std::size_t reported_chunks = 64;  // per thread, between two reports of progress

/// A share of the irradiance of a place.
struct Link {
    int place = 0;
    float weight = 0.0f;

    bool operator==(const Link&) const = default;
};

/// Irradiance that arrives at a place of what one FurtherLight asks for.
struct LinkedLight {
    int ray = 0;       ///< that found it
    Rgb weight{0.0f};  ///< of a unit of the irradiance there
    std::array<Link, most_links> links{};

    bool is_linked() const { return links != std::array<Link, most_links>{}; }
};

/// A record, or a hit without records around: then it has one ray.
struct Place {
    RandomKey key;     ///< of a hit
    Rgb direct{0.0f};  ///< irradiance of one bounce
    std::vector<LinkedLight> linked;
};

/// Takes out what the rays of a place did not look up. Weights become those of the place's irradiance.
std::vector<FurtherLight> take_further(KeptRays& found) {
    const float per_share = pi / static_cast<float>(found.strata.count());
    for (FurtherLight& further : found.further) further.weight *= per_share;
    return std::exchange(found.further, {});
}

class LightTransport {
  public:
    LightTransport(const IndirectContext& context, const IrradianceCache& cache, float accuracy,
                   std::vector<KeptRays> gathered, int bounces, RayCounts& counts)
        : context_(context), cache_(cache), accuracy_(accuracy), counts_(counts), gathered_(std::move(gathered)) {
        places_.resize(gathered_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            unlinked_.push_back(take_further(gathered_[i]));
            places_[i].direct = cache.records()[i].irradiance;
        }
        std::size_t done = 0;
        for (int left = std::min(bounces - 1, most_random_rays); left > 0 && done < places_.size(); --left) {
            const std::size_t end = places_.size();
            link_places(done);
            add_random_places(done);
            done = end;
        }
        unlinked_.clear();
        for (const Place& place : places_) irradiance_.push_back(place.direct);
        for (int bounce = 2; bounce < bounces; ++bounce) {
            if (!add_bounce()) break;
        }
    }

    /// The last bounce, with the gradients of all.
    std::vector<IrradianceRecord> make_records() {
        std::vector<IrradianceRecord> records = cache_.records();
        parallel_each(records.size(), 16, [&](std::size_t i) {
            thread_local GatherScratch scratch;
            restore_rays(gathered_[i], scratch);
            const float per_share = pi / static_cast<float>(scratch.strata.count());
            for (const LinkedLight& light : places_[i].linked) scratch.light[light.ray] += arrive(light) / per_share;
            set_light(add_up_rays(scratch.strata, records[i].normal, scratch), records[i]);
        });
        return records;
    }

  private:
    /// Links what the rays of these places found to records.
    void link_places(std::size_t first) {
        cast_in_pieces(places_.size() - first, 16,
                       [&](std::size_t i, RayTask& task) { link_place(places_[first + i], unlinked_[i], task); });
    }

    /// cast_parallel, with reports of progress.
    template <class Function>
    void cast_in_pieces(std::size_t count, std::size_t grain, const Function& function) {
        const std::size_t size = reported_chunks * grain * static_cast<std::size_t>(thread_count());
        for (std::size_t begin = 0; begin < count; begin += size) {
            cast_parallel(std::min(size, count - begin), grain, context_.lighting.rays, counts_,
                          [&](int i, RayTask& task) { function(begin + static_cast<std::size_t>(i), task); });
            if (context_.progress) context_.progress(0.0, "fill");
        }
    }

    /// @param found  what its rays found; what has no link is left
    void link_place(Place& place, std::vector<FurtherLight>& found, RayTask& task) const {
        std::vector<FurtherLight> unlinked;
        place.linked.reserve(found.size());
        for (const FurtherLight& further : found) {
            LinkedLight& light = place.linked.emplace_back();
            light.ray = further.ray;
            // One that is not finite would spoil all places.
            if (is_finite(further.weight)) {
                light.weight = further.weight;
                light.links = find_links(further.place, accuracy_, task);
                if (!light.is_linked()) light.links = find_links(further.place, gap_reach * accuracy_, task);
            }
            if (!light.is_linked()) unlinked.push_back(further);
        }
        found = std::move(unlinked);
    }

    /// The records of most weight; none where there is no record.
    std::array<Link, most_links> find_links(const SurfacePlace& at, float accuracy, RayTask& task) const {
        std::array<Link, most_links> links{};
        cache_.visit_usable({at.position, at.normal, accuracy, &task}, [&](int i, float weight) {
            Link& least = *std::ranges::min_element(links, {}, &Link::weight);
            if (weight > least.weight) least = {i, weight};
        });
        float total = 0.0f;
        for (const Link& link : links) total += link.weight;
        if (total > 0.0f) {
            for (Link& link : links) link.weight /= total;
        }
        return links;
    }

    /// Chooses from the parts of a place that were not linked. Of a place with one ray, one part stands for all or for
    /// nothing, by Russian roulette: else their number could grow from ray to ray. The largest channel decides, so that
    /// no channel's weight grows along a chain of places.
    std::vector<std::size_t> choose_unlinked(std::size_t i, const std::vector<LinkedLight*>& parts) const {
        std::vector<std::size_t> all(parts.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        if (i < cache_.records().size() || all.empty()) return all;
        float total = 0.0f;
        for (const LinkedLight* part : parts) total += largest_channel(part->weight);
        float left = RandomStream(places_[i].key).next() * std::max(total, 1.0f);
        for (const std::size_t k : all) {
            const float weight = largest_channel(parts[k]->weight);
            left -= weight;
            if (!(left < 0.0f)) continue;
            parts[k]->weight *= std::max(total, 1.0f) / weight;
            return {k};
        }
        return {};
    }

    /// Adds a place for everything that was not linked.
    void add_random_places(std::size_t first) {
        std::vector<const FurtherLight*> lit;
        for (std::size_t i = first, end = places_.size(); i < end; ++i) {
            std::vector<LinkedLight*> parts;
            for (LinkedLight& light : places_[i].linked) {
                if (!light.is_linked()) parts.push_back(&light);
            }
            for (const std::size_t k : choose_unlinked(i, parts)) {
                parts[k]->links[0] = {static_cast<int>(end + lit.size()), 1.0f};
                lit.push_back(&unlinked_[i - first][k]);
            }
        }
        std::vector<std::vector<FurtherLight>> unlinked(lit.size());
        std::vector<Place> added(lit.size());
        const GatherOptions options{
            .depth = std::max(0, context_.settings.light.path_depth - 2 - context_.bounces.before),
            .multi_bounce = context_.bounces.further};
        cast_in_pieces(added.size(), 64, [&](std::size_t i, RayTask& task) {
            thread_local GatherScratch scratch;
            added[i].direct =
                gather_irradiance(context_.lighting, task, lit[i]->place, {{}, lit[i]->key}, scratch, options)
                    .irradiance;
            if (!is_finite(added[i].direct)) added[i].direct = Rgb(0.0f);
            added[i].key = lit[i]->key;
            ++added[i].key.seed;
            KeptRays found = keep_rays(scratch);
            unlinked[i] = take_further(found);
        });
        unlinked_ = std::move(unlinked);
        std::ranges::move(added, std::back_inserter(places_));
    }

    Rgb arrive(const LinkedLight& light) const {
        Rgb irradiance(0.0f);
        for (const Link& link : light.links) irradiance += irradiance_[link.place] * link.weight;
        return light.weight * irradiance;
    }

    /// Returns whether the light of the bounce matters.
    bool add_bounce() {
        std::vector<Rgb> next(places_.size());
        parallel_each(places_.size(), 64, [&](std::size_t i) {
            next[i] = places_[i].direct;
            for (const LinkedLight& light : places_[i].linked) next[i] += arrive(light);
        });
        next.swap(irradiance_);
        return !std::ranges::equal(next, irradiance_, [](const Rgb& before, const Rgb& after) {
            return luminance(after) - luminance(before) <= negligible_change * luminance(after);
        });
    }

    /// Keeps how far the record is used.
    void set_light(const IrradianceSample& sample, IrradianceRecord& record) const {
        const RadiusBounds bounds{record.min_radius, context_.max_radius, 1.0f / std::sqrt(record.max_growth)};
        const auto lit = make_record(record.position, record.normal, record.accuracy, sample, bounds);
        if (!lit) return;
        record.irradiance = lit->irradiance;
        record.gradients = lit->gradients;
        record.noise.error = lit->noise.error;
    }

    const IndirectContext& context_;
    const IrradianceCache& cache_;
    const float accuracy_;
    RayCounts& counts_;
    std::vector<KeptRays> gathered_;                   ///< of the records
    std::vector<Place> places_;                        ///< records first
    std::vector<std::vector<FurtherLight>> unlinked_;  ///< of the places that were added last
    std::vector<Rgb> irradiance_;                      ///< of places
};

}  // namespace

std::vector<IrradianceRecord> add_bounces(const IndirectContext& context, const IrradianceCache& cache, float accuracy,
                                          std::vector<KeptRays> gathered, int bounces, RayCounts& counts) {
    return LightTransport(context, cache, accuracy, std::move(gathered), bounces, counts).make_records();
}

}  // namespace aleph
