#include "render/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aleph {

namespace {

constexpr float min_estimate_alpha = 0.1f;  // GGX width of the quick estimate's lobes
constexpr int batch_size = 16;              // shadow rays from one point, in one packet

/// Shadow rays collected until a packet is full. The contributions of those that are not blocked are added in order.
class ShadowBatch {
  public:
    ShadowBatch(const LightingContext& context, RayTask& task, Rgb& sum) : context_(context), task_(task), sum_(sum) {}

    void add(const Ray& ray, const Rgb& contribution) {
        if (contribution == Rgb(0.0f)) return;
        if (context_.shading.has_sheets) {
            sum_ += contribution * find_transmittance(context_, task_, ray);
            return;
        }
        rays_[size_] = ray;
        contributions_[size_++] = contribution;
        if (size_ == batch_size) flush();
    }

    void flush() {
        std::array<std::uint8_t, batch_size> blocked;
        task_.tracer.occluded(std::span(rays_.data(), size_), std::span(blocked.data(), size_));
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
    surface.material.alpha = std::max(surface.material.alpha, min_estimate_alpha);
    surface.material.coat_alpha = std::max(surface.material.coat_alpha, min_estimate_alpha);
    return surface;
}

bool has_area(const LightSet& lights, int light) {
    const int emitters = static_cast<int>(lights.emitters.size());
    return light < emitters || light >= emitters + static_cast<int>(lights.punctual.size());
}

/// The scattered light of samples of every light, as a pattern places and weighs them.
template <class Pattern>
Rgb sample_lights(const LightingContext& context, RayTask& task, const LitSurface& lit, Pattern pattern) {
    Rgb sum(0.0f);
    ShadowBatch shadows(context, task, sum);
    const Receiver receiver{lit.point.ray_origin(), lit.point.normal};
    for (int light = 0; light < context.lights.count(); ++light) {
        const LightPoints points = has_area(context.lights, light) ? pattern.points : LightPoints{};
        const glm::vec2 shift = pattern.next_shift();
        for (int i = 0; i < points.count; ++i) {
            const LightSample sample = sample_light(context.shading, context.lights, light, receiver,
                                                    points.at(i, shift), pattern.light_share(points.count));
            if (!lit.is_reached(sample.direction)) continue;
            shadows.add(make_shadow_ray(lit, sample),
                        scatter_towards(lit, sample.direction, sample.pdf, pattern.shares) * sample.incoming /
                            static_cast<float>(points.count));
        }
    }
    shadows.flush();
    return sum;
}

}  // namespace

SampledLight compute_sampled_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface,
                                   const LightPoints& points, RandomStream& random, const PathState& beyond,
                                   RandomStream& path_random) {
    const LitSurface lit(surface);
    const bool lights_can_be_met = !context.lights.emitters.empty() || context.lights.has_environment;
    LobeShares shares{};
    if (lights_can_be_met || beyond.left.depth > 0) shares = share_lobes(lit, LobeSet::specular);
    SampledLight light{sample_lights(context, task, lit, RandomPattern{random, points, shares})};
    const glm::vec2 shift = random.next_2d();
    const float pick_shift = random.next();
    if (shares == LobeShares{}) return light;
    for (int i = 0; i < points.count; ++i) {
        const float pick = fraction(pick_shift + static_cast<float>(i * points.parts + points.part) * 0.75487767f);
        const ScatterSample sample = sample_scatter(lit, shares, pick, points.at(i, shift), path_random.next());
        light.lobes += follow_sample(context, task, lit, sample, beyond, path_random);
    }
    light.lobes /= static_cast<float>(points.count);
    return light;
}

Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples) {
    const ViewedSurface widened = widen_lobes(surface);
    return sample_lights(context, task, LitSurface(widened), FixedPattern{{samples}});
}

}  // namespace aleph
