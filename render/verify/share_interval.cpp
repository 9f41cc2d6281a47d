#include "render/verify/share_interval.h"

#include <algorithm>
#include <cmath>

namespace aleph {

double student_95(std::size_t freedom) {
    constexpr double few[] = {12.7062, 4.3027, 3.1824, 2.7764};
    if (freedom <= std::size(few)) return few[std::max<std::size_t>(freedom, 1) - 1];
    constexpr double z = 1.959964, z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z;
    const auto n = static_cast<double>(freedom);  // Cornish and Fisher's expansion
    return z + (z3 + z) / (4.0 * n) + (5.0 * z5 + 16.0 * z3 + 3.0 * z) / (96.0 * n * n) +
           (3.0 * z7 + 19.0 * z5 + 17.0 * z3 - 15.0 * z) / (384.0 * n * n * n);
}

VerifiedShare estimate_share(std::span<const BlockCount> blocks) {
    double pixels = 0.0, counted = 0.0, largest = 0.0;
    for (const BlockCount& block : blocks) {
        pixels += block.pixels;
        counted += block.counted;
        if (block.pixels > 0.0) largest = std::max(largest, block.counted / block.pixels);
    }
    if (!(pixels > 0.0)) return {};
    const auto n = static_cast<double>(blocks.size());
    const double share = counted / pixels;
    double squares = 0.0;
    for (const BlockCount& block : blocks) squares += std::pow(block.counted - share * block.pixels, 2.0);
    const double deviation = n > 1.0 ? std::sqrt(squares / (n - 1.0) / n) / (pixels / n) : 1.0;
    const double half = student_95(blocks.size() - 1) * deviation;
    const double kinds = std::min(1.0, 3.0 / n);
    const double missed = kinds * (counted > 0.0 ? largest : 1.0), spared = share * (1.0 - kinds);
    return {share, std::max(0.0, std::min(share - half, spared)), std::min(1.0, std::max(share + half, missed))};
}

}  // namespace aleph
