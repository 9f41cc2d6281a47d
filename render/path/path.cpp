#include "render/path/path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/surface/glass.h"

namespace aleph {

namespace {

constexpr float least_survival = 0.05f;

/// Chance that the smaller part of the light at smooth glass is followed as well, times its weight; at most 1.
constexpr float split_survival = 30.0f;

/// Known irradiance may err by more than the pixel's accuracy where the path has little weight, and where a wide lobe
/// averages over many places, but by no more than this.
constexpr float loosest_accuracy = 0.5f;

/// Weight of light that was met, against the density with which the light would have been sampled.
float weigh(const PathState& state, float light_pdf) {
    if (state.emission == EmissionWeight::weighted) return power_heuristic(state.pdf, light_pdf);
    return state.emission == EmissionWeight::full ? 1.0f : 0.0f;
}

/// Light of the surroundings that a ray meets.
Rgb met_surroundings(const LightingContext& context, const PathState& state, const glm::vec3& direction) {
    if (!context.lights.has_environment || state.emission == EmissionWeight::none) return Rgb(0.0f);
    const bool weighted = state.emission == EmissionWeight::weighted;
    const float light_pdf = weighted ? pdf_environment(context.shading, state.from, direction) : 0.0f;
    return environment_radiance(context.shading, direction) * weigh(state, light_pdf);
}

/// A path that is being made.
class Path {
  public:
    Path(const LightingContext& context, RayTask& task, const PathState& state, RandomStream& random)
        : context_(context), task_(task), state_(state), random_(random) {}

    /// Adds the light of the surface and of everything beyond.
    void scatter_at(ViewedSurface& surface) {
        while (state_.left.depth > 0) {
            if (state_.turned) blur_caustics(context_.shading, surface);
            const bool known = add_known(surface);
            if (!survive()) return;
            --state_.left.depth;
            if (surface.material.glass.volume) surface.material.glass.ior_ratio = state_.media.ratio_at(surface);
            const LitSurface lit(surface);
            const LobeShares shares = share_lobes(lit, known ? LobeSet::specular : LobeSet::all);
            add_direct(lit, shares);
            if (shares == LobeShares{}) return;
            const ScatterSample sample =
                split(lit, sample_scatter(lit, shares, random_.next(), random_.next_2d(), random_.next()));
            // After the last bounce the ray still looks for lamps: near a large one, sampling it alone is noise.
            const bool last_bounce = state_.left.bounces <= 0 && sample.lobe == Lobe::diffuse;
            if (!follow(lit, sample, surface)) return;
            const bool last_surface = state_.left.depth == 0 && state_.emission == EmissionWeight::weighted;
            if (last_bounce || last_surface) return look_through(sample.direction, surface);
        }
    }

    /// Where smooth glass is seen sharply, follows what less of the light comes from: a lamp there is many times as
    /// bright as what most samples would find. @return the sample of the rest, elsewhere the same
    ScatterSample split(const LitSurface& lit, const ScatterSample& sample) {
        const bool is_sharp = !state_.turned && state_.emission == EmissionWeight::full;
        if (state_.splits <= 0 || !is_sharp || sample.lobe != Lobe::glass || !lit.material.is_glass_smooth())
            return sample;
        const float reflected = glass_reflectance(lit.material, lit.cos_view);
        if (!(reflected > 0.0f && reflected < 1.0f)) return sample;
        --state_.splits;
        const auto take = [&](bool passes, float weight) {
            ScatterSample way = sample_scatter(lit, only_lobe(Lobe::glass), 0.0f, {}, passes ? below_one : 0.0f);
            way.weight *= weight / sample.share;
            return way;
        };
        const bool most_passes = reflected < 0.5f;
        const float less = most_passes ? reflected : 1.0f - reflected;
        const float chance = std::clamp(split_survival * largest_channel(state_.throughput) * less, less, 1.0f);
        // Weights sum to 1 either way: where both ways show the same there is no noise.
        if (random_.next() >= chance) return take(most_passes, 1.0f);
        Path branch(context_, task_, state_, random_);
        ViewedSurface next;
        if (branch.follow(lit, take(!most_passes, less / chance), next)) branch.scatter_at(next);
        light_ += branch.light_;
        return take(most_passes, 1.0f - less / chance);
    }

    /// Casts the ray of a sample and adds the emission that it meets. True if it met a surface, which is then `next`.
    /// @param next  may be the surface that `lit` refers to
    bool follow(const LitSurface& lit, const ScatterSample& sample, ViewedSurface& next) {
        if (sample.weight == Rgb(0.0f)) return false;
        state_.throughput *= sample.weight;
        if (!sample.straight) {
            state_.emission = sample.pdf > 0.0f ? EmissionWeight::weighted : EmissionWeight::full;
            state_.pdf = sample.pdf;
            state_.from = make_lambert_receiver(context_, lit.point);
        }
        if (sample.lobe == Lobe::diffuse) {
            --state_.left.bounces;
            state_.turned = true;
        }
        if (sample.passes && lit.material.glass.volume) state_.media.pass(lit.point, lit.material);
        const Ray ray{lit.ray_origin(sample.direction), sample.direction};
        RayCounts& counts = task_.counts;
        ++(sample.lobe == Lobe::diffuse ? counts.path : sample.pdf > 0.0f ? counts.glossy : counts.specular);
        return meet(ray, next);
    }

    /// Casts a ray and adds the emission that it meets. True if it met a surface, which is then `next`.
    bool meet(const Ray& ray, ViewedSurface& next) {
        const Hit hit = hit_ = task_.tracer.intersect(ray);
        if (const BrightSampler* bright = std::exchange(state_.bright, nullptr)) {
            state_.throughput *= bright->weigh(hit, ray.direction, state_.patch);
            if (state_.throughput == Rgb(0.0f)) return false;
        }
        if (hit.instance == no_index) {
            light_ += state_.throughput * met_surroundings(context_, state_, ray.direction);
            return false;
        }
        next = view_surface(context_.shading, make_surface_point(context_.shading, hit, ray.direction), -ray.direction,
                            {});
        state_.throughput *= transmit(state_.media.attenuation(next.point, next.material), hit.distance);
        light_ += state_.throughput * met_emission(context_, state_, next, hit);
        return true;
    }

    const Rgb& light() const { return light_; }

  private:
    /// Adds the emission that the ray meets behind sheets of glass. Sampling the lights finds it, too, and leaves a
    /// part of its weight to this ray.
    void look_through(const glm::vec3& direction, ViewedSurface& surface) {
        for (int sheet = 0; surface.material.passes_straight() && sheet < max_sheets; ++sheet) {
            const LitSurface lit(surface);
            state_.throughput *= sheet_transmittance(lit);
            ++task_.counts.specular;
            if (state_.throughput == Rgb(0.0f) || !meet({lit.ray_origin(direction), direction}, surface)) return;
        }
    }

    /// Adds the indirect light that the Lambert layer scatters, if it is known: before Russian roulette, as no ray is
    /// needed. Then the path must not go on from that layer.
    bool add_known(const ViewedSurface& surface) {
        if (hit_.instance == no_index || !surface.material.has_diffuse()) return false;
        const int bounces = std::min(state_.left.bounces, state_.left.depth - 1);
        const KnownIrradiance* known = state_.known;
        while (known != nullptr && known->bounces != bounces) known = known->fewer;
        if (known == nullptr) return false;
        const LitSurface lit(surface);
        const auto scattered = [&](const Rgb& irradiance) {
            return state_.throughput * diffuse_radiance(surface.material, lit.cos_view, irradiance) * lit.below_sheen;
        };
        const std::optional<Rgb> irradiance =
            known->find(surface, hit_, look_up_accuracy(), scattered(Rgb(1.0f)), task_);
        if (irradiance) light_ += scattered(*irradiance);
        return irradiance.has_value();
    }

    float look_up_accuracy() const {
        const float pdf = state_.emission == EmissionWeight::weighted ? state_.pdf : 0.0f;
        return loosen_accuracy(state_.accuracy, largest_channel(state_.throughput), pdf);
    }

    void add_direct(const LitSurface& lit, const LobeShares& shares) {
        const SurfaceMaterial& material = lit.material;
        const bool only_mirrors = !material.has_diffuse() && !material.has_sheen() &&
                                  (!material.has_glossy() || material.is_mirror()) &&
                                  (!material.has_glass() || material.is_glass_smooth()) &&
                                  (!material.has_coat() || material.is_coat_mirror());
        if (only_mirrors) return;
        const ScatteredLight direct = choose_light(context_, lit, shares, {random_.next(), random_.next_2d()});
        if (direct.radiance == Rgb(0.0f)) return;
        Rgb arrives = direct.radiance * transmit_to_light(state_.media, lit, direct.shadow_ray);
        if (direct.shadowed) arrives *= find_transmittance(context_, task_, direct.shadow_ray);
        light_ += state_.throughput * arrives;
    }

    /// Russian roulette (Arvo and Kirk 1990).
    bool survive() {
        if (state_.roulette_after-- > 0) return true;
        const float chance = std::clamp(state_.survival * largest_channel(state_.throughput), least_survival, 1.0f);
        if (random_.next() >= chance) return false;
        state_.throughput /= chance;
        return true;
    }

    const LightingContext& context_;
    RayTask& task_;
    PathState state_;
    RandomStream& random_;
    Hit hit_{};  ///< of the last ray; none before it
    Rgb light_{0.0f};
};

}  // namespace

float loosen_accuracy(float accuracy, float weight, float pdf) {
    const float spread = pdf > 0.0f ? std::sqrt(std::min(1.0f / pdf, 1.0f)) : 0.0f;
    const float loose = accuracy * (1.0f + spread) / std::sqrt(std::clamp(weight, 1e-3f, 1.0f));
    return std::max(accuracy, std::min(loose, loosest_accuracy));
}

Rgb met_emission(const LightingContext& context, const PathState& state, const ViewedSurface& surface, const Hit& hit) {
    const Rgb& emission = surface.material.emission;
    if (emission == Rgb(0.0f) || state.emission == EmissionWeight::none) return Rgb(0.0f);
    const int emitter = context.lights.emitter_of_instance[hit.instance];
    if (emitter == left_out_emitter) return emission;
    if (emitter == no_index) return state.emission == EmissionWeight::full ? emission : Rgb(0.0f);  // unlit
    float light_pdf = 0.0f;
    if (state.emission == EmissionWeight::weighted) {
        light_pdf = pdf_emitter(context.lights.emitters[emitter], state.from.position, hit,
                                std::abs(glm::dot(surface.point.geometric, surface.view)),
                                glm::distance(surface.point.position, state.from.position));
    }
    return emission * weigh(state, light_pdf);
}

Rgb scatter_light(const LightingContext& context, RayTask& task, ViewedSurface surface, PathState state,
                  RandomStream& random) {
    Path path(context, task, state, random);
    path.scatter_at(surface);
    return path.light();
}

Rgb follow_sample(const LightingContext& context, RayTask& task, const LitSurface& lit, const ScatterSample& sample,
                  PathState state, RandomStream& random) {
    Path path(context, task, state, random);
    ViewedSurface next;
    if (path.follow(lit, path.split(lit, sample), next)) path.scatter_at(next);
    return path.light();
}

Rgb follow_ray(const LightingContext& context, RayTask& task, const Ray& ray, const PathState& state,
               RandomStream& random) {
    Path path(context, task, state, random);
    ViewedSurface next;
    if (path.meet(ray, next)) path.scatter_at(next);
    return path.light();
}

}  // namespace aleph
