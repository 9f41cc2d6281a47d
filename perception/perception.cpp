#include "perception/perception.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/base/opponent_color.h"
#include "engine/base/pixel_loops.h"
#include "perception/aleph_map.h"
#include "perception/band_response.h"
#include "perception/saliency/saliency.h"
#include "perception/threshold.h"

namespace aleph {

namespace {

constexpr double min_displacement = 1e-3;  // pixels per frame; less is rounding

void check_input(const Image<Rgb>& estimate, const Image<float>& velocity, const ViewingConditions& viewing,
                 const FrameRate& frame_rate, const PerceptionSettings& settings) {
    if (estimate.empty()) throw InputError("", "estimate", "the image is empty");
    if (!same_size(estimate, velocity)) throw InputError("", "velocity", "not of the estimate's size");
    check_viewing(viewing);
    if (!(std::isfinite(frame_rate.per_second()) && frame_rate.per_second() > 0.0)) {
        throw InputError("", "frames per second", "must be positive and finite");
    }
    if (settings.vision == nullptr) throw InputError("", "vision", "there is no model of vision");
}

/// Velocity for the motion channel, deg/s: rounding counts as rest; at most the image diagonal per frame.
Image<float> cap_motion(const Image<float>& velocity, const ViewingConditions& viewing, const FrameRate& frame_rate) {
    const double per_pixel = frame_rate.per_second() / viewing.pixels_per_degree;  // deg/s of 1 pixel per frame
    const auto smallest = static_cast<float>(min_displacement * per_pixel);
    const auto largest = static_cast<float>(std::min(std::hypot(velocity.width, velocity.height) * per_pixel, 1e15));
    Image<float> out(velocity.width, velocity.height);
    parallel_pixels(velocity, rows_per_band, [&](int x, int y) {
        const float v = velocity(x, y), capped = v < largest ? v : largest;
        out(x, y) = v >= smallest ? capped : 0.0f;
    });
    return out;
}

/// The levels that saliency reads: without level 0, which would take as much memory as three times all others.
std::vector<Image<float>> make_coarse_levels(Image<float> channel) {
    std::vector<Image<float>> levels = make_gaussian_pyramid(std::move(channel), saliency_levels);
    levels[0] = {};
    return levels;
}

/// @param motion  as cap_motion gives it
/// @param a       Gaussian levels of A
Saliency find_saliency(const Image<Rgb>& estimate, Image<float> motion, std::vector<Image<float>> a, float a_maximum,
                       const PerceptionSettings& settings) {
    const auto opponent_pyramid = [&](OpponentChannel channel) {
        return make_coarse_levels(compute_opponent(estimate, channel, settings.neutral_opponent));
    };
    const ChannelPyramids pyramids{.size = {estimate.width, estimate.height},
                                   .a = std::move(a),
                                   .c1 = opponent_pyramid(OpponentChannel::c1),
                                   .c2 = opponent_pyramid(OpponentChannel::c2),
                                   .velocity = make_coarse_levels(std::move(motion))};
    return compute_saliency(pyramids, a_maximum, settings.grid);
}

/// The maps of guide `none`.
PerceptionMaps make_flat_maps(int width, int height, bool with_retinal_velocity) {
    PerceptionMaps maps;
    maps.aleph = Image<float>(width, height, 1.0f);
    if (with_retinal_velocity) maps.retinal_velocity = Image<float>(width, height, static_cast<float>(drift_velocity));
    return maps;
}

}  // namespace

PerceptionMaps compute_perception(const Image<Rgb>& estimate, const Image<float>& velocity,
                                  const ViewingConditions& viewing, const FrameRate& frame_rate,
                                  const PerceptionSettings& settings, const PerceptionOutputs& outputs) {
    check_input(estimate, velocity, viewing, frame_rate, settings);
    if (settings.guide == Guide::none) {
        return make_flat_maps(estimate.width, estimate.height, outputs.retinal_velocity);
    }

    const FlushDenormals flush;
    const bool salient = settings.guide == Guide::saliency;
    Image<float> achromatic = compute_opponent(estimate, OpponentChannel::a, false);
    const ChannelSummary a_summary = summarize(achromatic);
    for (float& value : achromatic.pixels) value -= a_summary.mean;
    std::vector<Image<float>> a =
        make_gaussian_pyramid(std::move(achromatic), salient ? saliency_levels : band_count + 1);
    const BandLevels bands = make_band_levels(a, a_summary.mean);

    PerceptionMaps maps;
    Saliency saliency;
    if (salient) {
        saliency = find_saliency(estimate, cap_motion(velocity, viewing, frame_rate), std::move(a), a_summary.maximum,
                                 settings);
    }
    const VisionModel& vision = *settings.vision;
    AlephPass pass{.bands = bands,
                   .velocity = settings.guide == Guide::spatial ? nullptr : &velocity,
                   .saliency = salient ? &saliency.map : nullptr,
                   .rho = band_frequencies(settings.bands, viewing.pixels_per_degree),
                   .vision = vision,
                   .shown = {viewing, frame_rate}};
    if (vision.uses_luminance()) {
        maps.adaptation = compute_adaptation_luminance(estimate, viewing);
        pass.luminance = &maps.adaptation;
    }
    compute_aleph(pass, outputs, maps);
    maps.saliency = std::move(saliency.map);
    maps.fallback = saliency.fallback;
    if (salient && outputs.conspicuity) {
        maps.conspicuity_intensity = full_conspicuity(saliency, FeatureChannel::intensity);
        maps.conspicuity_color = full_conspicuity(saliency, FeatureChannel::color);
        maps.conspicuity_orientation = full_conspicuity(saliency, FeatureChannel::orientation);
        maps.conspicuity_motion = full_conspicuity(saliency, FeatureChannel::motion);
    }
    return maps;
}

}  // namespace aleph
