#include "render/pixels/pixel_sequence.h"

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

/// Terms that each binary digit of an index adds to three dimensions of Sobol's sequence (Joe and Kuo 2008).
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

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    return __builtin_bswap32(x);
}

/// Scrambling needs digits in reverse, the first one lowest. So the tables have them reversed, and their indices too.
constexpr Digits reverse_digits(const Digits& digits) {
    return {reverse_bits(digits.x), reverse_bits(digits.y)};
}

constexpr std::uint32_t reverse_index(std::uint32_t i, int bits) {
    return reverse_bits(i) >> (32 - bits);
}

constexpr Points<pixel_bits> of_pixel = make_points<pixel_bits>(
    [](std::uint32_t i) { return reverse_digits(find_point(0, reverse_index(i, pixel_bits))); });
constexpr Points<8> of_low_sample =
    make_points<8>([](std::uint32_t i) { return reverse_digits(find_point(reverse_index(i, 8), 0)); });
constexpr Points<8> of_high_sample =
    make_points<8>([](std::uint32_t i) { return reverse_digits(find_point(reverse_index(i, 8) << 8, 0)); });

/// Owen scrambling: each bit is flipped or not by a hash of those above it (Laine and Karras 2011; multipliers: Vegdahl
/// 2021, "Building a better LK hash").
/// @param x  reversed, and so is the result
std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// The lower 16 bits, at the even places.
std::uint32_t spread_bits(std::uint32_t x) {
    x &= 0xffffu;
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

/// The place of a pixel, reversed, along a Z-shaped curve whose steps have another order at each level. Flips alone
/// would leave the pixels of a block paired in the same way for all seeds, so that two uses are correlated within
/// blocks.
std::uint32_t place_pixel(std::uint32_t x, std::uint32_t y, std::uint64_t seed) {
    const std::uint64_t offset = mix_bits(seed + 0xa0761d6478bd642full);
    std::uint32_t even = spread_bits(x + static_cast<std::uint32_t>(offset));
    std::uint32_t odd = spread_bits(y + static_cast<std::uint32_t>(offset >> 16));
    // Any invertible matrix for the two digits of each level.
    odd ^= even & static_cast<std::uint32_t>(offset >> 32);
    even ^= odd & static_cast<std::uint32_t>(offset >> 31);
    odd ^= even & static_cast<std::uint32_t>(seed >> 32);
    return scramble(reverse_bits(even | odd << 1), static_cast<std::uint32_t>(seed)) >> (32 - pixel_bits);
}

std::uint64_t seed_of(std::uint64_t key, SampleUse use, std::uint32_t part) {
    const std::uint64_t number = std::uint64_t{part} << 8 | static_cast<std::uint64_t>(use);
    return mix_bits(key + (number + 1) * 0x9e3779b97f4a7c15ull);
}

/// A number in [0,1) from reversed digits.
float number_of(std::uint32_t digits, std::uint64_t seed) {
    return unit_float(reverse_bits(scramble(digits, static_cast<std::uint32_t>(seed))));
}

/// The order of samples, in the upper half, and of pixels.
std::uint64_t orders_of(std::uint64_t seed) {
    return mix_bits(seed + 0xd1342543de82ef95ull);
}

/// Digits of times: the bits of a sample's number that each adds up. Found by search (tests/render/pixels): of 2^k
/// samples, k up to 10, rectangles of time and x, and of time and y, that are twice as large as the mean have two each.
/// No third sequence makes all of the mean size even, beside x and y.
constexpr std::array<std::uint16_t, sample_bits> time_rows{0x2a87, 0x141a, 0xd51c, 0x3158, 0xf090, 0xbb60,
                                                           0xa940, 0x3980, 0xc700, 0x9200, 0xd400, 0x7800,
                                                           0x1000, 0x2000, 0xc000, 0x8000};

/// Added to the digits of each class. Any two digits in a row tell all four apart.
constexpr std::array<std::uint32_t, 4> class_digits{0u, 0x55555555u, 0xaaaaaaaau, 0xffffffffu};

}  // namespace

SequenceOfUse::SequenceOfUse(std::uint64_t key, std::uint32_t x, std::uint32_t y, SampleUse use)
    : key_(key), x_(x), y_(y), use_(use) {
    begin(0);
}

void SequenceOfUse::begin(std::uint32_t part) {
    part_ = part;
    seed_ = seed_of(key_, use_, part);
    const std::uint64_t orders = orders_of(seed_);
    order_ = static_cast<std::uint32_t>(orders >> 32);
    const Digits& digits = of_pixel[place_pixel(x_, y_, orders)];
    pixel_x_ = digits.x;
    pixel_y_ = digits.y;
}

glm::vec2 SequenceOfUse::at(int index) {
    const auto i = static_cast<std::uint32_t>(index);
    if (i >> sample_bits != part_) begin(i >> sample_bits);
    const std::uint32_t sample = scramble(reverse_bits(i), order_);
    const Digits &low = of_low_sample[sample >> 24], &high = of_high_sample[sample >> 16 & 0xff];
    return {number_of(pixel_x_ ^ low.x ^ high.x, seed_), number_of(pixel_y_ ^ low.y ^ high.y, seed_ >> 32)};
}

float time_of_sample(std::uint32_t seed, std::uint32_t noise_key, int index, int pixel_class) {
    const std::uint64_t key = PixelSequence::key_of(seed, noise_key);
    const auto i = static_cast<std::uint32_t>(index), part = i >> sample_bits;
    const auto order = static_cast<std::uint32_t>(orders_of(seed_of(key, SampleUse::pixel, part)) >> 32);
    const std::uint32_t sample = reverse_bits(scramble(reverse_bits(i), order));
    std::uint32_t digits = class_digits[pixel_class];
    for (std::size_t d = 0; d < time_rows.size(); ++d)
        digits ^= static_cast<std::uint32_t>(std::popcount(time_rows[d] & sample) & 1) << (31 - d);
    return number_of(reverse_bits(digits), seed_of(key, SampleUse::time, part));
}

}  // namespace aleph
