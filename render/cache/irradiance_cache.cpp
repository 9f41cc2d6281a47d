#include "render/cache/irradiance_cache.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/parallel.h"
#include "render/surface/ray_task.h"

namespace aleph {

namespace {

/// Slope of neighbour clamping, in R_i per distance.
constexpr float clamp_slope = 1.0f;

/// Records are compared within this multiple of their reach: where shading uses both, and somewhat farther.
constexpr float comparison_reach = 2.0f;

/// Likewise, where records are averaged to lower their noise, and how many standard deviations they may differ.
constexpr float smoothing_reach = 2.0f, max_noise_difference = 2.5f;

/// Rare light is shared within this multiple of the least radius: with 12 pixels, three degrees at 31 pixels per
/// degree. Shared among fewer records it would be a faint spot, and still be seen.
constexpr float sharing_reach = 8.0f, sharing_cosine = 0.5f;
constexpr std::size_t sharing_records = 1024;  // whose shares are found in parallel before they are added in order

/// A record is expected to be like those within this multiple of their reach.
constexpr float expecting_reach = 4.0f;

/// A record that reaches no farther than pixels demand has at most so many times the mean light of those around. More
/// is a spot that may be smaller than its reach, as below a ball of glass.
constexpr float most_over_others = 8.0f;

/// Lists are made from the strictest accuracy on, this one at least, and for accuracies of this ratio.
constexpr float least_list = 0.01f, list_step = 2.0f;

/// A record of a looser pixel has more noise: it covers no pixel whose accuracy is smaller by more than this factor.
constexpr float max_looser = 1.5f;

/// Returns whether a ray passes between two points of surfaces. It is lifted off both.
bool is_in_sight(RayTask& task, const IrradianceRecord& record, const CacheQuery& query) {
    constexpr float lift = 0.02f;
    const float distance = glm::length(query.position - record.position);
    const glm::vec3 from = query.position + query.normal * (lift * distance);
    const glm::vec3 to = record.position + record.normal * (lift * distance);
    const float length = glm::length(to - from);
    if (!(length > 0.0f)) return true;
    ++task.counts.shadow;
    return !task.tracer.occluded({from + query.ray_shift, (to - from) / length, 0.0f, length});
}

/// Returns whether a record may be used for the query, by its error and by what may stand between.
bool is_usable(const IrradianceRecord& record, const CacheQuery& query, float error, float accuracy) {
    if (!(error < accuracy)) return false;
    if (!is_beyond_clearance(record, query.position)) return true;
    return query.task != nullptr && is_in_sight(*query.task, record, query);
}

/// Returns whether a record's value can be compared with another's, moved to its place.
bool is_comparable(const IrradianceRecord& from, const IrradianceRecord& to, float accuracy) {
    return glm::length(from.normal - to.normal) < accuracy * std::numbers::sqrt2_v<float> &&
           std::isfinite(interpolation_error(from, to.position, to.normal));
}

}  // namespace

float IrradianceCache::radius_bound(const glm::vec3& position, const glm::vec3& normal, float max_radius) const {
    float bound = max_radius;
    index_.visit(
        [&](const RecordIndex::Cell& cell) {
            return clamp_slope * cell.distance_to(position) + cell.min_radius < bound;
        },
        [&](int i) {
            const IrradianceRecord& other = records_[i];
            if (glm::dot(normal, other.normal) > 0.0f) {
                bound = std::min(bound, other.radius + clamp_slope * glm::length(position - other.position));
            }
            return true;
        });
    return bound;
}

/// Krivanek et al. 2006, section 4: the radii of two records differ by no more than their distance allows.
void IrradianceCache::clamp_to_neighbours(IrradianceRecord& record) {
    record.radius = radius_bound(record.position, record.normal, record.radius);
    record.radius = std::max(record.radius, record.min_radius);
    index_.visit(
        [&](const RecordIndex::Cell& cell) {
            return cell.most.radius > record.radius + clamp_slope * cell.distance_to(record.position);
        },
        [&](int i) {
            IrradianceRecord& other = records_[i];
            const float most = record.radius + clamp_slope * glm::length(record.position - other.position);
            if (other.radius > most && glm::dot(record.normal, other.normal) > 0.0f) {
                other.radius = std::max(most, other.min_radius);
                index_.lower_radius(other.position, other.radius);
            }
            return true;
        });
}

/// Shortens S_i of the new record and of those near it where they do not agree.
void IrradianceCache::compare_with_neighbours(IrradianceRecord& record) {
    max_accuracy_ = std::max(max_accuracy_, record.accuracy);
    const float reach = comparison_reach * record.accuracy * record.radius;
    index_.visit_near(record.position, comparison_reach * max_accuracy_, reach, [&](int i) {
        IrradianceRecord& other = records_[i];
        const float accuracy = comparison_reach * std::max(record.accuracy, other.accuracy);
        const float within = std::max(reach, comparison_reach * other.accuracy * other.radius);
        if (glm::length(record.position - other.position) > within) return true;
        if (!is_comparable(other, record, accuracy) || !is_comparable(record, other, accuracy)) return true;
        const float growth = measure_growth(record, other);
        record.growth = std::min(std::max(record.growth, growth), record.max_growth);
        other.growth = std::min(std::max(other.growth, growth), other.max_growth);
        return true;
    });
}

void IrradianceCache::insert(IrradianceRecord record) {
    lists_.clear();
    clamp_to_neighbours(record);
    compare_with_neighbours(record);
    ray_variances_ += record.noise.ray_variance;
    irradiances_ += luminance(record.irradiance + record.rare);
    records_.push_back(record);
    index_.add(record.position, {record.radius}, record.accuracy);
}

std::optional<ExpectedRecord> IrradianceCache::expect(const CacheQuery& query, float max_radius) const {
    if (records_.empty()) return std::nullopt;
    ExpectedRecord expected;
    float total = 0.0f;
    const float reach = expecting_reach * query.accuracy;
    index_.visit_near(query.position, reach, 0.0f, [&](int i) {
        const IrradianceRecord& record = records_[i];
        const float weight = 1.0f - glm::length(query.position - record.position) / (reach * record.radius);
        if (weight > 0.0f && glm::dot(query.normal, record.normal) > 0.0f) {
            expected.irradiance += weight * luminance(record.irradiance + record.rare);
            expected.ray_variance += weight * record.noise.ray_variance;
            total += weight;
        }
        return true;
    });
    if (total > 0.0f) {
        expected.irradiance /= total;
        expected.ray_variance /= total;
    } else {
        const auto count = static_cast<double>(records_.size());
        expected.irradiance = static_cast<float>(irradiances_ / count);
        expected.ray_variance = static_cast<float>(ray_variances_ / count);
    }
    expected.radius = radius_bound(query.position, query.normal, max_radius);
    return expected;
}

IrradianceRecord IrradianceCache::smoothed(const IrradianceRecord& record) const {
    const float accuracy = smoothing_reach * record.accuracy;
    IrradianceRecord smooth = record;
    smooth.irradiance = Rgb(0.0f);
    smooth.gradients = {};
    float total = 0.0f;
    index_.visit_near(record.position, accuracy, accuracy * record.radius, [&](int i) {
        const IrradianceRecord& other = records_[i];
        const float error = std::max(interpolation_error(other, record.position, record.normal),
                                     interpolation_error(record, other.position, other.normal));
        if (!(error < accuracy)) return true;
        if (is_beyond_clearance(other, record.position) || is_beyond_clearance(record, other.position)) return true;
        const Rgb value = extrapolate(other, record.position, record.normal);
        const float own = luminance(record.irradiance);
        const float larger = std::max(own, luminance(other.irradiance));
        if (std::abs(luminance(value) - own) > max_noise_difference * combined_noise(record, other) * larger) {
            return true;
        }
        const float weight = 1.0f - error / accuracy;
        smooth.irradiance += value * weight;
        for (int c = 0; c < 3; ++c) {
            smooth.gradients.translation[c] += other.gradients.translation[c] * weight;
            smooth.gradients.rotation[c] += other.gradients.rotation[c] * weight;
        }
        total += weight;
        return true;
    });
    if (!(total > 0.0f)) return record;
    smooth.irradiance /= total;
    for (int c = 0; c < 3; ++c) {
        smooth.gradients.translation[c] /= total;
        smooth.gradients.rotation[c] /= total;
    }
    return smooth;
}

template <class Visit>
void IrradianceCache::visit_alike(const IrradianceRecord& record, float reach, float cosine, const Visit& visit) const {
    index_.visit([&](const RecordIndex::Cell& cell) { return cell.distance_to(record.position) < reach; },
                 [&](int i) {
                     const IrradianceRecord& other = records_[i];
                     const bool is_near = glm::distance(record.position, other.position) < reach;
                     if (is_near && glm::dot(record.normal, other.normal) > cosine)
                         visit(i, luminance(other.irradiance));
                     return true;
                 });
}

std::vector<IrradianceCache::Share> IrradianceCache::find_shares(const std::vector<std::uint8_t>& takes,
                                                                 std::size_t from) const {
    const IrradianceRecord& record = records_[from];
    std::vector<Share> shares;
    if (record.rare == Rgb(0.0f)) return shares;
    float sum = 0.0f;
    visit_alike(record, sharing_reach * record.min_radius, sharing_cosine, [&](int to, float light) {
        if (takes[to] == 0) return;
        shares.push_back({to, light});
        sum += light;
    });
    const float even = 1.0f / static_cast<float>(shares.size());  // it is among them itself, or stands out
    for (Share& each : shares) each.share = sum > 0.0f ? each.share / sum : even;
    return shares;
}

void IrradianceCache::share_rare_light(std::size_t kept, const std::vector<std::uint8_t>& takes,
                                       std::vector<IrradianceRecord>& smooth) const {
    std::vector<std::vector<Share>> shares;
    for (std::size_t begin = kept; begin < records_.size(); begin += sharing_records) {
        shares.assign(std::min(sharing_records, records_.size() - begin), {});
        parallel_each(shares.size(), 16, [&](std::size_t i) { shares[i] = find_shares(takes, begin + i); });
        for (std::size_t i = 0; i < shares.size(); ++i) {
            for (const auto& [to, share] : shares[i]) smooth[to].irradiance += records_[begin + i].rare * share;
            smooth[begin + i].rare = Rgb(0.0f);
        }
    }
}

bool IrradianceCache::stands_out(int number) const {
    const IrradianceRecord& record = records_[number];
    if (record.radius > record.min_radius) return false;
    float sum = 0.0f;
    int count = 0;
    visit_alike(record, expecting_reach * record.accuracy * record.radius, 0.0f, [&](int other, float light) {
        if (other == number) return;
        sum += light;
        ++count;
    });
    return count > 0 && luminance(record.irradiance) * static_cast<float>(count) > most_over_others * sum;
}

void IrradianceCache::finish(std::size_t kept, bool leave_out) {
    std::vector<IrradianceRecord> smooth(records_.size());
    std::vector<std::uint8_t> takes(records_.size(), 0);  // whether it takes a share of rare light
    parallel_each(records_.size(), 64, [&](std::size_t i) {
        smooth[i] = i < kept ? records_[i] : smoothed(records_[i]);
        takes[i] = i >= kept && !(leave_out && stands_out(static_cast<int>(i))) ? 1 : 0;
    });
    share_rare_light(kept, takes, smooth);
    std::vector<IrradianceRecord> ordered;
    ordered.reserve(smooth.size());
    for (const int i : index_.ordered())
        if (i < static_cast<int>(kept) || takes[i] != 0) ordered.push_back(smooth[i]);
    restore(std::move(ordered));
}

void IrradianceCache::restore(std::vector<IrradianceRecord> records) {
    records_ = std::move(records);
    lists_.clear();
    index_ = index_.emptied();
    ray_variances_ = irradiances_ = 0.0;
    for (const IrradianceRecord& record : records_) {
        index_.add(record.position, {record.radius, record.spread()}, record.accuracy);
        max_accuracy_ = std::max(max_accuracy_, record.accuracy);
        ray_variances_ += record.noise.ray_variance;
        irradiances_ += luminance(record.irradiance + record.rare);
    }
}

void IrradianceCache::prepare() {
    lists_.clear();
    float strictest = 1.0f;
    for (const IrradianceRecord& record : records_) strictest = std::min(strictest, record.accuracy);
    std::vector<float> accuracies;
    for (float accuracy = shade_reach * std::max(strictest, least_list); accuracy < list_step; accuracy *= list_step)
        accuracies.push_back(std::min(accuracy, 1.0f));
    lists_.resize(accuracies.size());
    parallel_each(lists_.size(), 1, [&](std::size_t i) { lists_[i] = RecordLists(records_, accuracies[i]); });
}

bool IrradianceCache::covers(const CacheQuery& query) const {
    const float accuracy = std::min(query.accuracy, 1.0f);
    bool found = false;
    index_.visit_reaching(query.position, accuracy, [&](int i) {
        const IrradianceRecord& record = records_[i];
        if (record.accuracy > max_looser * accuracy) return true;
        found = is_usable(record, query, interpolation_error(record, query.position, query.normal), accuracy);
        return !found;
    });
    return found;
}

/// 0 where the record must not be used.
float IrradianceCache::weigh(const IrradianceRecord& record, const CacheQuery& query, float error, float accuracy) {
    return is_usable(record, query, error, accuracy) ? 1.0f - error / accuracy : 0.0f;
}

std::optional<Rgb> IrradianceCache::interpolate(const CacheQuery& query) const {
    const float accuracy = std::min(query.accuracy, 1.0f);
    Rgb sum(0.0f);
    float total = 0.0f;
    visit_usable(query, [&](int i, float weight) {
        const IrradianceRecord& record = records_[i];
        sum += extrapolate(record, query.position, query.normal) * weight;
        total += weight;
        if (query.used != nullptr)
            query.used->add({1.0f, weight, weight * RecordReach{record.radius, record.spread()}.at(accuracy)});
    });
    if (!(total > 0.0f)) return std::nullopt;
    return sum / total;
}

}  // namespace aleph
