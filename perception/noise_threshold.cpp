#include "perception/noise_threshold.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/base/pyramid.h"
#include "perception/visible_bands.h"
#include "perception/vision/castle.h"
#include "perception/vision/display_hold.h"
#include "perception/vision/velocity_scale.h"

namespace aleph {

namespace {

constexpr int luminance_nodes = 15, velocity_nodes = 25, frequency_nodes = 28, time_nodes = 8;
constexpr double lowest_frequency = 0.002;  // cycles per pixel
const VelocityScale velocities(velocity_nodes, 100.0);

/// A frequency over space, and the share of the noise's energy around it.
struct Annulus {
    double frequency = 0.0, energy = 0.0;  ///< cycles per pixel
};

/// Annuli evenly spaced in the logarithm of frequency, cut by the square of the pixel grid's frequencies.
std::array<Annulus, frequency_nodes> annuli() {
    std::array<Annulus, frequency_nodes> out;
    const double highest = std::numbers::sqrt2 / 2.0,
                 ratio = std::pow(highest / lowest_frequency, 1.0 / frequency_nodes);
    for (int i = 0; i < frequency_nodes; ++i) {
        const double inner = lowest_frequency * std::pow(ratio, i), f = inner * std::sqrt(ratio);
        const double arc = f <= 0.5 ? 2.0 * std::numbers::pi : 2.0 * std::numbers::pi - 8.0 * std::acos(0.5 / f);
        out[i] = {f, arc * f * inner * (ratio - 1.0)};
    }
    return out;
}

/// The band of a frequency, cycles per pixel: bands meet at the geometric mean of their frequencies.
std::size_t band_of(double frequency, const std::vector<BandShape>& shapes) {
    std::size_t band = 0;
    while (band + 1 < noise_bands && frequency * frequency < shapes[band].frequency * shapes[band + 1].frequency)
        ++band;
    return band;
}

/// The parts of the channels' responses to a frequency over time that are the same for every luminance.
struct TemporalResponse {
    double sustained = 0.0;  ///< castle_sustained_response
    double power = 0.0;      ///< of the frequency, as castle_transient_response has it

    explicit TemporalResponse(double omega)
        : sustained(castle_sustained_response(omega)), power(std::pow(omega, castle_transient_power)) {}
};

/// Sensitivities to a frequency at a luminance.
struct Sensitivities {
    double sustained = 0.0, transient = 0.0, peak_power = 0.0;

    /// @param rho  cycles per degree
    Sensitivities(double rho, double luminance)
        : peak_power(std::pow(castle_transient_peak(luminance), castle_transient_power)) {
        const double radius = 1.5 / rho, area = std::numbers::pi * radius * radius;
        sustained = castle_sustained(rho, luminance, area);
        transient = castle_transient(rho, luminance, area);
    }
    /// To what changes so on the retina.
    double at(const TemporalResponse& response) const {
        const double away = response.power - peak_power;
        return response.sustained * sustained + std::exp(-away * away / castle_transient_scale) * transient;
    }
};

/// The responses to a frequency over space at each velocity on the retina, which shifts the frequencies of the noise up
/// and down.
class ShiftedResponses {
  public:
    ShiftedResponses(double rho, const FrameRate& frame_rate, NoiseOverTime over_time)
        : times_(over_time == NoiseOverTime::fresh ? time_nodes : 1) {
        for (int r = 0; r < velocity_nodes; ++r) {
            const double shift = rho * velocities.velocity(r);
            for (int t = 0; t < times_; ++t) {
                const double omega = times_ == 1 ? 0.0 : 0.5 * frame_rate.per_second() * (t + 0.5) / times_;
                for (const double shifted : {omega + shift, std::abs(omega - shift)})
                    responses_[r].emplace_back(shifted);
            }
        }
    }
    /// Mean square over time.
    double square(int velocity, const Sensitivities& sensitivities) const {
        double sum = 0.0;
        for (const TemporalResponse& response : responses_[velocity])
            sum += 0.5 * std::pow(sensitivities.at(response), 2.0) / times_;
        return sum;
    }

  private:
    int times_;
    std::array<std::vector<TemporalResponse>, velocity_nodes> responses_;
};

/// Shares of each annulus and band that a display leaves which holds its frames, at a velocity of what is tracked.
struct HeldShares {
    std::array<double, frequency_nodes> squares{};
    std::array<double, noise_bands> bands{};
};

/// Contrasts of the picture's finest bands at each pixel, amplitudes over the luminance that the eye is adapted to.
std::vector<BandContrasts> find_contrasts(const Image<Rgb>& picture, double white, const Image<float>& adaptation) {
    std::vector<BandContrasts> contrasts(picture.size(), BandContrasts{});
    const std::vector<BandShape> shapes = visible_bands(picture.width, picture.height);
    const std::vector<LevelSize> sizes = pyramid_sizes(picture.width, picture.height, shapes.back().level + 1);
    const std::vector<Image<float>> bands = split_bands(compute_visual_channel(picture, white, 0), noise_bands);
    parallel_each(bands.size(), 1, [&](std::size_t b) {
        const Image<float> amplitude = expand_to_level(local_amplitude(bands[b], shapes[b]), sizes, shapes[b].level, 0);
        for (std::size_t i = 0; i < contrasts.size(); ++i)
            contrasts[i][b] = std::max(0.0f, amplitude.pixels[i]) / clamp_threshold_luminance(adaptation.pixels[i]);
    });
    return contrasts;
}

}  // namespace

NoiseVisibility::NoiseVisibility(const ViewingConditions& viewing, const FrameRate& frame_rate, NoiseOverTime over_time)
    : sensitivity_(static_cast<std::size_t>(luminance_nodes * velocity_nodes * velocity_nodes)) {
    const std::array<Annulus, frequency_nodes> space = annuli();
    const std::vector<BandShape> shapes = visible_bands(256, 256);  // the finest are those of any size
    std::array<double, frequency_nodes> rho{};                      // cycles per degree
    std::vector<ShiftedResponses> noise;
    for (int i = 0; i < frequency_nodes; ++i) {
        rho[i] = space[i].frequency * viewing.pixels_per_degree;
        noise.emplace_back(rho[i], frame_rate, over_time);
    }
    std::array<double, noise_bands> pattern_rho{};
    for (std::size_t b = 0; b < noise_bands; ++b) pattern_rho[b] = shapes[b].frequency * viewing.pixels_per_degree;
    std::array<HeldShares, velocity_nodes> held{};
    for (int f = 0; f < velocity_nodes; ++f) {
        const auto at = [&](double of) {
            return hold_transfer(of, velocities.velocity(f), viewing.persistence, frame_rate);
        };
        for (int i = 0; i < frequency_nodes; ++i) held[f].squares[i] = std::pow(at(rho[i]), 2.0);
        for (std::size_t b = 0; b < noise_bands; ++b) held[f].bands[b] = at(pattern_rho[b]);
    }
    parallel_each(luminance_nodes, 1, [&](std::size_t l) {
        const double luminance = LuminanceGrid::luminance(static_cast<int>(l), luminance_nodes - 1);
        std::vector<Sensitivities> of_noise, of_bands;
        for (const double frequency : rho) of_noise.emplace_back(frequency, luminance);
        for (const double frequency : pattern_rho) of_bands.emplace_back(frequency, luminance);
        for (int r = 0; r < velocity_nodes; ++r) {
            std::array<double, frequency_nodes> squares{};  // sensitivity over time
            for (int i = 0; i < frequency_nodes; ++i) squares[i] = noise[i].square(r, of_noise[i]);
            std::array<double, noise_bands> pattern{};
            for (std::size_t b = 0; b < noise_bands; ++b)
                pattern[b] = of_bands[b].at(TemporalResponse(pattern_rho[b] * velocities.velocity(r)));
            for (int f = 0; f < velocity_nodes; ++f) {
                std::array<double, noise_bands> energy{};
                for (int i = 0; i < frequency_nodes; ++i)
                    energy[band_of(space[i].frequency, shapes)] += space[i].energy * squares[i] * held[f].squares[i];
                const std::size_t at = (l * velocity_nodes + static_cast<std::size_t>(r)) * velocity_nodes;
                Bands& bands = sensitivity_[at + static_cast<std::size_t>(f)];
                for (std::size_t b = 0; b < noise_bands; ++b)
                    bands[b] = {static_cast<float>(std::sqrt(2.0 * energy[b])),
                                static_cast<float>(pattern[b] * held[f].bands[b])};
            }
        }
    });
}

float NoiseVisibility::threshold(float luminance, float retinal, float tracked, const BandContrasts& contrasts) const {
    const auto l = LuminanceGrid::place(fast_log2(LuminanceGrid::clamp(luminance)), luminance_nodes - 1);
    const auto r = velocities.place(retinal), f = velocities.place(tracked);
    Bands sum{};
    for (int i = 0; i < 8; ++i) {
        const int a = i & 1, b = (i >> 1) & 1, c = i >> 2;
        const float weight = (a ? l.fraction : 1.0f - l.fraction) * (b ? r.fraction : 1.0f - r.fraction) *
                             (c ? f.fraction : 1.0f - f.fraction);
        const int at = ((l.node + a) * velocity_nodes + r.node + b) * velocity_nodes + f.node + c;
        for (std::size_t band = 0; band < noise_bands; ++band) {
            sum[band].noise += weight * sensitivity_[static_cast<std::size_t>(at)][band].noise;
            sum[band].pattern += weight * sensitivity_[static_cast<std::size_t>(at)][band].pattern;
        }
    }
    float visible2 = 0.0f;
    for (std::size_t band = 0; band < noise_bands; ++band) {
        const float masked = sum[band].noise / contrast_masking(sum[band].pattern * contrasts[band], 0);
        visible2 += masked * masked;
    }
    return clamp_threshold_luminance(luminance) / std::max(1.0f, std::sqrt(visible2));
}

Image<float> compute_noise_threshold(const NoiseVisibility& noise, const Image<Rgb>& picture, double white,
                                     const Image<float>& adaptation_luminance, const Image<float>& retinal,
                                     const Image<float>& velocity) {
    if (!same_size(adaptation_luminance, retinal) || !same_size(picture, retinal) ||
        !(velocity.empty() || same_size(retinal, velocity)))
        throw InputError("", "noise threshold", "picture, adaptation luminance and velocities differ in size");
    const std::vector<BandContrasts> contrasts = find_contrasts(picture, white, adaptation_luminance);
    Image<float> out(retinal.width, retinal.height);
    parallel_each(out.size(), 4096, [&](std::size_t i) {
        const float moved = retinal.pixels[i], seen = velocity.empty() ? 0.0f : velocity.pixels[i];
        out.pixels[i] =
            noise.threshold(adaptation_luminance.pixels[i], moved, seen > moved ? seen - moved : 0.0f, contrasts[i]);
    });
    return out;
}

}  // namespace aleph
