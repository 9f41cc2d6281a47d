#include "render/cache/clear_sheets.h"

#include <algorithm>

namespace aleph {

namespace {

/// One ray, to where it meets no clear sheet or is turned by one.
void pass_sheets(const LightingContext& context, RayTask& task, RandomStream& random, std::size_t i,
                 GatherScratch& scratch) {
    const ShadingScene& shading = context.shading;
    Ray ray = scratch.rays[i];
    Hit& hit = scratch.hits[i];
    for (int sheet = 0; sheet < max_sheets && hit.instance != no_index; ++sheet) {
        if (!(shading.materials[shading.instances[hit.instance].material].values.glass.transmission > 0.0f)) return;
        const ViewedSurface surface =
            view_surface(shading, make_surface_point(shading, hit, ray.direction), -ray.direction, {});
        if (!surface.material.passes_straight()) return;
        const LitSurface lit(surface);
        const LobeShares shares = only_lobe(Lobe::glass);
        if (share_lobes(lit, LobeSet::all) != shares) return;
        const ScatterSample sample = sample_scatter(lit, shares, random.next(), random.next_2d(), random.next());
        if (!sample.straight) {
            scratch.reflected.push_back({i, sample});
            return;
        }
        scratch.passed[i] *= sample.weight;
        const float distance = hit.distance;
        ray = {lit.ray_origin(ray.direction), ray.direction};
        hit = task.tracer.intersect(ray, &scratch.normals[i]);
        hit.distance += distance;
        ++task.counts.gather;
    }
}

}  // namespace

void pass_clear_sheets(const LightingContext& context, RayTask& task, RandomStream& random, GatherScratch& scratch) {
    scratch.passed.clear();
    scratch.reflected.clear();
    if (!context.shading.has_thin_glass) return;
    scratch.passed.resize(scratch.rays.size(), Rgb(1.0f));
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) pass_sheets(context, task, random, i, scratch);
}

const ScatterSample* find_reflected(const GatherScratch& scratch, std::size_t ray) {
    const auto found = std::ranges::lower_bound(scratch.reflected, ray, {}, &GatherScratch::Reflected::ray);
    return found != scratch.reflected.end() && found->ray == ray ? &found->sample : nullptr;
}

}  // namespace aleph
