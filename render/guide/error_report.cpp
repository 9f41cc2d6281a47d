#include "render/guide/error_report.h"

#include <algorithm>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "render/guide/accuracy_map.h"

namespace aleph {

namespace {

/// Squared errors, as the samples have them.
struct SquaredErrors {
    double total = 0.0;
    std::array<double, light_part_count> parts{};
};

/// Returns the squared errors of a pixel's mean, from the pixel and those around it that are like it (estimate_mean).
SquaredErrors estimate_sampling(const Image<PixelSamples>& pixels, const Image<Outline>& outlines, int x, int y) {
    SquaredErrors sum;
    int count = 0;
    visit_around(pixels, x, y, 1, [&](int nx, int ny) {
        const PixelSamples::Error& error = pixels(nx, ny).error();
        if (error.samples == 0 || !are_alike(outlines, x, y, nx, ny)) return;
        ++count;
        sum.total += static_cast<double>(error.total) * error.samples;
        for (std::size_t i = 0; i < sum.parts.size(); ++i) {
            sum.parts[i] += static_cast<double>(error.parts[i]) * error.samples;
        }
    });
    const double scale = count == 0 ? 0.0 : 1.0 / (static_cast<double>(count) * std::max(1, pixels(x, y).taken()));
    sum.total *= scale;
    for (double& part : sum.parts) part *= scale;
    return sum;
}

using CauseErrors = std::array<double, cause_count>;

/// Squared errors by cause, of a pixel that is not shown white.
/// @param accuracy  alpha
CauseErrors find_causes(const PixelSamples& pixel, const SquaredErrors& sampled, float accuracy, bool blurred) {
    CauseErrors errors{};
    const auto error = [&errors](ErrorCause cause) -> double& { return errors[static_cast<std::size_t>(cause)]; };
    double& of_surfaces = error(blurred ? ErrorCause::blur : ErrorCause::edges);
    if (pixel.has_edge()) {
        of_surfaces = sampled.total;
    } else {
        of_surfaces = sampled.parts[static_cast<std::size_t>(LightPart::surface)];
        error(ErrorCause::direct) = sampled.parts[static_cast<std::size_t>(LightPart::direct)];
        error(ErrorCause::gloss) = sampled.parts[static_cast<std::size_t>(LightPart::gloss)];
    }
    of_surfaces += pixel.seen_variance();
    const double indirect = error_per_accuracy * accuracy * static_cast<double>(luminance(pixel.mean_indirect()));
    error(ErrorCause::indirect) = indirect * indirect;
    return errors;
}

/// Share of a mean of eight squares of normal numbers that is beyond limit^2: of chi-square of 8 degrees of freedom.
double share_beyond(double deviation, double limit) {
    if (!(deviation > 0.0)) return 0.0;
    const double half = 4.0 * (limit / deviation) * (limit / deviation);
    return half > 700.0 ? 0.0 : std::exp(-half) * (1.0 + half * (1.0 + half / 2.0 * (1.0 + half / 3.0)));
}

}  // namespace

const std::array<std::string, cause_count>& cause_names() {
    static const std::array<std::string, cause_count> names{"edges", "blur", "direct", "gloss", "indirect"};
    return names;
}

ErrorMaps estimate_errors(const Image<PixelSamples>& pixels, const VisibleLimits& limits, double exposure,
                          bool blurred) {
    const double white = 1.0 / exposure;                                     // radiance that is shown as white
    const double luminance_scale = exposure * limits.viewing.display_white;  // cd/m2 for a luminance of 1 of samples
    ErrorMaps maps;
    maps.reach = find_seen_reach(limits.viewing.pixels_per_degree);
    maps.total = Image<float>(pixels.width, pixels.height);
    maps.by_cause.fill(maps.total);
    parallel_pixels(maps.total, 4, [&](int x, int y) {
        if (is_shown_white(pixels(x, y), white)) return;
        const CauseErrors errors =
            find_causes(pixels(x, y), estimate_sampling(pixels, limits.outlines, x, y), limits.accuracy(x, y), blurred);
        double total = 0.0;
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const bool cached = i == static_cast<std::size_t>(ErrorCause::indirect);
            const double limit = cached ? limits.threshold(x, y) : limits.noise(x, y);
            const double units = limit > 0.0 ? std::sqrt(errors[i]) * luminance_scale / limit : 0.0;
            total += units * units;
            maps.by_cause[i](x, y) = static_cast<float>(units);
        }
        maps.total(x, y) = static_cast<float>(std::sqrt(total));
    });
    return maps;
}

ErrorShares count_errors(const ErrorMaps& maps, double asked) {
    const auto mean_share = [asked, reach = maps.reach](const Image<float>& map) {
        Image<float> energy = map;
        for (float& value : energy.pixels) value *= value;
        double sum = 0.0;
        for (const float around : mean_around(energy, reach, true).pixels)
            sum += share_beyond(std::sqrt(static_cast<double>(around)), asked);
        return map.empty() ? 0.0 : sum / static_cast<double>(map.size());
    };
    ErrorShares shares{asked, mean_share(maps.total)};
    for (std::size_t i = 0; i < cause_count; ++i) shares.by_cause[i] = mean_share(maps.by_cause[i]);
    return shares;
}

}  // namespace aleph
