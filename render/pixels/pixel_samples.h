#pragma once
// The samples of one pixel, added up, with what tells the error of their mean.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "engine/base/color.h"
#include "engine/base/index.h"

namespace aleph {

/// First samples of a pixel with `threshold`: its neighbours tell the error of eight times as many.
inline constexpr int own_samples = 4;

/// Samples that tell whether a pixel is shown white: hardly all of them miss what is bright in it, or what is dark.
inline constexpr int white_samples = 16;

/// Parts of a sample's light whose errors are told apart.
enum class LightPart : std::uint8_t {
    surface,  ///< everything that the first surface shows without sampling: emission and cached light
    direct,   ///< straight from the lights
    gloss,    ///< along sampled reflections and refractions
};
inline constexpr int light_part_count = 3;

/// Where the first surface of a sample is.
struct SampledPlace {
    int instance = no_index;                  ///< no_index: the background
    glm::vec3 position{0.0f};                 ///< m
    glm::vec3 geometric{0.0f}, normal{0.0f};  ///< unit, its true normal and its shading normal
    float footprint = 0.0f;                   ///< m, of a pixel there

    bool is_surface() const { return instance != no_index; }
    /// Returns whether another sample sees the same face: this object, about parallel to it and not a step behind or
    /// before it.
    bool has_face(const SampledPlace& other) const;
    /// Returns whether another sample sees the same face, with about the same irradiance.
    bool has_surface(const SampledPlace& other) const;
};

/// Light of one sample, by part.
struct SampleLight {
    std::array<Rgb, light_part_count> parts{Rgb(0.0f), Rgb(0.0f), Rgb(0.0f)};
    Rgb indirect{0.0f};             ///< what the surface reflects of its indirect irradiance; within LightPart::surface
    std::optional<Rgb> irradiance;  ///< indirect, that was looked up for it
    SampledPlace place{};
    Rgb control{0.0f};  ///< what a control variate added, within LightPart::direct

    Rgb& operator[](LightPart part) { return parts[static_cast<std::size_t>(part)]; }
    Rgb total() const { return parts[0] + parts[1] + parts[2]; }
};

/// The valid samples of a pixel so far. Sums are in double: a float sum of 65,536 samples can be off by 0.2 %. The
/// error is found from halves (README.md): an upper bound where these complement each other.
class PixelSamples {
  public:
    /// @param white  what a display shows as white in each channel: errors beyond it go unseen
    explicit PixelSamples(float white = std::numeric_limits<float>::infinity()) : white_(white) {}

    /// Squared errors of the mean, of luminance and of its red-green signal in the luminance that it is worth
    /// (noise_threshold.h): lamps of two hues may leave noise that luminance alone does not show. Channels that are
    /// shown white have none.
    struct Error {
        float total = 0.0f;
        std::array<float, light_part_count> parts{};
        float uncorrected = 0.0f;  ///< of the total without control variates
        int samples = 0;           ///< that the mean was of; 0: too few to tell
    };

    void add(const SampleLight& light);
    /// A sample that is NaN or infinite: left out.
    void add_invalid() { end_sample(); }

    int taken() const { return taken_; }
    int valid() const { return valid_; }
    /// Mean of the valid samples; 0 if there are none.
    Rgb mean() const { return valid_ == 0 ? Rgb(0.0f) : Rgb(radiance_ / static_cast<double>(valid_)); }
    Rgb mean_indirect() const { return valid_ == 0 ? Rgb(0.0f) : indirect_ / static_cast<float>(valid_); }
    /// Share of the valid samples that hit a surface.
    float coverage() const { return valid_ == 0 ? 0.0f : static_cast<float>(hits_) / static_cast<float>(valid_); }
    /// Variance of a sample's luminance, as if samples were independent; from 2 valid samples or more.
    double sample_variance() const { return valid_ < 2 ? 0.0 : luminance_.squares / (valid_ - 1); }
    /// Variance of the mean luminance, as if samples were independent.
    double variance() const { return seen_variance() + (valid_ < 2 ? 0.0 : sample_variance() / valid_); }
    /// Variance of the luminance of what all samples have from rays that were cast before them (EdgeLight). It is no
    /// part of `error`, which says whether more samples are needed.
    double seen_variance() const { return seen_variance_; }
    void set_seen_variance(float variance) { seen_variance_ = variance; }
    const Error& error() const { return error_; }
    /// Indirect irradiance for a sample that sees the surface of the pixel's first one: the mean of what the first four
    /// such samples looked up, at places spread over the pixel. Nothing before there are four.
    std::optional<Rgb> find_irradiance(const SampleLight& light) const;
    /// Keeps the mean as it is now, the first time: samples that follow are taken because of those so far.
    void keep_mean();
    bool has_kept_mean() const { return kept_mean_.has_value(); }
    /// Light that the mean has lost since it was kept; 0 where it was not.
    Rgb lost() const { return kept_mean_ ? *kept_mean_ - mean() : Rgb(0.0f); }
    /// Nothing where no sample is valid.
    void add_to_mean(const Rgb& light) { radiance_ += static_cast<double>(valid_) * glm::dvec3(light); }
    /// Object that its first valid sample saw; no_index: the background, or no sample is valid.
    int first_instance() const { return first_.instance; }
    /// Returns whether its samples saw several objects, or faces of one: an edge crosses the pixel.
    bool has_edge() const { return edge_; }

  private:
    using Parts = std::array<glm::dvec3, light_part_count>;
    /// Mean, and squared differences from it (Welford 1962).
    struct Spread {
        double mean = 0.0, squares = 0.0;
    };
    struct FoundIrradiance {
        Rgb sum{0.0f};
        int count = 0;
    };
    struct FirstHalf {
        Parts parts{};            ///< of the samples before the present half
        glm::dvec3 control{0.0};  ///< of these
        int valid = 0;
    };

    void end_sample();
    glm::dvec3 find_shown_channels(const glm::dvec3& first, const glm::dvec3& second) const;

    glm::dvec3 radiance_{0.0};
    Rgb indirect_{0.0f};
    int taken_ = 0, valid_ = 0, hits_ = 0;
    Spread luminance_;
    Parts parts_{};  ///< sums over the valid samples
    glm::dvec3 control_{0.0};
    FirstHalf first_half_;
    Error error_;
    SampledPlace first_;  ///< of the first sample
    FoundIrradiance irradiance_;
    std::optional<Rgb> kept_mean_;
    float seen_variance_ = 0.0f;
    float white_;
    bool edge_ = false;
};

}  // namespace aleph
