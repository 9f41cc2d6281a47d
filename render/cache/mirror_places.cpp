#include "render/cache/mirror_places.h"

#include <algorithm>
#include <cmath>

#include "render/cache/further_bounces.h"
#include "render/surface/media.h"
#include "render/surface/scatter.h"

namespace aleph {

namespace {

constexpr float narrow_alpha = 0.0625f;   // GGX width up to which a lobe counts as a mirror: roughness .25
constexpr float least_weight = 0.1f;      // share of the light that mirrors have to reflect
constexpr float loosest_accuracy = 0.5f;  // alpha
constexpr int most_turns = 8;
constexpr float passing = 0x1.fffffep-1f;  // glass is looked through, unless it reflects everything

/// The surface with narrow lobes as mirrors.
ViewedSurface narrow_lobes(ViewedSurface surface) {
    if (surface.material.gloss.alpha <= narrow_alpha && surface.material.gloss.stretch == 0.0f)
        surface.material.gloss.alpha = 0.0f;
    if (surface.material.coat.alpha <= narrow_alpha) surface.material.coat.alpha = 0.0f;
    return surface;
}

/// The turn at a mirror by which most light comes; weight 0 if there is none.
ScatterSample choose_turn(const LitSurface& lit) {
    ScatterSample best;
    for (const Lobe lobe : {Lobe::gloss, Lobe::coat, Lobe::glass}) {
        const SurfaceMaterial& material = lit.material;
        const bool is_smooth = lobe == Lobe::gloss  ? material.has_glossy() && material.is_mirror()
                               : lobe == Lobe::coat ? material.has_coat() && material.is_coat_mirror()
                                                    : material.has_glass() && material.is_glass_smooth();
        if (!is_smooth) continue;
        LobeShares only{};
        only[static_cast<int>(lobe)] = 1.0f;
        const ScatterSample turn = sample_scatter(lit, only, 0.0f, glm::vec2(0.0f), passing);
        if (largest_channel(turn.weight) > largest_channel(best.weight)) best = turn;
    }
    return best;
}

/// Where a pixel's path arrives.
struct Arrival {
    Hit hit;  ///< its distance is that of the whole path, m
    glm::vec3 direction{0.0f};
    float weight = 0.0f;  ///< of the path
    ViewedSurface surface;
};

/// Follows mirrors from a pixel's surface.
std::optional<Arrival> follow_mirrors(const IndirectContext& context, const PixelSurface& first, RayTask& task) {
    const ShadingScene& shading = context.lighting.shading;
    const int turns = std::min(most_turns, context.settings.light.path_depth - 1 - count_bounces(context.settings));
    Arrival end{first.hit, -first.view, 1.0f, first};
    float distance = first.distance;
    Media media = context.lighting.around;
    for (int turn = 0; turn < turns; ++turn) {
        ViewedSurface mirror = narrow_lobes(end.surface);
        if (mirror.material.glass.volume) mirror.material.glass.ior_ratio = media.ratio_at(mirror);
        const LitSurface lit(mirror);
        const ScatterSample sample = choose_turn(lit);
        end.weight *= largest_channel(sample.weight);
        if (!(end.weight >= least_weight)) return std::nullopt;
        if (sample.passes && mirror.material.glass.volume) media.pass(mirror.point, mirror.material);
        end.direction = sample.direction;
        ++task.counts.specular;
        end.hit = task.tracer.intersect({lit.ray_origin(end.direction), end.direction});
        if (end.hit.instance == no_index) return std::nullopt;
        end.hit.distance = distance += end.hit.distance;
        const SurfacePoint point = make_surface_point(shading, end.hit, end.direction);
        end.surface = view_surface(shading, point, -end.direction, {});
        if (end.surface.material.has_diffuse()) return end;
    }
    return std::nullopt;
}

}  // namespace

MirrorPlaces cast_mirror_places(const IndirectContext& context, const SampleHits& sample, RayCounts& counts) {
    const int width = sample.hits.width, height = sample.hits.height;
    const float pixel = 1.0f / static_cast<float>(context.view.pixels_per_unit);
    MirrorPlaces out{{Image<Hit>(width, height), Image<glm::vec3>(width, height), pixel * pixel},
                     Image<float>(width, height, 1.0f)};
    cast_parallel(height, 4, context.lighting.rays, counts, [&](int y, RayTask& task) {
        for (int x = 0; x < width; ++x) {
            if (sample.hits(x, y).instance == no_index) continue;
            const std::optional<PixelSurface> first = find_surface(context, sample, x, y);
            if (!first || !first->material.has_specular()) continue;
            const std::optional<Arrival> arrival = follow_mirrors(context, *first, task);
            if (!arrival) continue;
            const float alpha = context.accuracy(x, y);
            const float accuracy = std::max(alpha, std::min(alpha / std::sqrt(arrival->weight), loosest_accuracy));
            PixelSurface place{arrival->surface};
            place.hit = arrival->hit;
            if (context.carried != nullptr && context.carried->find(place, accuracy, task)) continue;
            out.places.hits(x, y) = arrival->hit;
            out.places.directions(x, y) = arrival->direction;
            out.accuracy(x, y) = accuracy;
        }
    });
    out.any = std::ranges::any_of(out.places.hits.pixels, [](const Hit& hit) { return hit.instance != no_index; });
    return out;
}

void fill_mirror_places(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample,
                        FrameTally& tally) {
    MirrorPlaces mirrors = cast_mirror_places(context, sample, tally.counts.rays);
    if (!mirrors.any) return;
    IndirectContext mirrored = make_places_context(context, mirrors.accuracy);
    mirrored.tolerance = context.tolerance;
    fill_places(cache, mirrored, make_fill_places(context.lighting.shading, mirrors.places), tally);
}

}  // namespace aleph
