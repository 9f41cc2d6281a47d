#include "render/pixel_sequence.h"

#include <array>
#include <bit>

namespace aleph {

namespace {

constexpr int pixel_bits = 12;  // of the place of a pixel along the curve
constexpr int sample_bits = 16;
static_assert(PixelSequence::length == 1 << sample_bits);

/// Digits after the binary point, the first one highest.
struct Digits {
    std::uint32_t x = 0, y = 0;
    constexpr Digits& operator^=(const Digits& other) {
        x ^= other.x;
        y ^= other.y;
        return *this;
    }
};

/// What each binary digit of an index adds to three dimensions of Sobol's sequence (Joe and Kuo 2008).
struct SobolColumns {
    std::array<std::uint32_t, pixel_bits + sample_bits> x{}, y{}, z{};
};

constexpr SobolColumns make_columns() {
    SobolColumns columns;
    auto& [x, y, z] = columns;
    for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] = 0x80000000u >> i;
        y[i] = i == 0 ? x[0] : y[i - 1] ^ (y[i - 1] >> 1);
        z[i] = i == 0 ? x[0] : i == 1 ? 3u << 30 : z[i - 1] ^ z[i - 2] ^ (z[i - 2] >> 2);
    }
    return columns;
}

/// The point of a sample and a pixel. The sample is the high part of the index in Sobol's sequence; the low part is
/// the one for which the third dimension begins with the pixel's digits.
constexpr Digits find_point(std::uint32_t sample, std::uint32_t pixel) {
    constexpr SobolColumns columns = make_columns();
    std::uint32_t index = sample << pixel_bits;
    std::uint32_t z = pixel << (32 - pixel_bits);  // what is still to be reached
    Digits point;
    const auto add = [&](int i) {
        z ^= columns.z[i];
        point ^= {columns.x[i], columns.y[i]};
    };
    for (int i = pixel_bits; i < pixel_bits + sample_bits; ++i) {
        if (index >> i & 1) add(i);
    }
    for (int i = pixel_bits - 1; i >= 0; --i) {
        if (z >> (31 - i) & 1) add(i);
    }
    return point;
}

/// find_point of all numbers of so many bits. It is linear: that of a number is the sum of those of its bits.
template <int bits>
using Points = std::array<Digits, 1 << bits>;

template <int bits, class Find>
constexpr Points<bits> make_points(const Find& find) {
    Points<bits> points{};
    for (std::uint32_t i = 1; i < points.size(); ++i) {
        points[i] = points[i & (i - 1)];
        points[i] ^= std::has_single_bit(i) ? find(i) : points[i & (~i + 1)];
    }
    return points;
}

constexpr Points<pixel_bits> of_pixel = make_points<pixel_bits>([](std::uint32_t i) { return find_point(0, i); });
constexpr Points<8> of_low_sample = make_points<8>([](std::uint32_t i) { return find_point(i, 0); });
constexpr Points<8> of_high_sample = make_points<8>([](std::uint32_t i) { return find_point(i << 8, 0); });

std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    return __builtin_bswap32(x);
}

/// Owen scrambling: each bit is flipped or not by a hash of those above it (Laine and Karras 2011; multipliers: Vegdahl
/// 2021, "Building a better LK hash").
std::uint32_t scramble(std::uint32_t number, std::uint32_t seed) {
    std::uint32_t x = reverse_bits(number);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

/// The lower 16 bits, at the even places.
std::uint32_t spread_bits(std::uint32_t x) {
    x &= 0xffffu;
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

/// The place of a pixel along a Z-shaped curve whose steps have another order at each level. Flips alone would leave
/// the pixels of a block paired in the same way for all seeds, so that two uses are correlated within blocks.
std::uint32_t place_pixel(std::uint32_t x, std::uint32_t y, std::uint64_t seed) {
    const std::uint64_t offset = mix_bits(seed + 0xa0761d6478bd642full);
    std::uint32_t even = spread_bits(x + static_cast<std::uint32_t>(offset));
    std::uint32_t odd = spread_bits(y + static_cast<std::uint32_t>(offset >> 16));
    // Any invertible matrix for the two digits of each level.
    odd ^= even & static_cast<std::uint32_t>(offset >> 32);
    even ^= odd & static_cast<std::uint32_t>(offset >> 31);
    odd ^= even & static_cast<std::uint32_t>(seed >> 32);
    return scramble(even | odd << 1, static_cast<std::uint32_t>(seed)) & ((1u << pixel_bits) - 1);
}

/// The point of a sample before its digits are scrambled.
Digits find_digits(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint64_t seed) {
    const std::uint64_t orders = mix_bits(seed + 0xd1342543de82ef95ull);
    const std::uint32_t sample = scramble(index, static_cast<std::uint32_t>(orders >> 32));
    Digits digits = of_pixel[place_pixel(x, y, orders)];
    digits ^= of_low_sample[sample & 0xff];
    digits ^= of_high_sample[sample >> 8 & 0xff];
    return digits;
}

std::uint64_t seed_of(std::uint64_t key, SampleUse use, std::uint32_t index) {
    const std::uint64_t part = std::uint64_t{index >> sample_bits} << 8 | static_cast<std::uint64_t>(use);
    return mix_bits(key + (part + 1) * 0x9e3779b97f4a7c15ull);
}

}  // namespace

float PixelSequence::at_1d(SampleUse use, int index) const {
    const auto i = static_cast<std::uint32_t>(index);
    const std::uint64_t seed = seed_of(key_, use, i);
    return unit_float(scramble(find_digits(x_, y_, i, seed).x, static_cast<std::uint32_t>(seed)));
}

glm::vec2 PixelSequence::at_2d(SampleUse use, int index) const {
    const auto i = static_cast<std::uint32_t>(index);
    const std::uint64_t seed = seed_of(key_, use, i);
    const Digits digits = find_digits(x_, y_, i, seed);
    return {unit_float(scramble(digits.x, static_cast<std::uint32_t>(seed))),
            unit_float(scramble(digits.y, static_cast<std::uint32_t>(seed >> 32)))};
}

}  // namespace aleph
