#include "render/time/keyframe_check.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "render/cache/gather_at.h"

namespace aleph {

namespace {

constexpr int tile_pixels = 8;   // between probes where something moves
constexpr int coarse_tiles = 4;  // between probes elsewhere
/// A mover is near where it may hide so much of the hemisphere, relative to the accuracy.
constexpr float near_form_factor = 0.25f;
constexpr float noise_deviations = 1.5f;  // of a probe, by which it may differ although nothing happened
constexpr double deciding_noise = 0.25;   // of the gather that decides, over the accuracy
constexpr std::uint8_t still_bit = 1, moving_bit = 2;

/// The cosine-weighted share of a hemisphere that a sphere hides is at most (radius / distance)^2.
bool is_near(const KeyframeRisk& risk, const glm::vec3& position, float accuracy) {
    return std::ranges::any_of(risk.movers, [&](const BoundingSphere& mover) {
        const glm::vec3 way = position - mover.center;
        return mover.radius * mover.radius > near_form_factor * accuracy * glm::dot(way, way);
    });
}

}  // namespace

KeyframeRisk find_keyframe_risk(const ShadingScene& shading, const PosePlan& plan,
                                std::span<const ShadingScene* const> keyframes) {
    KeyframeRisk risk;
    risk.moving.resize(shading.instances.size());
    for (const int i : plan.instances) risk.moving[i] = 1;
    const auto add = [&](const ShadingScene& at) {
        for (const int i : plan.instances) {
            if (!at.instances[i].visible) continue;
            risk.movers.push_back(find_bounds(at.instances[i]).sphere);
            risk.movers.back().center += glm::vec3(at.anchor - shading.anchor);
        }
    };
    add(shading);
    for (const ShadingScene* keyframe : keyframes) add(*keyframe);
    return risk;
}

CheckedLight::CheckedLight(const IndirectContext& context, const KeyframeRisk& risk, const SampleHits& sample)
    : keyframes_(*context.carried),
      risk_(risk),
      sample_(sample),
      view_(context.view),
      anchor_(context.lighting.shading.anchor),
      rejected_((view_.width + tile_pixels - 1) / tile_pixels, (view_.height + tile_pixels - 1) / tile_pixels) {
    for (int y = 0; y < rejected_.height; ++y) {
        for (int x = 0; x < rejected_.width; ++x) add_probes(context, x, y);
    }
    for (const Probe& probe : probes_) reject(probe);
}

/// At most one surface that moves and one that stands still.
void CheckedLight::add_probes(const IndirectContext& context, int tile_x, int tile_y) {
    bool has_moving = false, has_still = false;
    const int end_x = std::min(view_.width, (tile_x + 1) * tile_pixels);
    const int end_y = std::min(view_.height, (tile_y + 1) * tile_pixels);
    for (int y = tile_y * tile_pixels; y < end_y; ++y) {
        for (int x = tile_x * tile_pixels; x < end_x; ++x) {
            const int instance = sample_.hits(x, y).instance;
            if (instance == no_index) continue;
            const bool moving = risk_.moving[instance] != 0;
            bool& has = moving ? has_moving : has_still;
            if (has) continue;
            const std::optional<PixelSurface> surface = find_surface(context, sample_, x, y);
            if (!surface || !surface->material.has_diffuse()) continue;
            has = true;
            const bool fine = moving || is_near(risk_, surface->point.position, context.accuracy(x, y));
            if (fine) {
                probes_.push_back({x, y, moving, 1});
            } else if (tile_x % coarse_tiles == 0 && tile_y % coarse_tiles == 0) {
                probes_.push_back({x, y, moving, coarse_tiles});
            }
        }
    }
}

void CheckedLight::reject(const Probe& probe) {
    const int x = probe.x / tile_pixels, y = probe.y / tile_pixels;
    visit_around(rejected_, x, y, probe.reach,
                 [&](int u, int v) { rejected_(u, v) |= probe.moving ? moving_bit : still_bit; });
}

bool CheckedLight::differs(const IrradianceCache& cache, const IndirectContext& context, const Probe& probe,
                           RayTask& task) const {
    const PixelSurface surface = *find_surface(context, sample_, probe.x, probe.y);
    const float accuracy = context.accuracy(probe.x, probe.y);
    const CacheQuery query{surface.point.position, surface.point.normal, accuracy, &task};
    const std::optional<Rgb> own = cache.interpolate(query), theirs = keyframes_.find(surface, accuracy, task);
    if (!own || !theirs) return false;
    const float ray_variance = cache.expect(query, context.max_radius)->ray_variance;  // it has records: `own`
    const auto is_beyond = [&, b = luminance(*theirs)](float a, int rays) {
        const float noise = std::sqrt(ray_variance / static_cast<float>(rays));
        return std::abs(a - b) > std::hypot(accuracy, noise_deviations * noise) * 0.5f * (a + b);
    };
    const int rays = choose_rays(context.settings, accuracy, ray_variance);
    if (!is_beyond(luminance(*own), rays)) return false;
    const int more = choose_rays_for_noise(ray_variance, deciding_noise * accuracy, rays, most_rays);
    thread_local GatherScratch scratch;
    const IrradianceSample sample = gather_at(context, task, surface, scratch, more);
    return is_beyond(luminance(sample.irradiance + sample.rare), more);
}

void CheckedLight::check(IrradianceCache& cache, const IndirectContext& context, FrameTally& frame) {
    const int count = static_cast<int>(probes_.size());
    Image<float> accuracy(count, 1);
    Image<FillPoint> points(count, 1);
    for (int i = 0; i < count; ++i) {
        const PixelSurface surface = *find_surface(context, sample_, probes_[i].x, probes_[i].y);
        points(i, 0) = make_fill_point(surface);
        accuracy(i, 0) = context.accuracy(probes_[i].x, probes_[i].y);
    }
    const IndirectContext at_probes = make_places_context(context, accuracy);
    const auto surface_at = [&](int i, int) { return *find_surface(context, sample_, probes_[i].x, probes_[i].y); };
    FrameTally tally;
    tally.records = tally.invalid_samples = Image<float>(count, 1);
    fill_places(cache, at_probes, {std::move(points), surface_at}, tally);
    IndirectContext alone = context;
    alone.direct = nullptr;
    std::vector<std::uint8_t> differ(probes_.size());
    cast_parallel(probes_.size(), 4, context.lighting.rays, tally.counts.rays, [&](int i, RayTask& task) {
        // Probes that another's record covers tell nothing new.
        differ[i] = tally.records(i, 0) > 0.0f && differs(cache, alone, probes_[i], task);
    });
    std::ranges::fill(rejected_.pixels, std::uint8_t{0});
    for (int i = 0; i < count; ++i) {
        if (differ[i]) reject(probes_[i]);
    }
    for (int i = 0; i < count; ++i) {
        frame.records(probes_[i].x, probes_[i].y) += tally.records(i, 0);
        frame.invalid_samples(probes_[i].x, probes_[i].y) += tally.invalid_samples(i, 0);
    }
    frame.counts.rays += tally.counts.rays;
    frame.counts.records += tally.counts.records;
    frame.counts.invalid_samples += tally.counts.invalid_samples;
}

std::optional<Rgb> CheckedLight::find(const PixelSurface& surface, float accuracy, RayTask& task,
                                      RecordUse* used) const {
    const glm::dvec3 place = to_camera(view_, glm::dvec3(surface.point.position) + anchor_);
    if (-place.z > view_.near_plane || view_.orthographic) {
        // Filters and lenses bring light from beyond the border: it has the verdict of the nearest tile.
        const glm::dvec2 tile = project_camera_point(view_, place) / static_cast<double>(tile_pixels);
        const glm::dvec2 last(rejected_.width - 1, rejected_.height - 1);
        const glm::dvec2 inside = glm::clamp(tile, glm::dvec2(0.0), last);
        const std::uint8_t bit = risk_.moving[surface.hit.instance] != 0 ? moving_bit : still_bit;
        if ((rejected_(static_cast<int>(inside.x), static_cast<int>(inside.y)) & bit) != 0) return std::nullopt;
    }
    return keyframes_.find(surface, accuracy, task, used);
}

}  // namespace aleph
