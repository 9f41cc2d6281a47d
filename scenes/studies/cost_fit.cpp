#include "scenes/studies/cost_fit.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr double least_growth = 0.02;  // of a frame's seconds: less is noise

struct WeightedMean {
    double sum = 0.0, weight = 0.0;

    void add(double value, double w) {
        sum += w * value;
        weight += w;
    }
    double value_or(double fallback) const { return weight > 0.0 ? sum / weight : fallback; }
};

struct Fit {
    WeightedMean shade, overlap, fill, keyframes, shade_exponent, light_exponent;

    void add(const MeasuredFrame& frame, std::size_t i) {
        const PilotSeconds& pilot = frame.pilot;
        const CostParts &whole = frame.whole[i], &loosest = frame.whole.front();
        const double all = whole.sum();
        if (pilot.keyframes > 0.0) {
            shade.add(pilot.parts[i].shade / pilot.share / whole.shade, whole.shade / all);
        }
        const double light = (pilot.parts[i].fill - pilot.parts.front().fill) / pilot.share;
        if (light < least_growth * all) return;
        if (pilot.keyframes > 0.0) {
            fill.add((whole.fill - loosest.fill) / light, light / all);
            keyframes.add((whole.keyframes - loosest.keyframes) / (pilot.keyframes * light), light / all);
        } else {
            overlap.add(light / std::max(whole.fill - loosest.fill, least_growth * light), light / all);
        }
    }

    /// How the part's growth follows the error, from one error to the next.
    void add_growth(const MeasuredFrame& frame, std::size_t i) {
        const std::vector<PartSeconds>& parts = frame.pilot.parts;
        const double step = std::log(parts[i - 1].error / parts[i].error), all = frame.whole[i].sum();
        const auto add = [&](WeightedMean& exponent, double PartSeconds::*seconds) {
            const double before = parts[i - 1].*seconds - parts[0].*seconds,
                         now = parts[i].*seconds - parts[0].*seconds;
            if (before / frame.pilot.share < least_growth * all || now < before) return;
            exponent.add(std::log(now / before) / step, now / frame.pilot.share / all);
        };
        add(shade_exponent, &PartSeconds::shade);
        add(light_exponent, &PartSeconds::fill);
    }
};

}  // namespace

CostCoefficients fit_coefficients(const std::vector<MeasuredFrame>& frames) {
    Fit fit;
    for (const MeasuredFrame& frame : frames) {
        for (std::size_t i = 0; i < frame.whole.size(); ++i) {
            fit.add(frame, i);
            if (i > 1) fit.add_growth(frame, i);
        }
    }
    const CostCoefficients usual = fitted_coefficients();
    return {.shade = fit.shade.value_or(usual.shade),
            .overlap = fit.overlap.value_or(usual.overlap),
            .fill = fit.fill.value_or(usual.fill),
            .keyframes = fit.keyframes.value_or(usual.keyframes),
            .shade_exponent = fit.shade_exponent.value_or(usual.shade_exponent),
            .light_exponent = fit.light_exponent.value_or(usual.light_exponent)};
}

}  // namespace aleph
