#include "render/stopping_rule.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr int thesis_samples = 16;  // least number of the thesis's rules
constexpr int outline_samples = 8;  // where few neighbours are alike, and each may miss what the others see

}  // namespace

MeanEstimate estimate_mean(const Image<PixelSamples>& pixels, const Image<Outline>& outlines, int x, int y) {
    const PixelSamples& pixel = pixels(x, y);
    double error2 = 0.0, variance = 0.0;  // of one sample
    int count = 0;
    const auto add = [&](const PixelSamples& other) {
        if (other.error().samples == 0) return;
        error2 += static_cast<double>(other.error().total) * other.error().samples;
        variance += other.sample_variance();
        ++count;
    };
    const auto add_neighbours = [&](auto&& counts) {
        for (int ny = std::max(0, y - 1); ny <= std::min(pixels.height - 1, y + 1); ++ny) {
            for (int nx = std::max(0, x - 1); nx <= std::min(pixels.width - 1, x + 1); ++nx) {
                if ((nx != x || ny != y) && counts(nx, ny)) add(pixels(nx, ny));
            }
        }
    };
    add_neighbours([&](int nx, int ny) { return are_alike(outlines, x, y, nx, ny); });
    if (count == 0) add_neighbours([](int, int) { return true; });
    if (pixels.size() == 1) add(pixel);
    MeanEstimate estimate{pixel.taken()};
    if (count == 0) return estimate;
    estimate.error2 = error2 / (static_cast<double>(count) * pixel.taken());
    estimate.variance = variance / count;
    return estimate;
}

bool is_enough(Sampling rule, VarianceTest test, const MeanEstimate& mean, double tolerance) {
    const double tolerated2 = tolerance > 0.0 ? tolerance * tolerance : 0.0;
    switch (rule) {
        case Sampling::uniform:
        case Sampling::protocol:
            break;
        case Sampling::consecutive:
            return mean.error2 <= tolerated2;
        case Sampling::variance:
            return (test == VarianceTest::deviation ? mean.variance : mean.variance / mean.samples) <= tolerated2;
        case Sampling::threshold:
            return error_deviations * error_deviations * mean.error2 <= tolerated2;
    }
    return true;
}

int protocol_samples(double aleph, int most) {
    const double samples = std::ceil(most / std::max(1.0, aleph));  // with the arguments in this order, 1 for NaN
    return std::min(most, std::max(thesis_samples, static_cast<int>(samples)));
}

int first_samples(Sampling rule, Outline outline, int most) {
    switch (rule) {
        case Sampling::uniform:
        case Sampling::protocol:
            return most;
        case Sampling::consecutive:
        case Sampling::variance:
            return std::min(most, thesis_samples);
        case Sampling::threshold:
            break;
    }
    return std::min(most, outline == Outline::none ? own_samples : outline_samples);
}

}  // namespace aleph
