// Evenly spread points, and the order in which halves of them are even too.

#include "render/lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace aleph {
namespace {

TEST(Lattice, PointsAreEven) {
    for (const int n : {1, 2, 5, 16, 64}) {
        // Each of the n strata of x holds one point; y, a golden-ratio sequence, leaves no large gap.
        std::vector<int> strata(static_cast<std::size_t>(n), 0);
        std::vector<float> ys;
        for (int i = 0; i < n; ++i) {
            const glm::vec2 p = lattice_point(i, n, {0.0f, 0.3f});
            ASSERT_GE(std::min(p.x, p.y), 0.0f);
            ASSERT_LT(std::max(p.x, p.y), 1.0f);
            ++strata[static_cast<int>(p.x * static_cast<float>(n))];
            ys.push_back(p.y);
        }
        for (const int count : strata) EXPECT_EQ(count, 1);
        std::sort(ys.begin(), ys.end());
        for (std::size_t i = 1; i < ys.size(); ++i) EXPECT_LT(ys[i] - ys[i - 1], 3.0f / static_cast<float>(n));
    }
    EXPECT_LT(lattice_point(0, 1, {0.49999997f, 0.99999997f}).x, 1.0f);
}

TEST(Lattice, PartsOfALatticeAreEvenFromTheFirstOnes) {
    for (int n = 1; n <= 130; ++n) {
        std::vector<int> times(static_cast<std::size_t>(n), 0);
        for (int i = 0; i < n; ++i) {
            const int place = even_order(i, n);
            ASSERT_TRUE(place >= 0 && place < n) << n;
            ++times[place];
        }
        EXPECT_EQ(std::ranges::count(times, 1), n) << n;
        // Of the first 2^k points, a quarter is in each quarter: of powers of two exactly one in each stratum.
        for (int count = 8; count <= n; count *= 2) {
            std::array<int, 4> quarters{};
            std::vector<int> strata(static_cast<std::size_t>(count), 0);
            for (int i = 0; i < count; ++i) {
                ++quarters[4 * even_order(i, n) / n];
                ++strata[count * even_order(i, n) / n];
            }
            for (const int found : quarters) EXPECT_EQ(found, count / 4) << n << ' ' << count;
            if ((n & (n - 1)) == 0) {
                EXPECT_EQ(std::ranges::count(strata, 1), count) << n;
            }
        }
    }
}

}  // namespace
}  // namespace aleph
