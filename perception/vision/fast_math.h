#pragma once
// 2^x and log2(x) in float, as short polynomials without branches, so that loops over them vectorise. On bounded
// domains: relative error of 2^x below 5e-7, absolute error of log2(x) below 2e-7 + 1e-7 |log2(x)|.

#include <bit>
#include <cstdint>

namespace aleph {

inline constexpr float log10_2 = 0.30102999566398120f;

/// 2^x for x in [-126, 126]; outside, the value at the nearer end.
inline float fast_exp2(float x) {
    x = x > -126.0f ? x : -126.0f;
    x = x < 126.0f ? x : 126.0f;
    const float shifted = x + 0x1.8p23f;  // rounds to the nearest integer, in the low bits
    const float whole = shifted - 0x1.8p23f;
    const float f = x - whole;  // [-.5, .5]
    // Taylor series of 2^f: the first term left out is below 1.2e-7 there.
    float p = 1.5403530393381609e-4f;
    p = p * f + 1.3333558146428443e-3f;
    p = p * f + 9.6181291076284772e-3f;
    p = p * f + 5.5504108664821580e-2f;
    p = p * f + 2.4022650695910071e-1f;
    p = p * f + 6.9314718055994531e-1f;
    p = p * f + 1.0f;
    const std::uint32_t exponent = (std::bit_cast<std::uint32_t>(shifted) + 127u) << 23;
    return p * std::bit_cast<float>(exponent);
}

/// log2(x) for normal positive x.
inline float fast_log2(float x) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
    // The mantissa in [sqrt(1/2), sqrt(2)), so that log2 of numbers near 1 keeps its precision.
    const std::uint32_t moved = bits - 0x3f3504f3u;
    const auto exponent = static_cast<float>(static_cast<std::int32_t>(moved) >> 23);
    const float m = std::bit_cast<float>((moved & 0x007fffffu) + 0x3f3504f3u);
    // log2(m) = 2/ln2 atanh(t), t = (m-1)/(m+1), |t| <= .1716; the first term left out is below 2e-9.
    const float t = (m - 1.0f) / (m + 1.0f);
    const float u = t * t;
    float p = 0.32059889797532520f;
    p = p * u + 0.41219858311113240f;
    p = p * u + 0.57707801635558536f;
    p = p * u + 0.96179669392597560f;
    p = p * u + 2.8853900817779268f;
    return exponent + p * t;
}

}  // namespace aleph
