// The vision model on moving gratings, whose bands have a closed form, and known answers of the models themselves.

#include "perception/perception.h"
#include "perception/vision/band_frequencies.h"
#include "perception/vision/retinal_velocity.h"
#include "tests/perception/grating.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

constexpr double density = 31.0;  // pixels per degree
constexpr double velocities[] = {0.15, 1, 5, 20, 80};

struct Light {
    double mean, contrast;
};
constexpr Light lights[] = {{0.5, 0.8}, {0.02, 0.5}};

/// A range of frequencies, cycles per degree, and what the map may differ by without castle, relative.
struct Frequencies {
    double highest, lowest, tolerance;
};
// The picture is in float. Its rounding, 6e-8 of the mean, falls into the finest band, whose f is up to 250. A grating
// of low frequency has next to nothing of its own there, and aleph is near 1: the error is 250 * 6e-8 over contrast
// times the sum of the bands, at least .1: 3e-4 for a contrast of .5.
constexpr Frequencies frequencies[] = {{16.0, 1.0, 1e-4}, {0.5, 0.25, 3e-4}};

/// Largest differences over the compared pixels. Those near a zero of every band are left out: there (5.3) is 0 / 0.
struct GratingErrors {
    double response = 0.0;           ///< of R_i (5.3), from the closed form
    double adaptation = 0.0;         ///< relative, of the luminance that castle adapts to
    double aleph = 0.0;              ///< relative, of the map, from closed form and vision_formulas.h
    double highest = 0.0;            ///< known answer
    int compared = 0, left_out = 0;  ///< pixels
};

constexpr double least_band_sum = 0.1;  // bands below this share of the grating's amplitude, summed, are a zero

/// Compares pixels of the middle row of a moving grating's maps with their known answers.
void compare_grating(const Grating& grating, double velocity, const PerceptionSettings& settings,
                     GratingErrors& errors) {
    const ViewingConditions viewing;
    const Image<Rgb> picture = make_grating(grating);
    const Image<float> velocities(picture.width, picture.height, static_cast<float>(velocity));
    const PerceptionMaps maps = compute_perception(picture, velocities, viewing, {}, settings, {.bands = true});
    const double moving = settings.guide == Guide::spatial ? 0.0 : static_cast<float>(velocity);
    EyeMotion motion{.retinal = written_retinal_velocity(moving, tracking_efficiency),
                     .tracked = written_tracked_velocity(moving, tracking_efficiency)};
    const auto rho = band_frequencies(settings.bands, density);
    const auto raise = [](double& largest, double difference) { largest = std::max(largest, std::abs(difference)); };
    for (int x = 0; x < picture.width; x += 17) {
        const auto bands = exact_bands(grating.angular(), x);
        double sum = 0.0;
        for (const double band : bands) sum += band;
        if (sum < least_band_sum) {
            ++errors.left_out;
            continue;
        }
        ++errors.compared;
        if (settings.vision->uses_luminance()) {
            motion.luminance = viewing.display_white * exact_adaptation(grating, x, density);
            raise(errors.adaptation, maps.adaptation(x, Grating::middle) / motion.luminance - 1.0);
        }
        double written = 0.0;
        for (std::size_t i = 0; i < bands.size(); ++i) {
            const double response = bands[i] / sum;
            written += response * written_elevation(settings.vision, rho[i], motion);
            raise(errors.response, maps.responses[i](x, Grating::middle) - response);
        }
        raise(errors.aleph, maps.aleph(x, Grating::middle) / written - 1.0);
        raise(errors.highest, written);
    }
}

/// Every frequency of a range, and every velocity.
GratingErrors run_gratings(const Light& light, const Frequencies& range, const PerceptionSettings& settings) {
    GratingErrors errors;
    for (double rho = range.highest; rho >= range.lowest; rho *= 0.5) {
        for (const double velocity : velocities)
            compare_grating({nearest_half_cycles(rho, density), light.mean, light.contrast}, velocity, settings,
                            errors);
    }
    return errors;
}

/// Calls check(errors, range) for every light, range of frequencies, guide and set of bands.
template <class Check>
void for_each_map(const VisionModel* vision, const Check& check) {
    for (const Light& light : lights) {
        for (const Frequencies& range : frequencies) {
            for (const Guide guide : {Guide::spatial, Guide::full}) {
                for (const Bands bands : {Bands::printed, Bands::measured}) {
                    const GratingErrors errors =
                        run_gratings(light, range, {.guide = guide, .vision = vision, .bands = bands});
                    EXPECT_LT(errors.response, 2e-5);
                    EXPECT_GT(errors.compared, 5 * errors.left_out);
                    if (guide == Guide::full) {
                        EXPECT_GT(errors.highest, 3.0);  // the answers are not all 1
                    }
                    check(errors, range);
                }
            }
        }
    }
}

TEST(Gratings, MapsOfThesisAndLairdAreTheKnownAnswer) {
    for (const VisionModel* const vision : {&thesis_vision(), &laird_vision()}) {
        for_each_map(vision, [](const GratingErrors& errors, const Frequencies& range) {
            EXPECT_LT(errors.aleph, range.tolerance);
        });
    }
}

// Rows of castle interpolate a table over luminance: castle_vision.h promises 2e-3, gratings find 2.7e-4.
TEST(Gratings, MapsOfCastleAreTheKnownAnswer) {
    for_each_map(&castle_vision(), [](const GratingErrors& errors, const Frequencies&) {
        EXPECT_LT(errors.aleph, 5e-4);
        EXPECT_LT(errors.adaptation, 1e-6);
    });
}

TEST(Gratings, SensitivityOfCastleIsTheWrittenFormula) {
    for (double rho = 16.0; rho >= 0.25; rho *= 0.5) {
        for (double v = 0.1; v < 200.0; v *= 1.3) {
            for (const double luminance : {0.05, 1.0, 100.0, 2000.0}) {
                const EyeMotion motion{written_retinal_velocity(v, 0.82), written_tracked_velocity(v, 0.82), luminance};
                const double castle = castle_elevation(rho, motion.retinal, motion.tracked, luminance, 1.0, {});
                EXPECT_NEAR(castle / written_elevation(&castle_vision(), rho, motion), 1.0, 1e-9) << rho << " " << v;
            }
        }
    }
}

TEST(Gratings, LairdPeaksWhereItsConstantsSay) {
    // 45.9 / (.7986 * .3 + 2) / (2 pi .8404) cycles per degree. What is too fine to be seen has f = CSF_max.
    constexpr double at = 3.88133, too_fine = 1e4;
    const double peak = row_elevation(laird_vision(), {.frequency = too_fine, .retinal = 0.15});
    EXPECT_NEAR(peak / written_laird_sensitivity(at, 0.3), 1.0, 2e-5);
    EXPECT_EQ(row_elevation(laird_vision(), {.frequency = 0.999 * at, .retinal = 0.3}), 1.0);
    EXPECT_GT(written_laird_sensitivity(at, 0.3), written_laird_sensitivity(1.001 * at, 0.3));
    EXPECT_GT(written_laird_sensitivity(at, 0.3), written_laird_sensitivity(0.999 * at, 0.3));
}

}  // namespace
}  // namespace aleph
