#include "render/shade/error_budget.h"

#include <algorithm>

#include "engine/base/pixel_loops.h"
#include "render/guide/accuracy_map.h"
#include "render/guide/mean_around.h"

namespace aleph {

namespace {

float strictest_around(const Image<float>& threshold, int x, int y) {
    float least = threshold(x, y);
    visit_around(threshold, x, y, 1, [&](int nx, int ny) { least = std::min(least, threshold(nx, ny)); });
    return least;
}

}  // namespace

Image<float> compute_sampling_tolerance(const VisibleLimits& limits, const RenderSettings& settings, double exposure) {
    if (settings.sampling.rule == Sampling::uniform || settings.sampling.rule == Sampling::protocol) return {};
    const bool by_noise = settings.sampling.rule == Sampling::threshold;
    const Image<float>& limit = by_noise ? limits.noise : limits.threshold;
    const double asked = settings.error > 0.0 ? settings.error : 1.0;
    const double factor = (by_noise ? allow_noise(asked) : asked) / (limits.viewing.display_white * exposure);
    Image<float> tolerance(limits.threshold.width, limits.threshold.height);
    for (int y = 0; y < tolerance.height; ++y) {
        for (int x = 0; x < tolerance.width; ++x) {
            const Outline outline = limits.outlines(x, y);
            const bool moves = outline == Outline::moving || outline == Outline::small;
            const float threshold = moves ? strictest_around(limit, x, y) : limit(x, y);
            tolerance(x, y) = static_cast<float>(factor * threshold);
        }
    }
    return tolerance;
}

SamplingPlan make_sampling_plan(const VisibleLimits* limits, const RenderSettings& settings, double exposure) {
    SamplingPlan plan;
    plan.rule = settings.sampling.rule;
    plan.stopping = settings.sampling.stopping;
    plan.own = settings.sampling.own_rule;
    plan.most = settings.sampling.spp;
    if (limits == nullptr) return plan;
    plan.tolerance = compute_sampling_tolerance(*limits, settings, exposure);
    plan.aleph = limits->aleph;
    plan.outlines = limits->outlines;
    plan.reach = find_seen_reach(limits->viewing.pixels_per_degree);
    if (plan.rule == Sampling::threshold) plan.white = 1.0 / exposure;
    return plan;
}

}  // namespace aleph
