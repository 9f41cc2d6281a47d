#pragma once
// Random numbers that depend on seed, frame, pixel and sample, not on threads; sampling functions and their pdfs.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace aleph {

/// Mixes 64 bits (splitmix64's finaliser, Steele et al. 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

/// The largest number below 1.
inline constexpr float below_one = 0x1.fffffep-1f;

/// Uniform in [0, 1) with 24 bits: never 1, so that indices made from it stay in range.
constexpr float unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// Streams of random numbers with different keys are independent.
struct RandomKey {
    std::uint32_t seed = 0, frame = 0, pixel = 0, sample = 0;
};

/// Random numbers for dimensions 0, 1, 2, ... of one key.
class RandomStream {
  public:
    explicit RandomStream(const RandomKey& key)
        : state_(mix_bits(mix_bits((std::uint64_t{key.seed} << 32 | key.frame) + 0x9e3779b97f4a7c15ull) ^
                          (std::uint64_t{key.pixel} << 32 | key.sample))) {}

    /// The number of one dimension; does not move the stream.
    float at(std::uint32_t dimension) const { return unit_float(static_cast<std::uint32_t>(bits(dimension) >> 32)); }
    /// The next dimension's number.
    float next() { return at(dimension_++); }
    glm::vec2 next_2d() {
        const std::uint64_t b = bits(dimension_++);
        return {unit_float(static_cast<std::uint32_t>(b >> 32)), unit_float(static_cast<std::uint32_t>(b))};
    }

  private:
    std::uint64_t bits(std::uint32_t dimension) const {
        return mix_bits(state_ + (std::uint64_t{dimension} + 1) * 0x9e3779b97f4a7c15ull);
    }
    std::uint64_t state_;
    std::uint32_t dimension_ = 0;
};

/// Two unit vectors that make a right-handed orthonormal basis with n.
struct Basis {
    glm::vec3 tangent, bitangent, normal;
    glm::vec3 to_world(const glm::vec3& v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
    glm::vec3 to_local(const glm::vec3& v) const {
        return {glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal)};
    }
};

/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1). n must be unit.
inline Basis make_basis(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

/// Direction about +z with density cos/pi; u in [0,1)^2. z is computed from u: from x and y it
/// would lose its digits near the horizon.
inline glm::vec3 sample_cosine_hemisphere(const glm::vec2& u) {
    const float r = std::sqrt(u.x);
    const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u.x))};
}
inline float pdf_cosine_hemisphere(float cos_theta) {
    return std::max(0.0f, cos_theta) / std::numbers::pi_v<float>;
}

/// Barycentric (b1, b2) of a uniform point of a triangle.
inline glm::vec2 sample_triangle(const glm::vec2& u) {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

/// Weight of strategy a against b, exponent 2 (Veach 1997); 0 where pdf_a is 0. Infinite pdfs give no NaN.
inline float power_heuristic(float pdf_a, float pdf_b) {
    if (!(pdf_a > 0.0f)) return 0.0f;
    const float ratio = pdf_b / pdf_a;
    if (!(ratio >= 0.0f)) return std::isinf(pdf_a) ? 0.5f : 1.0f;  // inf/inf, or a NaN
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace aleph
