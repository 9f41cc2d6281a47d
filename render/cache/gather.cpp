#include "render/cache/gather.h"

#include "render/cache/aimed_rays.h"
#include "render/cache/clear_sheets.h"
#include "render/settings/numbers.h"
#include "render/surface/lambert_hit.h"

namespace aleph {

namespace {

constexpr float min_ray_cosine = 0.05f;  // limits the solid angle of cells at the horizon

/// Keeps the random numbers of rays that go on from a hit apart from those of gathers at the same place.
constexpr std::uint32_t further_seed_mask = 0x66757274u;

/// Light of further bounces changes slowly: its cells are wider than those of direct light.
constexpr float multi_bounce_widths = 4.0f;

constexpr float place_cells = 256.0f;  // along each side of a triangle, for random numbers

/// One gather while its hits are lit.
struct Lighting {
    const LightingContext& context;
    RayTask& task;
    const GatherOptions& options;
    const HemisphereStrata& strata;
    const CellNumbers& numbers;
    const glm::vec3& normal;  ///< of the hemisphere
    RandomStream& random;
    std::uint32_t further_seed;
    GatherScratch& scratch;

    float weight(std::size_t ray) const { return scratch.aims > 0 ? scratch.weights[ray] : 1.0f; }
    /// The bright patch that the ray met.
    int find_patch(std::size_t ray) const {
        return options.bright->find(scratch.hits[ray], scratch.rays[ray].direction);
    }
    /// sr, of the cell of the hemisphere that holds the ray: 1 / cosine larger towards the horizon. Textures are
    /// filtered by it, also where rays are aimed: less filtered where they are bright, they would be too bright.
    float cell_solid_angle(std::size_t ray) const {
        const float cosine = std::max(glm::dot(normal, scratch.rays[ray].direction), min_ray_cosine);
        return pi / (static_cast<float>(strata.count()) * cosine);
    }
    /// sr, that a ray represents: where rays are aimed, less.
    float solid_angle(std::size_t ray) const { return weight(ray) * cell_solid_angle(ray); }
    /// Numbers for a light at what this ray hit.
    LightNumbers light_numbers(std::size_t ray) const {
        const auto& [cell, row, column] = scratch.places[ray];
        return {numbers.light(row, column), numbers.light_point(row, column)};
    }
    /// Cell of the direct grid; 0: there is no grid.
    /// @param widths  of what the ray represents, in the cell
    std::uint64_t find_cell(std::size_t ray, const Hit& hit, const glm::vec3& position, const glm::vec3& geometric,
                            float widths = 1.0f) const {
        if (options.grid == nullptr) return 0;
        // More rays are aimed at brighter patches: a cell that held for several of them would be too bright for all.
        const std::size_t patch = static_cast<std::size_t>(weight(ray) < 1.0f ? find_patch(ray) + 1 : 0);
        const std::size_t surface = patch * context.shading.instances.size() + static_cast<std::size_t>(hit.instance);
        return options.grid->key_of(surface, position - context.shading.instances[hit.instance].translation, geometric,
                                    widths * hit.distance * std::sqrt(solid_angle(ray)));
    }
    bool is_plain(const Hit& hit) const {
        return context.shading.materials[context.shading.instances[hit.instance].material].plain_lambert;
    }
    /// Irradiance of further bounces at a surface that the ray or a path from there met, if a cache knows it. The grid
    /// keeps it; where it keeps direct light too, light_plain_hit adds both.
    std::optional<Rgb> look_up(std::size_t ray, const SurfacePlace& met, const Hit& hit) const {
        if (options.multi_bounce.cache == nullptr) return std::nullopt;
        const std::uint64_t cell = find_cell(ray, hit, met.position, met.geometric, multi_bounce_widths);
        if (cell != 0) {
            if (const std::optional<Rgb> kept = options.grid->find(cell).multi_bounce()) return *kept * pi;
        }
        const std::optional<Rgb> found = find_cached_irradiance(task, met, options.multi_bounce);
        if (found && cell != 0 && options.found != nullptr && !is_plain(hit)) {
            options.found->push_back({cell, Rgb(0.0f), *found / pi});
        }
        return found;
    }
    Rgb sample_multi_bounce(const SurfacePlace& met, const SurfaceMaterial* material = nullptr) const {
        return sample_multi_bounce_irradiance(context, task, met, material, options.multi_bounce, options.depth,
                                              random);
    }
    bool notes_further() const { return options.multi_bounce.noted && options.multi_bounce.bounces > 0; }
    void note_further(std::size_t ray, const Rgb& weight, const SurfacePlace& met, const Hit& hit) const {
        scratch.further.push_back({static_cast<int>(ray), weight, met, make_place_key(further_seed, hit)});
    }
};

/// Light of further bounces at surfaces that paths from a hit meet.
KnownIrradiance make_further_on_path(const Lighting& lighting, std::size_t ray) {
    const auto find = [&lighting, ray](const ViewedSurface& surface, const Hit& hit, float, const Rgb& weight,
                                       RayTask&) -> std::optional<Rgb> {
        if (!lighting.options.multi_bounce.noted) return lighting.look_up(ray, surface.point, hit);
        lighting.note_further(ray, weight, surface.point, hit);
        return Rgb(0.0f);
    };
    return {lighting.options.multi_bounce.bounces, find};
}

/// Light that comes back along a path which leaves a hit by another lobe than the Lambert layer's.
Rgb follow_lobes(const Lighting& lighting, std::size_t ray, const LitSurface& lit, const LobeShares& shares) {
    RandomStream& random = lighting.random;
    const ScatterSample* const known = find_reflected(lighting.scratch, ray);
    const ScatterSample sample =
        known != nullptr ? *known : sample_scatter(lit, shares, random.next(), random.next_2d(), random.next());
    if (sample.lobe == Lobe::diffuse) return Rgb(0.0f);
    const MultiBounceLight& light = lighting.options.multi_bounce;
    PathState state = start_indirect({light.bounces, lighting.options.depth}, lighting.context.around);
    const KnownIrradiance further = make_further_on_path(lighting, ray);
    if (light.bounces > 0 && (light.noted || light.cache != nullptr)) state.known = &further;
    return follow_sample(lighting.context, lighting.task, lit, sample, state, random);
}

/// @param passed  share of the light that comes through
void add_arrived(const ShadowSample& sample, const Rgb& passed, const GatherOptions& options, GatherScratch& scratch) {
    const Rgb arrives = sample.multi_bounce + (passed == Rgb(0.0f) ? passed : sample.unshadowed * passed);
    scratch.light[sample.ray] += sample.scale * arrives;
    if (sample.grid == 0 || options.found == nullptr) return;
    options.found->push_back({sample.grid, arrives});
    if (sample.looked_up) options.found->back().multi_bounce = sample.multi_bounce;
}

/// Adds light, or its shadow ray to those that are to be cast.
void add_scattered(const Lighting& lighting, const ScatteredLight& scattered, const ShadowSample& sample) {
    if (!scattered.shadowed) return add_arrived(sample, Rgb(1.0f), lighting.options, lighting.scratch);
    lighting.scratch.shadow_rays.push_back(scattered.shadow_ray);
    lighting.scratch.shadow_samples.push_back(sample);
}

/// Adds a sample of direct light, light of further bounces, and that of longer paths by other lobes than Lambert's.
void light_hit(const Lighting& lighting, std::size_t i) {
    GatherScratch& scratch = lighting.scratch;
    const ShadingScene& shading = lighting.context.shading;
    const glm::vec3& direction = scratch.rays[i].direction;
    const SurfacePoint met = make_surface_point(shading, scratch.hits[i], direction);
    const RayFootprint footprint =
        make_cone_footprint(met, direction, scratch.hits[i].distance, lighting.cell_solid_angle(i));
    ViewedSurface surface = view_surface(shading, met, -direction, footprint);
    blur_caustics(shading, surface);
    const LitSurface lit(surface);
    const Rgb arrives = transmit(lighting.context.around.attenuation(met, surface.material), scratch.hits[i].distance);
    LobeShares shares{};
    if (lighting.options.depth > 0 && surface.material.has_specular()) {
        shares = share_lobes(lit, LobeSet::all);
        scratch.light[i] = arrives * follow_lobes(lighting, i, lit, shares);
        shares[static_cast<int>(Lobe::diffuse)] = 0.0f;
    }
    if (lighting.options.multi_bounce.bounces > 0 && surface.material.has_diffuse()) {
        const Rgb weight = arrives * diffuse_radiance(surface.material, lit.cos_view, Rgb(1.0f)) * lit.below_sheen;
        if (lighting.options.multi_bounce.noted) {
            lighting.note_further(i, weight, surface.point, scratch.hits[i]);
        } else if (const auto known = lighting.look_up(i, surface.point, scratch.hits[i])) {
            scratch.light[i] += weight * *known;
        } else {
            scratch.light[i] += weight * lighting.sample_multi_bounce(surface.point, &surface.material);
        }
    }
    const ScatteredLight scattered = choose_light(lighting.context, lit, shares, lighting.light_numbers(i));
    if (scattered.radiance == Rgb(0.0f)) return;
    const Rgb reaches = transmit_to_light(lighting.context.around, lit, scattered.shadow_ray);
    add_scattered(lighting, scattered, {scattered.radiance * reaches, arrives, Rgb(0.0f), static_cast<int>(i)});
}

/// Albedo and cell of the direct grid of a plain Lambert surface.
void note_plain_hit(const Lighting& lighting, std::size_t i) {
    GatherScratch& scratch = lighting.scratch;
    const ShadingScene& shading = lighting.context.shading;
    const Hit& hit = scratch.hits[i];
    const float solid_angle = lighting.cell_solid_angle(i);
    LambertHit met = make_lambert_hit(shading, scratch.rays[i], hit, scratch.normals[i], solid_angle);
    met.albedo *= transmit(lighting.context.around.attenuation_inside(), hit.distance);
    if (met.albedo == Rgb(0.0f)) return;
    if (lighting.notes_further()) {
        lighting.note_further(i, met.albedo / pi, make_surface_place(shading, hit, scratch.rays[i].direction), hit);
    }
    const std::uint64_t grid = lighting.find_cell(i, hit, met.position, met.geometric);
    if (grid != 0) lighting.options.grid->prefetch(grid);
    scratch.plain_hits.push_back({met.albedo, static_cast<int>(i), grid, std::nullopt});
}

/// Direct light from the grid. Hits in cells of too few samples are left: each will take one more, which counts with
/// them.
void find_known_light(const DirectGrid& grid, GatherScratch& scratch) {
    std::size_t left = 0;
    for (const PlainHit& hit : scratch.plain_hits) {
        const DirectGrid::Cell& known = grid.find(hit.grid);
        const bool enough = known.count >= DirectGrid::enough;
        const Rgb scale = hit.scale / static_cast<float>(enough ? known.count : known.count + 1);
        scratch.light[hit.ray] = scale * known.sum;
        scratch.plain_hits[left] = {scale, hit.ray, hit.grid, known.multi_bounce()};
        left += enough ? 0 : 1;
    }
    scratch.plain_hits.resize(left);
}

/// Adds a sample of direct light, and light of further bounces.
void light_plain_hit(const Lighting& lighting, const PlainHit& noted) {
    GatherScratch& scratch = lighting.scratch;
    const LightingContext& context = lighting.context;
    const SurfacePlace place =
        make_surface_place(context.shading, scratch.hits[noted.ray], scratch.rays[noted.ray].direction);
    ShadowSample sample{Rgb(0.0f), noted.scale, Rgb(0.0f), noted.ray, noted.grid};
    if (noted.multi_bounce) {
        sample.multi_bounce = *noted.multi_bounce;
    } else if (const auto found = find_cached_irradiance(lighting.task, place, lighting.options.multi_bounce)) {
        sample.multi_bounce = *found / pi;
        sample.looked_up = true;
    } else if (!lighting.options.multi_bounce.noted) {
        sample.multi_bounce = lighting.sample_multi_bounce(place) / pi;
    }
    const ScatteredLight scattered = choose_lambert_light(context, place, lighting.light_numbers(noted.ray));
    if (scattered.radiance == Rgb(0.0f)) return add_arrived(sample, Rgb(0.0f), lighting.options, scratch);
    sample.unshadowed = scattered.radiance * transmit(context.around.attenuation_inside(), scattered.shadow_ray.far);
    add_scattered(lighting, scattered, sample);
}

/// All plain hits. What is read of the meshes is fetched ahead.
void light_plain_hits(const Lighting& lighting) {
    GatherScratch& scratch = lighting.scratch;
    const ShadingScene& shading = lighting.context.shading;
    constexpr std::size_t ahead = 4;  // hits
    const auto hit_of = [&](std::size_t k) -> const Hit& { return scratch.hits[scratch.plain_hits[k].ray]; };
    const std::size_t count = scratch.plain_hits.size();
    for (std::size_t k = 0; k < count; ++k) {
        if (k + 2 * ahead < count) prefetch_triangle(shading, hit_of(k + 2 * ahead));
        if (k + ahead < count) prefetch_corners(shading, hit_of(k + ahead));
        light_plain_hit(lighting, scratch.plain_hits[k]);
    }
}

/// Fills in light that is known, and for all other hits unshadowed light with its shadow rays.
void light_hits(const Lighting& lighting) {
    GatherScratch& scratch = lighting.scratch;
    scratch.light.assign(scratch.rays.size(), Rgb(0.0f));
    scratch.shadow_rays.clear();
    scratch.shadow_samples.clear();
    scratch.plain_hits.clear();
    scratch.further.clear();
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const Hit& hit = scratch.hits[i];
        if (hit.instance == no_index) continue;
        if (lighting.is_plain(hit)) {
            note_plain_hit(lighting, i);
        } else {
            light_hit(lighting, i);
        }
    }
    if (lighting.options.grid != nullptr) find_known_light(*lighting.options.grid, scratch);
    light_plain_hits(lighting);
}

/// Casts the shadow rays and adds the light that is not in shadow.
void add_unshadowed(const LightingContext& context, RayTask& task, const GatherOptions& options,
                    GatherScratch& scratch) {
    for (std::size_t s = 0; s < scratch.shadow_rays.size(); ++s)
        add_arrived(scratch.shadow_samples[s], find_transmittance(context, task, scratch.shadow_rays[s]), options,
                    scratch);
}

/// Multiplies what the rays found.
/// @param weight  gives the factor of a ray
template <class Weight>
void scale_light(GatherScratch& scratch, const Weight& weight) {
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) scratch.light[i] *= weight(i);
    for (FurtherLight& further : scratch.further) further.weight *= weight(static_cast<std::size_t>(further.ray));
}

/// Weighs the light of all rays by how much of it enters the Lambert layer.
void weigh_by_transmission(const SurfaceMaterial& material, const glm::vec3& normal, GatherScratch& scratch) {
    const bool layered = material.has_coat() || material.has_sheen();
    if (!(layered || material.gloss.f90_max > 0.0f || material.gloss.f0_max > 0.0f)) return;
    const UpperLayers layers(material, normal);
    scale_light(scratch, [&](std::size_t ray) {
        const glm::vec3& direction = scratch.rays[ray].direction;
        return layers.entering(direction, glm::dot(normal, direction));
    });
}

}  // namespace

RandomKey make_place_key(std::uint32_t seed, const Hit& hit) {
    const auto cell = [](float at) { return static_cast<std::uint32_t>(std::max(at, 0.0f) * place_cells); };
    return {seed, static_cast<std::uint32_t>(hit.instance), static_cast<std::uint32_t>(hit.primitive),
            cell(hit.u) << 16 | cell(hit.v)};
}

IrradianceSample gather_irradiance(const LightingContext& context, RayTask& task, const SurfacePlace& point,
                                   const GatherPattern& pattern, GatherScratch& scratch, const GatherOptions& options) {
    const HemisphereStrata& strata = pattern.strata;
    RandomStream random(pattern.key);
    const CellNumbers numbers(random);
    place_rays(strata, make_basis(point.normal), point, numbers, scratch);
    scratch.strata = strata;
    scratch.aims = options.bright == nullptr ? 0 : std::max(1, strata.count() / around_per_aimed);
    scratch.aimed.clear();
    std::optional<BrightSampler> sampler;
    if (scratch.aims > 0) {
        sampler.emplace(*options.bright, Receiver{point.ray_origin(), point.normal}, strata.count(), scratch.aims);
        aim_rays(*sampler, point, random, scratch);
    }
    task.tracer.intersect(scratch.rays, scratch.hits, scratch.normals);
    task.counts.gather += scratch.rays.size();
    pass_clear_sheets(context, task, random, scratch);
    if (sampler) weigh_rays(*sampler, scratch);
    LightingContext inside = context;
    inside.around = find_media(context.shading, task.tracer, {point.ray_origin(), point.normal}, task.counts.gather);
    light_hits(
        {inside, task, options, strata, numbers, point.normal, random, pattern.key.seed ^ further_seed_mask, scratch});
    add_unshadowed(context, task, options, scratch);
    if (options.material != nullptr) weigh_by_transmission(*options.material, point.normal, scratch);
    if (sampler) scale_light(scratch, [&](std::size_t ray) { return scratch.weights[ray]; });
    if (!scratch.passed.empty()) scale_light(scratch, [&](std::size_t ray) { return scratch.passed[ray]; });
    const Rgb rare = options.apart_if_rare ? take_rare_light(strata, scratch) : Rgb(0.0f);
    IrradianceSample sample = add_up_rays(strata, point.normal, scratch);
    sample.rare = rare;
    return sample;
}

}  // namespace aleph
