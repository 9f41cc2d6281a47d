#include "render/path/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/light/light_cut.h"
#include "render/light/seen_light.h"

namespace aleph {

namespace {

constexpr float min_estimate_alpha = 0.1f;  // GGX width of the quick estimate's lobes
constexpr int batch_size = 16;              // shadow rays from one point, in one packet
constexpr std::size_t least_packet = 8;     // fewer are faster one by one

/// Shadow rays collected until a packet is full. The contributions of those that are not blocked are added in order.
class ShadowBatch {
  public:
    ShadowBatch(const LightingContext& context, RayTask& task, Rgb& sum) : context_(context), task_(task), sum_(sum) {}

    /// @param pdf  LightSample::pdf
    void add(const Ray& ray, float pdf, const Rgb& contribution) {
        if (contribution == Rgb(0.0f)) return;
        if (!context_.shading.needs_shadow_ray(pdf)) {
            sum_ += contribution;
            return;
        }
        if (context_.shading.has_thin_glass) {
            sum_ += contribution * find_transmittance(context_, task_, ray);
            return;
        }
        rays_[size_] = ray;
        contributions_[size_++] = contribution;
        if (size_ == batch_size) flush();
    }

    void flush() {
        std::array<std::uint8_t, batch_size> blocked;
        if (size_ < least_packet) {
            for (std::size_t i = 0; i < size_; ++i) blocked[i] = task_.tracer.occluded(rays_[i]) ? 1 : 0;
        } else {
            task_.tracer.occluded(std::span(rays_.data(), size_), std::span(blocked.data(), size_));
        }
        task_.counts.shadow += size_;
        for (std::size_t i = 0; i < size_; ++i) {
            if (!blocked[i]) sum_ += contributions_[i];
        }
        size_ = 0;
    }

  private:
    const LightingContext& context_;
    RayTask& task_;
    Rgb& sum_;
    std::size_t size_ = 0;
    std::array<Ray, batch_size> rays_;
    std::array<Rgb, batch_size> contributions_;
};

/// compute_sampled_light's samples: at random points, weighted against sampling of the lobes.
struct RandomPattern {
    RandomStream& random;
    LightPoints points;
    LobeShares shares;

    glm::vec2 next_shift() { return random.next_2d(); }
    float light_share(int) const { return 0.0f; }
};

/// estimate_direct_light's samples: the same points for every pixel.
struct FixedPattern {
    LightPoints points;
    LobeShares shares{};  ///< no lobe is sampled

    glm::vec2 next_shift() { return {0.0f, 0.25f}; }
    float light_share(int count) const { return 1.0f / static_cast<float>(count); }
};

/// A narrow lobe would show single points of the fixed pattern as sparkles.
ViewedSurface widen_lobes(ViewedSurface surface) {
    surface.material.gloss.alpha = std::max(surface.material.gloss.alpha, min_estimate_alpha);
    surface.material.coat.alpha = std::max(surface.material.coat.alpha, min_estimate_alpha);
    return surface;
}

bool has_area(const LightSet& lights, int light) {
    const int emitters = static_cast<int>(lights.emitters.size());
    return light < emitters || light >= emitters + static_cast<int>(lights.punctual.size());
}

/// Lights that are chosen at a surface, each in proportion to about what it brings.
class ChosenLights {
  public:
    ChosenLights(const LightingContext& context, const LitSurface& lit, const LobeShares& shares,
                 const CutLimits& limits = {})
        : context_(context),
          lit_(lit),
          shares_(shares),
          receiver_{lit.point.ray_origin(), lit.point.normal},
          behind_(lit.material.has_glass() ? 1.0f : 0.0f),
          cut_(find_light_cut(context.lights, receiver_, behind_, limits)),
          seen_(context.lights, receiver_) {}

    /// Adds one sample of `count`.
    /// @param u            x chooses the light; what that leaves of it, and y, are the point on it
    /// @param light_share  sample_light
    void add_sample(const glm::vec2& u, int count, float light_share, ShadowBatch& shadows) {
        const LightPick pick = pick_light(context_.lights, cut_, receiver_, behind_, u.x);
        if (pick.light == no_index) return;
        const LightSample sample = sample_seen_light(context_.shading, context_.lights, seen_.at(pick.light), receiver_,
                                                     {pick.rest, u.y}, light_share);
        if (sample.incoming == Rgb(0.0f) || !lit_.is_reached(sample.direction)) return;
        shadows.add(make_shadow_ray(lit_, sample), sample.pdf,
                    scatter_towards(lit_, sample.direction, sample.pdf, shares_) * sample.incoming /
                        (pick.probability * static_cast<float>(count)));
    }

    const LightCut& cut() const { return cut_; }

  private:
    const LightingContext& context_;
    const LitSurface& lit_;
    const LobeShares& shares_;
    Receiver receiver_;
    float behind_;
    LightCut cut_;
    SeenLights seen_;
};

/// As many samples as 16 lights would have, of lights that are chosen among more.
template <class Pattern>
Rgb sample_chosen_lights(const LightingContext& context, RayTask& task, const LitSurface& lit, Pattern pattern) {
    ChosenLights lights(context, lit, pattern.shares);
    if (!std::isfinite(lights.cut().total)) return Rgb(lights.cut().total);
    Rgb sum(0.0f);
    ShadowBatch shadows(context, task, sum);
    LightPoints points = pattern.points;
    points.count *= LightCut::few;
    const glm::vec2 shift = pattern.next_shift();
    for (int i = 0; i < points.count; ++i) {
        lights.add_sample(points.at(i, shift), points.count, pattern.light_share(pattern.points.count), shadows);
    }
    shadows.flush();
    return sum;
}

/// The scattered light of samples of every light, as a pattern places and weighs them.
template <class Pattern>
Rgb sample_lights(const LightingContext& context, RayTask& task, const LitSurface& lit, Pattern pattern) {
    if (context.lights.count() > LightCut::few) return sample_chosen_lights(context, task, lit, pattern);
    Rgb sum(0.0f);
    ShadowBatch shadows(context, task, sum);
    const Receiver receiver{lit.point.ray_origin(), lit.point.normal};
    for (int light = 0; light < context.lights.count(); ++light) {
        const LightPoints points = has_area(context.lights, light) ? pattern.points : LightPoints{};
        const glm::vec2 shift = pattern.next_shift();
        const SeenLight seen = see_light(context.lights, light, receiver.position);
        for (int i = 0; i < points.count; ++i) {
            const LightSample sample = sample_seen_light(context.shading, context.lights, seen, receiver,
                                                         points.at(i, shift), pattern.light_share(points.count));
            if (!lit.is_reached(sample.direction)) continue;
            shadows.add(make_shadow_ray(lit, sample), sample.pdf,
                        scatter_towards(lit, sample.direction, sample.pdf, pattern.shares) * sample.incoming /
                            static_cast<float>(points.count));
        }
    }
    shadows.flush();
    return sum;
}

/// No less than the luminance of radiance that a surface scatters, per illuminance from any direction. Infinite if
/// layers other than Lambert and gloss scatter too.
float bound_reflection(const LitSurface& lit) {
    const SurfaceMaterial& material = lit.material;
    if (material.has_coat() || material.has_sheen() || material.has_glass()) {
        return std::numeric_limits<float>::infinity();
    }
    const auto largest = [](const Rgb& c) { return std::max({c.x, c.y, c.z}); };
    float bound = largest(material.diffuse) / std::numbers::pi_v<float>;
    if (material.has_glossy() && !material.is_mirror()) {
        // F D G2 / (4 n.v), with G2 at most that of the view alone.
        const glm::vec2 widths = material.widths();
        const float most_d = 1.0f / (std::numbers::pi_v<float> * widths.x * widths.y);
        const float alpha2 = std::min(widths.x, widths.y) * std::min(widths.x, widths.y), cosine = lit.cos_view;
        const float most_g = 0.5f / (cosine + std::sqrt(alpha2 + (1.0f - alpha2) * cosine * cosine));
        bound += std::max(largest(material.gloss.f0), material.gloss.f90) * most_d * most_g;
    }
    return bound;
}

/// Returns whether all samples of the lobes have the same direction.
bool is_single_mirror(const LitSurface& lit, const LobeShares& shares) {
    const auto share = [&](Lobe lobe) { return shares[static_cast<std::size_t>(lobe)]; };
    const SurfaceMaterial& material = lit.material;
    return (material.is_mirror() && share(Lobe::gloss) == 1.0f) ||
           (material.is_coat_mirror() && share(Lobe::coat) == 1.0f);
}

}  // namespace

Rgb sample_direct_light(const LightingContext& context, RayTask& task, const LitSurface& lit, const LobeShares& shares,
                        const PixelSequence& sequence, const DirectSamples& samples) {
    CutLimits limits;
    const float reflection = samples.tolerance > 0.0f ? bound_reflection(lit) : 0.0f;
    if (reflection > 0.0f) limits.divided = limits.left_out = samples.tolerance / reflection;
    ChosenLights lights(context, lit, shares, limits);
    if (samples.left_out != nullptr)
        *samples.left_out = limits.left_out > 0.0f ? lights.cut().left_out * reflection : 0.0f;
    if (!std::isfinite(lights.cut().total)) return Rgb(lights.cut().total);
    Rgb sum(0.0f);
    ShadowBatch shadows(context, task, sum);
    SequenceOfUse points = sequence.of(SampleUse::light_point);
    for (int i = samples.first; i < samples.first + samples.count; ++i) {
        lights.add_sample(points.at(i), samples.count, 0.0f, shadows);
    }
    shadows.flush();
    return sum;
}

SampledLight compute_sampled_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface,
                                   const LightPoints& points, RandomStream& random, const LobePaths& paths) {
    const LitSurface lit(surface);
    const bool lights_can_be_met = !context.lights.emitters.empty() || context.lights.has_environment;
    LobeShares shares{};
    if (lights_can_be_met || paths.beyond.left.depth > 0) {
        shares = paths.shares != nullptr ? *paths.shares : share_lobes(lit, LobeSet::specular);
    }
    SampledLight light{sample_lights(context, task, lit, RandomPattern{random, points, shares})};
    const glm::vec2 shift = random.next_2d();
    const float pick_shift = random.next();
    if (shares == LobeShares{}) return light;
    const int count = is_single_mirror(lit, shares) ? 1 : points.count;
    PathState state = paths.beyond;
    if (count < points.count) {
        state.light_samples *= points.count;
        state.survival *= static_cast<float>(points.count);
    }
    for (int i = 0; i < count; ++i) {
        const float pick = fraction(pick_shift + static_cast<float>(i * points.parts + points.part) * 0.75487767f);
        const ScatterSample sample = sample_scatter(lit, shares, pick, points.at(i, shift), paths.random.next());
        light.lobes += follow_sample(context, task, lit, sample, state, paths.random);
    }
    light.lobes /= static_cast<float>(count);
    return light;
}

Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples) {
    const ViewedSurface widened = widen_lobes(surface);
    return sample_lights(context, task, LitSurface(widened), FixedPattern{{samples}});
}

}  // namespace aleph
