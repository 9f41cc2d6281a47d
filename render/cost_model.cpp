#include "render/cost_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace aleph {

namespace {

using Part = double CostParts::*;

/// One part at an error.
double predict_part(const std::vector<PilotRun>& runs, Part part, double exponent, double error) {
    double seconds = runs.front().seconds.*part;  // runs are in descending order of errors
    for (std::size_t i = 1; i < runs.size(); ++i) {
        const double before = runs[i - 1].error, next = runs[i].error;
        if (error >= before) return seconds;
        const double grown = std::max(seconds, runs[i].seconds.*part);
        if (error > next) {
            const double weight = std::log(before / error) / std::log(before / next);
            if (!(seconds > 0.0)) return weight * grown;
            return seconds * std::pow(grown / seconds, weight);
        }
        seconds = grown;
    }
    if (error >= runs.back().error) return seconds;
    return seconds * std::pow(runs.back().error / error, exponent);
}

void check(const std::vector<PilotRun>& runs, double error) {
    if (runs.empty()) throw std::invalid_argument("a cost needs a pilot");
    if (!(error > 0.0) || !std::isfinite(error)) throw std::invalid_argument("the error of a cost is not above 0");
    for (const PilotRun& run : runs) {
        const double seconds = run.seconds.sum() + run.start;
        if (!(run.error > 0.0) || !std::isfinite(run.error) || !(seconds >= 0.0) || !std::isfinite(seconds)) {
            throw std::invalid_argument("a pilot's error or seconds are out of range");
        }
    }
}

}  // namespace

// build/study_cost scenes/cornell/scene.json@15 scenes/pool/scene.json@20 scenes/boomerang/scene.json@45 --size 120x90
// --errors 4,2,1 -t 1
CostCoefficients fitted_coefficients() {
    return {{0.0, 0.72, 0.81, 0.68, 0.31}, {0.0, 0.0, 1.25, 1.06, 1.56}};
}

double predict_seconds(const std::vector<PilotRun>& runs, const CostRatios& ratios,
                       const CostCoefficients& coefficients, double error) {
    check(runs, error);
    std::vector<PilotRun> sorted = runs;
    std::ranges::sort(sorted, std::greater(), &PilotRun::error);
    const auto scaled = [&](Part part, double count) {
        return count * std::pow(ratios.pixels, coefficients.size.*part) *
               predict_part(sorted, part, coefficients.error.*part, error);
    };
    double start = 0.0;
    for (const PilotRun& run : sorted) start += run.start / static_cast<double>(sorted.size());
    return start + scaled(&CostParts::constant, ratios.frames) + scaled(&CostParts::pixels, ratios.frames) +
           scaled(&CostParts::fill, ratios.frames) + scaled(&CostParts::moments, ratios.moments) +
           scaled(&CostParts::shade, ratios.frames);
}

double choose_error(const std::vector<PilotRun>& runs, const CostRatios& ratios, const CostCoefficients& coefficients,
                    double seconds) {
    const auto fits = [&](double error) { return predict_seconds(runs, ratios, coefficients, error) <= seconds; };
    for (int i = 10; i < 100; ++i) {
        if (fits(i / 100.0)) return i / 100.0;
    }
    for (int i = 10; i < 100; ++i) {
        if (fits(i / 10.0)) return i / 10.0;
    }
    return most_budget_error;
}

}  // namespace aleph
