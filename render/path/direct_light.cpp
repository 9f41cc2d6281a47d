#include "render/path/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/light/light_cut.h"

namespace aleph {

namespace {

/// The part of a sample's light that nothing blocks.
Rgb find_unblocked(const LightingContext& context, RayTask& task, const LitSurface& lit, const LightSample& sample,
                   const Rgb& light) {
    if (light == Rgb(0.0f)) return light;
    const Ray ray = make_shadow_ray(lit, sample);
    Rgb passed = transmit_to_light(context.around, lit, ray);
    if (context.shading.needs_shadow_ray(sample.pdf)) passed *= find_transmittance(context, task, ray);
    return passed == Rgb(0.0f) ? passed : light * passed;
}

/// The quick estimate's choice: the same points for every pixel.
constexpr glm::vec2 estimate_shift{0.0f, 0.25f}, hidden_shift{0.0f, 0.75f};

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
    ChosenLights(const LightingContext& context, const LitSurface& lit, const LobeShares& shares)
        : context_(context),
          lit_(lit),
          shares_(shares),
          receiver_(with_openings(make_receiver(context, lit), seen_openings_)),
          cut_(find_light_cut(context.lights, receiver_, context.seen != nullptr ? &context.seen->others : nullptr)) {}

    /// Light of one sample of `count`.
    /// @param u            x chooses the light; what that leaves of it, and y, are the point on it
    /// @param light_share  sample_light
    Rgb sample(RayTask& task, const glm::vec2& u, int count, float light_share) {
        return add_light(task, pick_light(cut_, receiver_, u.x), u.y, count, light_share);
    }

    bool has_hidden() const { return context_.seen != nullptr; }

    /// The same of lights that are hidden from nearly everything.
    Rgb sample_hidden(RayTask& task, const glm::vec2& u, int count, float light_share) {
        const float share = context_.seen->share;
        if (!(u.x < share)) return Rgb(0.0f);
        if (!hidden_) hidden_ = find_light_cut(context_.lights, receiver_, &context_.seen->hidden);
        LightPick pick = pick_light(*hidden_, receiver_, u.x / share);
        pick.probability *= share;
        return add_light(task, pick, u.y, count, light_share);
    }

    const LightCut& cut() const { return cut_; }

  private:
    Rgb add_light(RayTask& task, const LightPick& pick, float v, int count, float light_share) {
        if (pick.light == no_index) return Rgb(0.0f);
        SeenLight& seen = seen_[static_cast<std::size_t>(pick.light) % seen_.size()];
        if (seen.light != pick.light) seen = see_light(context_.lights, pick.light, receiver_.position);
        const LightSample sample =
            sample_seen_light(context_.shading, context_.lights, seen, receiver_, {pick.rest, v}, light_share);
        if (sample.incoming == Rgb(0.0f) || !lit_.is_reached(sample.direction)) return Rgb(0.0f);
        return find_unblocked(context_, task, lit_, sample,
                              scatter_towards(lit_, sample.direction, sample.pdf, shares_) * sample.incoming /
                                  (pick.probability * static_cast<float>(count)));
    }

    const LightingContext& context_;
    const LitSurface& lit_;
    const LobeShares& shares_;
    std::optional<SeenOpenings> seen_openings_;
    Receiver receiver_;
    LightCut cut_;
    std::optional<LightCut> hidden_;
    std::array<SeenLight, 16> seen_;  ///< lights that were chosen last
};

/// The quick estimate of more than LightCut::few lights: samples of lights that are chosen, as many as the few would
/// have.
Rgb estimate_chosen_lights(const LightingContext& context, RayTask& task, const LitSurface& lit, int samples,
                           const LobeShares& followed) {
    ChosenLights lights(context, lit, followed);
    if (!std::isfinite(lights.cut().total)) return Rgb(lights.cut().total);
    Rgb sum(0.0f);
    const int count = samples * LightCut::few;
    const float share = 1.0f / static_cast<float>(samples);
    for (int i = 0; i < count; ++i) {
        sum += lights.sample(task, lattice_point(i, count, estimate_shift), count, share);
        if (lights.has_hidden()) sum += lights.sample_hidden(task, lattice_point(i, count, hidden_shift), count, share);
    }
    return sum;
}

/// The quick estimate of a few lights: samples of each.
Rgb estimate_few_lights(const LightingContext& context, RayTask& task, const LitSurface& lit, int samples,
                        const LobeShares& followed) {
    Rgb sum(0.0f);
    const Receiver receiver = make_lambert_receiver(context, lit.point);
    for (int light = 0; light < context.lights.count(); ++light) {
        const int count = has_area(context.lights, light) ? samples : 1;
        const float share = 1.0f / static_cast<float>(count);
        const SeenLight seen = see_light(context.lights, light, receiver.position);
        for (int i = 0; i < count; ++i) {
            const LightSample sample = sample_seen_light(context.shading, context.lights, seen, receiver,
                                                         lattice_point(i, count, estimate_shift), share);
            if (!lit.is_reached(sample.direction)) continue;
            sum +=
                find_unblocked(context, task, lit, sample,
                               scatter_towards(lit, sample.direction, sample.pdf, followed) * sample.incoming * share);
        }
    }
    return sum;
}

}  // namespace

Rgb sample_direct_light(const LightingContext& context, RayTask& task, const LitSurface& lit, const LobeShares& shares,
                        const PixelSequence& sequence, const DirectSamples& samples) {
    ChosenLights lights(context, lit, shares);
    if (!std::isfinite(lights.cut().total)) return Rgb(lights.cut().total);
    Rgb sum(0.0f);
    SequenceOfUse points = sequence.of(SampleUse::light_point);
    for (int i = samples.first; i < samples.first + samples.count; ++i)
        sum += lights.sample(task, points.at(i), samples.count, 0.0f);
    if (!lights.has_hidden()) return sum;
    SequenceOfUse choices = sequence.of(SampleUse::light_choice);
    for (int i = samples.first; i < samples.first + samples.count; ++i)
        sum += lights.sample_hidden(task, choices.at(i), samples.count, 0.0f);
    return sum;
}

Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples,
                          const LobeShares& followed) {
    const ViewedSurface widened = widen_lobes(surface);
    const LitSurface lit(widened);
    const auto& estimate = context.lights.count() <= LightCut::few ? estimate_few_lights : estimate_chosen_lights;
    return estimate(context, task, lit, samples, followed);
}

}  // namespace aleph
