#include "render/path.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr float least_survival = 0.05f;

float largest_channel(const Rgb& c) {
    return std::max({c.x, c.y, c.z});
}

void count_ray(RayCounts& counts, const ScatterSample& sample) {
    if (sample.lobe == Lobe::diffuse) {
        ++counts.path;
    } else if (sample.pdf > 0.0f) {
        ++counts.glossy;
    } else {
        ++counts.specular;
    }
}

/// Weight of light that was met, against the density with which the light would have been sampled.
float weigh(const PathState& state, float light_pdf) {
    switch (state.emission) {
        case EmissionWeight::full:
            return 1.0f;
        case EmissionWeight::weighted:
            return power_heuristic(state.pdf, light_pdf);
        case EmissionWeight::none:
            break;
    }
    return 0.0f;
}

/// Emission of a surface that a ray met.
Rgb met_emission(const LightingContext& context, const PathState& state, const ViewedSurface& surface, int instance) {
    const Rgb& emission = surface.material.emission;
    if (emission == Rgb(0.0f) || state.emission == EmissionWeight::none) return Rgb(0.0f);
    const int emitter = context.lights.emitter_of_instance[instance];
    if (emitter == no_index) return state.emission == EmissionWeight::full ? emission : Rgb(0.0f);  // unlit
    float light_pdf = 0.0f;
    if (state.emission == EmissionWeight::weighted) {
        light_pdf = pdf_emitter(context.lights.emitters[emitter], state.from.position,
                                std::abs(glm::dot(surface.point.geometric, surface.view)),
                                glm::distance(surface.point.position, state.from.position));
    }
    return emission * weigh(state, light_pdf);
}

/// A path that is being made.
class Path {
  public:
    Path(const LightingContext& context, RayTask& task, const PathState& state, RandomStream& random)
        : context_(context), task_(task), state_(state), random_(random) {}

    /// Adds the light of the surface and of everything beyond.
    void scatter_at(ViewedSurface& surface) {
        while (state_.left.depth > 0 && survive()) {
            --state_.left.depth;
            if (surface.material.volume) surface.material.ior_ratio = state_.media.ratio_at(surface);
            const LitSurface lit(surface);
            const LobeShares shares = share_lobes(lit, LobeSet::all);
            add_direct(lit, shares);
            const ScatterSample sample = sample_scatter(lit, shares, random_.next(), random_.next_2d(), random_.next());
            // After the last bounce the ray still looks for lamps: near a large one, sampling it alone is noise.
            const bool ends = state_.left.bounces <= 0 && sample.lobe == Lobe::diffuse;
            if (!follow(lit, sample, surface) || ends) return;
        }
    }

    /// Casts the ray of a sample and adds the emission that it meets. True if it met a surface, which is then `next`.
    /// @param next  may be the surface that `lit` refers to
    bool follow(const LitSurface& lit, const ScatterSample& sample, ViewedSurface& next) {
        if (sample.weight == Rgb(0.0f)) return false;
        state_.throughput *= sample.weight;
        if (!sample.straight) {
            state_.emission = sample.pdf > 0.0f ? EmissionWeight::weighted : EmissionWeight::full;
            state_.pdf = sample.pdf;
            state_.from = {lit.point.ray_origin(), lit.point.normal};
        }
        if (sample.lobe == Lobe::diffuse) --state_.left.bounces;
        if (sample.passes && lit.material.volume) state_.media.pass({lit.point, lit.material, glm::vec3(0.0f)});
        const Ray ray{lit.ray_origin(sample.direction), sample.direction};
        count_ray(task_.counts, sample);
        return meet(ray, next);
    }

    const Rgb& light() const { return light_; }

  private:
    void add_direct(const LitSurface& lit, const LobeShares& shares) {
        const SurfaceMaterial& material = lit.material;
        const bool only_mirrors = !material.has_diffuse() && !material.has_sheen() &&
                                  (!material.has_glossy() || material.is_mirror()) &&
                                  (!material.has_glass() || material.is_glass_smooth()) &&
                                  (!material.has_coat() || material.is_coat_mirror());
        if (only_mirrors) return;
        const ScatteredLight direct = choose_light(context_, lit, shares, random_);
        if (direct.radiance == Rgb(0.0f)) return;
        Rgb arrives = direct.radiance * find_transmittance(context_, task_, direct.shadow_ray);
        if (const Rgb attenuation = state_.media.attenuation_inside(); attenuation != Rgb(0.0f)) {
            arrives *= glm::exp(-attenuation * direct.shadow_ray.far);
        }
        light_ += state_.throughput * arrives;
    }

    /// Russian roulette (Arvo and Kirk 1990).
    bool survive() {
        if (state_.roulette_after-- > 0) return true;
        const float chance = std::clamp(largest_channel(state_.throughput), least_survival, 1.0f);
        if (random_.next() >= chance) return false;
        state_.throughput /= chance;
        return true;
    }

    bool meet(const Ray& ray, ViewedSurface& next) {
        const Hit hit = task_.tracer.intersect(ray);
        if (hit.instance == no_index) {
            if (context_.lights.has_environment && state_.emission != EmissionWeight::none) {
                const float pdf = state_.emission == EmissionWeight::weighted
                                      ? pdf_environment(context_.shading, state_.from, ray.direction)
                                      : 0.0f;
                light_ +=
                    state_.throughput * environment_radiance(context_.shading, ray.direction) * weigh(state_, pdf);
            }
            return false;
        }
        next = view_surface(context_.shading, make_surface_point(context_.shading, hit, ray.direction), -ray.direction,
                            {});
        const Rgb attenuation = state_.media.attenuation(next);
        if (attenuation != Rgb(0.0f)) state_.throughput *= glm::exp(-attenuation * hit.distance);
        light_ += state_.throughput * met_emission(context_, state_, next, hit.instance);
        return true;
    }

    const LightingContext& context_;
    RayTask& task_;
    PathState state_;
    RandomStream& random_;
    Rgb light_{0.0f};
};

}  // namespace

int Media::find(int material) const {
    for (int i = size_ - 1; i >= 0; --i) {
        if (stack_[i].material == material) return i;
    }
    return no_index;
}

Rgb Media::attenuation_inside() const {
    return size_ > 0 ? stack_[size_ - 1].attenuation : Rgb(0.0f);
}

Rgb Media::attenuation(const ViewedSurface& end) const {
    if (size_ > 0) return attenuation_inside();
    return end.material.volume && !end.point.front ? end.material.attenuation : Rgb(0.0f);
}

float Media::ratio_at(const ViewedSurface& surface) const {
    if (surface.point.front) return surface.material.ior / ior();
    const int inside = find(surface.point.material);
    const int outer = inside == no_index ? size_ - 1 : (inside == size_ - 1 ? size_ - 2 : size_ - 1);
    const float outer_ior = outer >= 0 ? stack_[outer].ior : 1.0f;
    // A ray that is in another medium as well leaves this one without noticing: the innermost counts.
    const float inner = inside == no_index ? surface.material.ior : ior();
    return inner > 0.0f ? outer_ior / inner : 0.0f;
}

void Media::pass(const ViewedSurface& surface) {
    if (surface.point.front) {
        if (size_ < static_cast<int>(stack_.size())) {
            stack_[size_++] = {surface.point.material, surface.material.ior, surface.material.attenuation};
        }
        return;
    }
    const int inside = find(surface.point.material);
    if (inside == no_index) return;
    std::copy(stack_.begin() + inside + 1, stack_.begin() + size_, stack_.begin() + inside);
    --size_;
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
    if (path.follow(lit, sample, next)) path.scatter_at(next);
    return path.light();
}

}  // namespace aleph
