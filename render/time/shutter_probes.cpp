#include "render/time/shutter_probes.h"

#include <algorithm>
#include <cmath>

#include "engine/base/sampling.h"
#include "render/path/path.h"
#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr int paths_per_place = 16;
constexpr float sure = 2.0f;                                 // standard errors
constexpr PathLimits path_limits{.bounces = 2, .depth = 6};  // after the first turn
constexpr std::uint32_t probe_key = 0x70726f62u;             // no other random numbers have it

float probe_place(const LightingContext& lighting, RayTask& task, const SurfacePoint& point, int i) {
    const Basis basis = make_basis(point.normal);
    Rgb sum(0.0f);
    for (int k = 0; k < paths_per_place; ++k) {
        RandomStream random({probe_key, 0, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)});
        const glm::vec3 direction = basis.to_world(sample_cosine_hemisphere(random.next_2d()));
        if (!(glm::dot(direction, point.geometric) > 0.0f)) continue;
        ++task.counts.shadow;
        sum += follow_ray(lighting, task, {point.ray_origin(), direction}, start_indirect(path_limits, lighting.around),
                          random);
    }
    return luminance(sum) * (pi / paths_per_place);
}

}  // namespace

ProbedLight probe_light(const LightingContext& lighting, const std::vector<PixelSurface>& places, RayCounts& counts) {
    ProbedLight light(places.size(), -1.0f);
    RayCounts own;
    cast_parallel(places.size(), 16, lighting.rays, own, [&](int i, RayTask& task) {
        const std::optional<SurfacePoint> point = carry_point(lighting.shading, places[i].hit, places[i].point);
        if (point) light[i] = probe_place(lighting, task, *point, i);
    });
    counts.shadow += own.total();
    return light;
}

LightChanges find_light_changes(const std::vector<PixelSurface>& places, glm::ivec2 picture, const ProbedLight& known,
                                const ProbedLight& sample) {
    if (known.empty() || sample.empty()) return {};
    LightChanges changes{.picture = picture};
    struct Sums {
        float before = 0.0f, after = 0.0f, squares = 0.0f;  ///< squares: of the differences of places
        int count = 0;
    };
    std::array<Sums, LightChanges::across * LightChanges::across> parts{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (known[i] < 0.0f || sample[i] < 0.0f) continue;
        Sums& part = parts[changes.part(places[i].x, places[i].y)];
        const float difference = sample[i] - known[i];
        part.before += known[i];
        part.after += sample[i];
        part.squares += difference * difference;
        ++part.count;
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto& [before, after, squares, count] = parts[i];
        if (count < 2) continue;
        const float difference = std::abs(after - before), n = static_cast<float>(count);
        const float noise = std::sqrt(std::max(0.0f, (squares * n - difference * difference) / (n - 1.0f)));
        changes.shares[i] = std::max(0.0f, difference - sure * noise) / std::max({before, after, 1e-30f});
    }
    return changes;
}

void LightChanges::add(const LightChanges& other) {
    if (other.picture.x == 0) return;
    picture = other.picture;
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = std::max(shares[i], other.shares[i]);
}

ProbedLight add_light(const std::vector<WeighedLight>& lights) {
    if (std::ranges::any_of(lights, [](const WeighedLight& one) { return one.light->empty(); })) return {};
    ProbedLight sum(lights.front().light->size(), 0.0f);
    for (std::size_t i = 0; i < sum.size(); ++i) {
        for (const auto& [light, weight] : lights)
            sum[i] = sum[i] < 0.0f || (*light)[i] < 0.0f ? -1.0f : sum[i] + weight * (*light)[i];
    }
    return sum;
}

}  // namespace aleph
