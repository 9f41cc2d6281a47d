#include "render/budget/cost_model.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr double usual_exponent = 0.8;  // of pixels, for light in a picture
constexpr double least_exponent = 0.5, most_exponent = 1.3;

/// In descending order of errors. None takes longer than one of a smaller error; as measured the first may, which
/// finds caches cold.
std::vector<PartSeconds> sort_parts(std::vector<PartSeconds> parts) {
    std::ranges::sort(parts, std::greater(), &PartSeconds::error);
    for (std::size_t i = parts.size() - 1; i-- > 0;) {
        parts[i].fill = std::min(parts[i].fill, parts[i + 1].fill);
        parts[i].shade = std::min(parts[i].shade, parts[i + 1].shade);
    }
    return parts;
}

/// Growth of a part's seconds at an error, since the largest error of the pilot.
/// @param parts  sort_parts
double find_growth(const std::vector<PartSeconds>& parts, double PartSeconds::*seconds, double exponent, double error) {
    const double floor = parts.front().*seconds;
    double before = 0.0;
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const double larger = parts[i - 1].error, smaller = parts[i].error;
        if (error >= larger) return before;
        const double growth = parts[i].*seconds - floor;
        if (error > smaller) {
            if (!(before > 0.0)) return growth * std::pow(smaller / error, exponent);
            return before * std::pow(growth / before, std::log(larger / error) / std::log(larger / smaller));
        }
        before = growth;
    }
    return error >= parts.back().error ? before : before * std::pow(parts.back().error / error, exponent);
}

/// Light of the full picture at the largest error.
double extrapolate_light(std::vector<LightSeconds> light, double LightSeconds::*seconds) {
    if (light.empty()) return 0.0;
    std::ranges::sort(light, std::less(), &LightSeconds::pixels);
    const LightSeconds& large = light.front();
    const LightSeconds& small = light.back();
    double exponent = usual_exponent;
    if (small.pixels > large.pixels && small.*seconds > 0.0 && large.*seconds > 0.0) {
        exponent = std::log(large.*seconds / small.*seconds) / std::log(small.pixels / large.pixels);
    }
    return large.*seconds * std::pow(large.pixels, std::clamp(exponent, least_exponent, most_exponent));
}

}  // namespace

// Means of four fits: build/study_cost scenes/cornell/scene.json@15 scenes/pool/scene.json@20
// scenes/boomerang/scene.json@45 --size 320x240 -t 1
CostCoefficients fitted_coefficients() {
    return {
        .shade = 0.94, .overlap = 1.7, .fill = 0.18, .keyframes = 0.64, .shade_exponent = 1.9, .light_exponent = 2.2};
}

CostParts predict_seconds(const PilotSeconds& pilot, const CostRatios& ratios, const CostCoefficients& coefficients,
                          double error) {
    ALEPH_CHECK(!pilot.parts.empty(), "a cost needs a pilot");
    const std::vector<PartSeconds> parts = sort_parts(pilot.parts);
    const double light = find_growth(parts, &PartSeconds::fill, coefficients.light_exponent, error) / pilot.share;
    const double shade =
        parts.front().shade + find_growth(parts, &PartSeconds::shade, coefficients.shade_exponent, error);
    CostParts seconds;
    seconds.start = pilot.start;
    seconds.before = ratios.frames * pilot.before;
    const bool by_keyframes = pilot.keyframes > 0.0;
    seconds.shade = ratios.frames * shade / pilot.share / (by_keyframes ? coefficients.shade : 1.0);
    seconds.fill = ratios.frames * (extrapolate_light(pilot.light, &LightSeconds::fill) +
                                    (by_keyframes ? coefficients.fill : 1.0 / coefficients.overlap) * light);
    seconds.keyframes = ratios.keyframes * (extrapolate_light(pilot.light, &LightSeconds::keyframes) +
                                            coefficients.keyframes * pilot.keyframes * light);
    return seconds;
}

double choose_error(const PilotSeconds& pilot, const CostRatios& ratios, const CostCoefficients& coefficients,
                    double seconds) {
    const auto fits = [&](double error) {
        return predict_seconds(pilot, ratios, coefficients, error).sum() <= seconds;
    };
    for (const double digits : {100.0, 10.0}) {
        for (int i = 10; i < 100; ++i) {
            if (fits(i / digits)) return i / digits;
        }
    }
    return most_budget_error;
}

}  // namespace aleph
