#pragma once
// Points of the unit square and numbers for the samples of one pixel. Any first 2^k are evenly spread, so that a pixel
// may take samples until it has enough; and so are those of neighbouring pixels together, so that what error is left
// is fine grain.

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "engine/base/sampling.h"

namespace aleph {

/// Point i of n of a rank-1 lattice (golden ratio), shifted by `shift` modulo 1: even in both coordinates for any n.
/// In [0,1)^2.
inline glm::vec2 lattice_point(int i, int n, const glm::vec2& shift) {
    constexpr float golden = 0.61803398875f;
    return {std::min(glm::fract((static_cast<float>(i) + 0.5f) / static_cast<float>(n) + shift.x), below_one),
            std::min(glm::fract(static_cast<float>(i) * golden + shift.y), below_one)};
}

/// Use of a sample's numbers. Each use has points of its own, which do not depend on those of any other.
enum class SampleUse : std::uint8_t {
    pixel,           ///< the place within the pixel's filter
    lens,            ///< the place on the lens
    time,            ///< while the shutter is open
    light_choice,    ///< which light, of those that are hidden
    light_point,     ///< the place on it
    lobe_choice,     ///< which lobe of the surface
    lobe_direction,  ///< the direction that it scatters to
    lobe_side,       ///< reflected, or through the surface
    indirect,        ///< indirect light
    bright_choice,   ///< which bright surface
    bright_point,    ///< the place on it
    other,           ///< free for callers
    passing,         ///< which of the blended surfaces in its way the camera's ray shows
    lamp_disc,       ///< the place in the picture of a lamp that is out of focus
    lamp_point,      ///< the place on that lamp
};

/// The points of one use. What its samples have in common is computed once.
class SequenceOfUse {
  public:
    SequenceOfUse(std::uint64_t key, std::uint32_t x, std::uint32_t y, SampleUse use);

    /// PixelSequence::at_2d; fastest for indices in ascending order.
    glm::vec2 at(int index);

  private:
    void begin(std::uint32_t part);

    std::uint64_t key_;
    std::uint32_t x_, y_;
    SampleUse use_;
    std::uint32_t part_ = 0;                   ///< of PixelSequence::length samples
    std::uint64_t seed_ = 0;                   ///< of that part
    std::uint32_t order_ = 0;                  ///< of its samples
    std::uint32_t pixel_x_ = 0, pixel_y_ = 0;  ///< the pixel's digits
};

/// One digital net over samples and pixels. The first 2^k samples of a pixel, or 2^k from a multiple of 2^k, have
/// one point in each of 2^k equal rectangles, of any shape of powers of two. Those of a block of 2^j x 2^j pixels
/// together have one in each of 2^k 4^j such rectangles: the errors of neighbours cancel, as the eye averages
/// them. Blocks of up to 64 x 64 pixels, from multiples of their size (up to a shift by seed and use).
///
/// Samples, x and y of the points, and pixels along a Z-shaped curve are the four dimensions of a net: the index of a
/// Sobol sequence and its first three dimensions. The third, of polynomial x^2 + x + 1, has no defect where its digits
/// are taken in pairs, as squares of pixels do (Niederreiter 1992, "Random Number Generation and Quasi-Monte Carlo
/// Methods", section 4.5). Numbers are scrambled as by Owen (Burley 2020, "Practical Hash-based Owen Scrambling",
/// JCGT 9(4)), and so is the order of samples and of pixels. After Ahmed and Wonka 2020, "Screen-space blue-noise
/// diffusion of Monte Carlo sampling error via hierarchical ordering of pixels", which has one number of samples.
///
/// The mean over seeds is exact for any number of samples. A pure function of its arguments.
class PixelSequence {
  public:
    static constexpr int length = 1 << 16;  ///< samples; more of them begin another, independent sequence

    /// @param seed    sequences of different seeds are independent
    /// @param noise_key  so are those of different keys. It stays the same while the camera is at rest, and so does the
    ///                noise of what is at rest
    PixelSequence(std::uint32_t seed, std::uint32_t noise_key, int x, int y)
        : key_(key_of(seed, noise_key)), x_(static_cast<std::uint32_t>(x)), y_(static_cast<std::uint32_t>(y)) {}

    SequenceOfUse of(SampleUse use) const { return {key_, x_, y_, use}; }
    /// Number of one sample, in [0,1).
    /// @param index  of the sample, from 0
    float at_1d(SampleUse use, int index) const { return at_2d(use, index).x; }
    /// Point of one sample, in [0,1)^2; its x is at_1d.
    glm::vec2 at_2d(SampleUse use, int index) const { return of(use).at(index); }

    static std::uint64_t key_of(std::uint32_t seed, std::uint32_t noise_key) {
        return mix_bits((std::uint64_t{seed} << 32 | noise_key) + 0x9e3779b97f4a7c15ull);
    }

  private:
    std::uint64_t key_;
    std::uint32_t x_, y_;
};

/// Number in [0,1) that sample `index` of all pixels of a class has in common: its time. With SampleUse::pixel's points
/// of any pixel, the numbers of the first 2^k samples, or of 2^k from a multiple of 2^k, make a net: what moves across
/// a pixel is sampled evenly by time and place. So do those of the four classes together by themselves.
/// @param seed, noise_key  of PixelSequence
float time_of_sample(std::uint32_t seed, std::uint32_t noise_key, int index, int pixel_class);

}  // namespace aleph
