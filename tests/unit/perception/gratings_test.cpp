// The three models of vision on drifting gratings, whose maps are known.

#include <gtest/gtest.h>

#include <cmath>

#include "perception/castle.h"
#include "perception/sensitivity.h"
#include "scenes/studies/grating.h"

namespace aleph {
namespace {

constexpr FrameRate thirty{30, 1};
constexpr ViewingConditions viewing;

double worst_difference(Vision vision, Bands bands) {
    double worst = 0.0;
    for (const Guide guide : {Guide::spatial, Guide::full}) {
        for (const double rho : {0.3, 1.0, 4.0, 15.0}) {
            for (const double velocity : {0.0, 5.0, 40.0, 150.0}) {
                for (const double luminance : {1.0, 50.0}) {
                    PerceptionSettings settings;
                    settings.guide = guide;
                    settings.vision = vision;
                    settings.bands = bands;
                    const GratingCheck check =
                        check_grating({rho, velocity, luminance, 0.5}, settings, viewing, thirty);
                    EXPECT_GT(check.compared, 200u) << rho;
                    worst = std::max(worst, check.aleph);
                }
            }
        }
    }
    return worst;
}

TEST(Gratings, TheMapsOfAllModelsAreTheKnownOnes) {
    for (const Bands bands : {Bands::printed, Bands::measured}) {
        EXPECT_LT(worst_difference(Vision::thesis, bands), 1e-4);
        EXPECT_LT(worst_difference(Vision::laird, bands), 1e-4);
        EXPECT_LT(worst_difference(Vision::castle, bands), 2e-3) << "CastleRow interpolates within 2e-3";
    }
}

TEST(Gratings, BandsFollowTheKernelsTransferFunction) {
    // Low frequencies, which no level aliases.
    for (const double rho : {0.01, 0.03}) {
        std::vector<double> row(4096);
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] = std::cos(0.3 + 2.0 * M_PI * rho * static_cast<double>(x) / 31.0);
        const RowBands bands = find_row_bands(row);
        const BandValues known = transfer_responses(rho, viewing);
        for (std::size_t x = 1500; x < 2500; ++x) {
            if (bands.sums[x] < 0.2) continue;
            for (std::size_t i = 0; i < known.size(); ++i) EXPECT_NEAR(bands.responses[x][i], known[i], 0.005) << i;
        }
    }
}

TEST(Gratings, AScaledPictureHasTheSameMap) {
    PerceptionSettings settings;
    settings.guide = Guide::full;
    const GratingCheck half = check_grating({2.0, 5.0, 20.0, 0.2}, settings, viewing, thirty);
    const GratingCheck full = check_grating({2.0, 5.0, 80.0, 0.8}, settings, viewing, thirty);
    EXPECT_NEAR(half.median, full.median, 1e-4 * full.median);
}

TEST(Gratings, ModelsAgreeWithTheirAuthorsAtTheirPeaks) {
    // Yee 2000, section 5.4: 4.84 cycles per degree at the eye's drift.
    EXPECT_NEAR(csf_peak_frequency(0.15), 4.84, 0.005);
    const Grating slow{1.0, 0.0, 100.0, 0.5};
    EXPECT_EQ(known_elevation(Vision::thesis, Guide::spatial, 4.0, slow, 100.0, viewing, thirty), 1.0);
    EXPECT_GT(known_elevation(Vision::thesis, Guide::spatial, 8.0, slow, 100.0, viewing, thirty), 1.0);
    // perception/README.md, castleCSF at rest.
    const auto castle = [&](double rho) {
        return known_elevation(Vision::castle, Guide::spatial, rho, slow, 100.0, viewing, thirty);
    };
    EXPECT_NEAR(castle(0.25), 10.7, 0.05);
    EXPECT_NEAR(castle(2.0), 1.3, 0.05);
}

}  // namespace
}  // namespace aleph
