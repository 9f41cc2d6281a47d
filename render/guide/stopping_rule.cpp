#include "render/guide/stopping_rule.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"

namespace aleph {

namespace {

constexpr int thesis_samples = 16;        // least number of the thesis's rules
constexpr int outline_samples = 8;        // where few neighbours are alike, and each may miss what the others see
constexpr int small_object_samples = 32;  // hardly all of them miss what fills a tenth of the pixel

/// Sums over pixels around one.
struct NoiseSum {
    double error2 = 0.0, variance = 0.0;  ///< of one sample
    int count = 0;

    void add(const PixelSamples& pixel) {
        if (pixel.error().samples == 0) return;
        error2 += static_cast<double>(pixel.error().total) * pixel.error().samples;
        variance += pixel.sample_variance();
        ++count;
    }
};

NoiseSum sum_around(const Image<PixelSamples>& pixels, const Image<Outline>& outlines, int x, int y) {
    NoiseSum sum;
    visit_around(pixels, x, y, 2, [&](int nx, int ny) {
        if ((nx != x || ny != y) && are_alike(outlines, x, y, nx, ny)) sum.add(pixels(nx, ny));
    });
    return sum;
}

/// A value as a sum, and how many it is of: 0 if it is not known.
glm::dvec2 count_known(float value) {
    return value >= 0.0f ? glm::dvec2(value, 1.0) : glm::dvec2(0.0);
}

}  // namespace

bool is_shown_white(const PixelSamples& pixel, double white, double around) {
    const Rgb mean = pixel.mean();
    const double least = std::min({mean.x, mean.y, mean.z});
    if (!(least > white)) return false;
    const double variance = std::max(pixel.variance(), around / pixel.valid());
    return least * (1.0 - 3.0 * std::sqrt(variance) / luminance(mean)) > white;
}

MeanEstimate estimate_mean(const Image<PixelSamples>& pixels, const Image<Outline>& outlines, int x, int y) {
    NoiseSum sum = sum_around(pixels, outlines, x, y);
    if (sum.count == 0) sum = sum_around(pixels, {}, x, y);
    if (pixels.size() == 1) sum.add(pixels(x, y));
    MeanEstimate estimate{pixels(x, y).taken()};
    if (sum.count == 0) return estimate;
    estimate.error2 = sum.error2 / (sum.count * static_cast<double>(estimate.samples));
    estimate.variance = sum.variance / sum.count;
    return estimate;
}

Image<float> deviations_around(const Image<PixelSamples>& pixels, int reach) {
    constexpr float normal = 0.797884561f;  // mean size of a normal number: the halves of a pixel tell one
    Image<float> deviations(pixels.width, pixels.height);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const PixelSamples::Error& error = pixels.pixels[i].error();
        deviations.pixels[i] =
            error.samples == 0 ? -1.0f : std::sqrt(error.total * static_cast<float>(error.samples)) / normal;
    }
    return mean_around(deviations, reach, false);
}

MeanEstimate estimate_own_mean(const PixelSamples& pixel) {
    return {pixel.taken(), static_cast<double>(pixel.error().total), pixel.sample_variance()};
}

bool is_enough(Sampling rule, Stopping stopping, const MeanEstimate& mean, double tolerance) {
    const double tolerated2 = tolerance > 0.0 ? tolerance * tolerance : 0.0;
    if (rule == Sampling::consecutive) return mean.error2 <= tolerated2;
    if (rule == Sampling::variance)
        return (stopping == Stopping::pixel ? mean.variance : mean.variance / mean.samples) <= tolerated2;
    if (rule != Sampling::threshold) return true;
    return error_deviations * error_deviations * std::sqrt(mean.error2 / mean.samples) * mean.around <= tolerated2;
}

bool stands_out(const PixelSamples& pixel, double tolerance) {
    return std::sqrt(static_cast<double>(pixel.error().total)) > tolerance;
}

int protocol_samples(double aleph, int most) {
    const double samples = std::ceil(most / std::max(1.0, aleph));  // with the arguments in this order, 1 for NaN
    return std::min(most, std::max(thesis_samples, static_cast<int>(samples)));
}

double allow_noise(double error) {
    return std::min(error, std::pow(error, 0.8));
}

int first_samples(Sampling rule, Outline outline, int most) {
    if (rule == Sampling::uniform || rule == Sampling::protocol) return most;
    if (rule != Sampling::threshold) return std::min(most, thesis_samples);
    if (outline == Outline::small || outline == Outline::strong) return std::min(most, small_object_samples);
    return std::min(most, outline == Outline::none ? own_samples : outline_samples);
}

int find_seen_reach(double pixels_per_degree) {
    constexpr double degrees = 4.0 / 31.0;
    return static_cast<int>(std::clamp(std::round(degrees * pixels_per_degree), 1.0, 1000.0));
}

Image<float> mean_around(const Image<float>& values, int reach, bool with_own) {
    const int width = values.width, height = values.height;
    Image<glm::dvec2> rows(width, height, glm::dvec2(0.0));  // sums, and numbers of values
    Image<float> means(width, height);
    parallel_pixels(values, 8, [&](int x, int y) {
        for (int nx = std::max(0, x - reach); nx <= std::min(width - 1, x + reach); ++nx)
            rows(x, y) += count_known(values(nx, y));
    });
    parallel_pixels(values, 8, [&](int x, int y) {
        glm::dvec2 sum(0.0);
        for (int ny = std::max(0, y - reach); ny <= std::min(height - 1, y + reach); ++ny) sum += rows(x, ny);
        const glm::dvec2 own = count_known(values(x, y));
        if (!with_own && sum.y > own.y) sum -= own;
        means(x, y) = sum.y > 0.0 ? static_cast<float>(std::max(0.0, sum.x) / sum.y) : -1.0f;
    });
    return means;
}

}  // namespace aleph
