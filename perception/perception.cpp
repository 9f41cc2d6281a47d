#include "perception/perception.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/opponent_color.h"
#include "engine/base/parallel.h"
#include "perception/aleph_map.h"
#include "perception/band_response.h"
#include "perception/saliency.h"

namespace aleph {

namespace {

constexpr double smallest_displacement = 1e-3;  // pixels; less is rounding (MODEL 5.1)

void check_input(const Image<Rgb>& estimate, const Image<float>& velocity, const ViewingConditions& viewing) {
    const auto positive = [](double v) { return std::isfinite(v) && v > 0.0; };
    if (estimate.empty()) throw InputError("", "estimate", "the image is empty");
    if (!same_size(estimate, velocity)) throw InputError("", "velocity", "not of the estimate's size");
    if (!positive(viewing.pixels_per_degree)) {
        throw InputError("", "pixels per degree", "must be positive and finite");
    }
    if (!positive(viewing.frames_per_second)) {
        throw InputError("", "frames per second", "must be positive and finite");
    }
    if (!positive(viewing.display_white)) throw InputError("", "display white", "must be positive and finite");
}

float largest_value(const Image<float>& image) {
    return *std::max_element(image.pixels.begin(), image.pixels.end());
}

/// The velocity that stands out: rounding counts as rest, and nothing moves further than the image is wide in a frame.
Image<float> make_motion_channel(const Image<float>& velocity, const ViewingConditions& viewing) {
    const double per_pixel = viewing.frames_per_second / viewing.pixels_per_degree;  // deg/s of 1 px a frame
    const auto smallest = static_cast<float>(smallest_displacement * per_pixel);
    const auto largest = static_cast<float>(std::min(std::hypot(velocity.width, velocity.height) * per_pixel, 1e15));
    Image<float> out(velocity.width, velocity.height);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const float v = velocity.pixels[i] < largest ? velocity.pixels[i] : largest;
        out.pixels[i] = velocity.pixels[i] >= smallest ? v : 0.0f;
    }
    return out;
}

void subtract(Image<float>& image, float value) {
    for (float& v : image.pixels) v -= value;
}

/// What saliency needs of a channel; level 0, at full size, is let go.
std::vector<Image<float>> make_feature_pyramid(Image<float> channel) {
    return make_gaussian_pyramid(std::move(channel), saliency_levels, finest_center);
}

}  // namespace

PerceptionMaps compute_perception(const Image<Rgb>& estimate, const Image<float>& velocity,
                                  const ViewingConditions& viewing, const PerceptionSettings& settings,
                                  const PerceptionOutputs& outputs) {
    check_input(estimate, velocity, viewing);
    PerceptionMaps maps;
    if (settings.guide == Guide::none) {
        maps.aleph = Image<float>(estimate.width, estimate.height, 1.0f);
        if (outputs.retinal_velocity) {
            maps.retinal_velocity = Image<float>(estimate.width, estimate.height, static_cast<float>(drift_velocity));
        }
        return maps;
    }

    const FlushDenormals flush;
    const bool salient = settings.guide == Guide::saliency;
    OpponentImages opponent;
    if (salient) {
        opponent = compute_opponent(estimate, settings.neutral_opponent);
    } else {
        opponent.a = compute_achromatic(estimate);
    }
    const double largest_a = largest_value(opponent.a);  // A of a clamped pixel is not negative
    const float grey = mean_grey(opponent.a);
    subtract(opponent.a, grey);
    std::vector<Image<float>> a =
        make_gaussian_pyramid(std::move(opponent.a), salient ? saliency_levels : band_count + 1);
    const BandLevels bands = take_band_levels(a, grey);

    Saliency saliency;
    if (salient) {
        const ChannelPyramids pyramids{.size = bands.sizes.front(),
                                       .a = std::move(a),
                                       .c1 = make_feature_pyramid(std::move(opponent.c1)),
                                       .c2 = make_feature_pyramid(std::move(opponent.c2)),
                                       .velocity = make_feature_pyramid(make_motion_channel(velocity, viewing))};
        saliency = compute_saliency(pyramids, largest_a, settings.grid);
    }
    AlephImages images = compute_aleph({.bands = bands,
                                        .velocity = settings.guide == Guide::spatial ? nullptr : &velocity,
                                        .saliency = salient ? &saliency : nullptr,
                                        .rho = band_frequencies(settings.bands, viewing.pixels_per_degree)},
                                       outputs.retinal_velocity);
    maps.aleph = std::move(images.aleph);
    maps.retinal_velocity = std::move(images.retinal_velocity);
    maps.saliency = std::move(saliency.map);
    maps.clamped = images.clamped;
    maps.fallback = saliency.fallback;
    if (salient && outputs.conspicuity) {
        maps.conspicuity_intensity = std::move(saliency.conspicuity[static_cast<std::size_t>(Channel::intensity)]);
        maps.conspicuity_color = std::move(saliency.conspicuity[static_cast<std::size_t>(Channel::color)]);
        maps.conspicuity_orientation = std::move(saliency.conspicuity[static_cast<std::size_t>(Channel::orientation)]);
        maps.conspicuity_motion = std::move(saliency.conspicuity[static_cast<std::size_t>(Channel::motion)]);
    }
    return maps;
}

}  // namespace aleph
