// The scalar functions of thesis 5.4 against MODEL.md's numbers.

#include "perception/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aleph {
namespace {

TEST(Sensitivity, KnownPeaks) {
    EXPECT_NEAR(csf_max(0.15), 245.436, 5e-4);
    EXPECT_NEAR(csf_peak_frequency(0.15), 4.835, 5e-4);
    EXPECT_NEAR(csf(4.835, 0.15), 245.4, 0.1);  // base 10 in (5.7): ln would give 1882

    double best = 0.0, at = 0.0;
    for (double v = 0.15; v < 5.0; v += 1e-4) {
        if (csf_max(v) > best) best = csf_max(v), at = v;
    }
    EXPECT_NEAR(best, 250.751, 5e-4);
    EXPECT_NEAR(at, 0.926, 2e-3);
}

TEST(Sensitivity, KnownElevationsOf16CyclesPerDegree) {
    EXPECT_NEAR(elevation(16, 1), 239, 0.5);
    EXPECT_NEAR(elevation(16, 5), 170, 0.5);
    EXPECT_NEAR(elevation(16, 20), 125, 0.5);
    EXPECT_NEAR(elevation(16, 80), 91, 0.5);
}

TEST(Sensitivity, BandFrequenciesAsPrinted) {
    const auto rho = band_frequencies(Bands::printed, 31.0);
    for (int i = 0; i < band_count; ++i) EXPECT_DOUBLE_EQ(rho[static_cast<std::size_t>(i)], std::ldexp(16.0, -i));
}

}  // namespace
}  // namespace aleph
