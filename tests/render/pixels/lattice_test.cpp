// Evenly spread points.

#include "render/pixels/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
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

}  // namespace
}  // namespace aleph
