// The float rows of the last pass against the double formulas, and compute_perception as a whole.

#include "perception/aleph_map.h"
#include "perception/perception.h"
#include "perception/vision/fast_math.h"
#include "perception/vision/kelly_vision.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

TEST(FastMath, ExpAndLogAreGoodToAMillionth) {
    for (double x = -125.9; x < 125.9; x += 0.0137) {
        ASSERT_NEAR(fast_exp2(static_cast<float>(x)) / std::exp2(static_cast<float>(x)), 1.0, 5e-7) << x;
    }
    for (double x = -120; x < 120; x += 0.0137) {
        const float v = std::exp2(static_cast<float>(x));
        ASSERT_NEAR(fast_log2(v), std::log2(static_cast<double>(v)), 2e-7 + 1e-7 * std::abs(x)) << x;
    }
    EXPECT_EQ(fast_exp2(0.0f), 1.0f);
    EXPECT_EQ(fast_log2(1.0f), 0.0f);
    EXPECT_EQ(fast_exp2(1e9f), 0x1p126f);
    EXPECT_EQ(fast_exp2(-1e9f), 0x1p-126f);
}

TEST(KellyRow, AgreesWithTheWrittenFormulas) {
    std::vector<float> velocity;
    for (double v = 0.15; v < 1e8; v *= 1.003) velocity.push_back(static_cast<float>(v));
    velocity.front() = 0.15f;
    std::vector<float> f(velocity.size());
    const std::pair<KellyModel, const VisionModel*> models[] = {{daly_1998, &thesis_vision()},
                                                                {laird_2006, &laird_vision()}};
    for (const auto& [constants, model] : models)
        for (const Bands bands : {Bands::printed, Bands::measured}) {
            for (const double ppd : {15.0, 31.0, 60.0, 300.0}) {
                const auto rho = band_frequencies(bands, ppd);
                KellyRow row(rho, static_cast<int>(velocity.size()), constants);
                row.load({.retinal = velocity.data()});
                for (int band = 0; band < band_count; ++band) {
                    row.elevations(band, f.data());
                    for (std::size_t i = 0; i < f.size(); ++i) {
                        const double exact = written_elevation(model, rho[band], {.retinal = velocity[i]});
                        ASSERT_NEAR(f[i] / exact, 1.0, 2e-5) << "band " << band << ", " << velocity[i] << " deg/s";
                    }
                }
            }
        }
}

TEST(RetinalVelocityRow, AgreesWithTheDoubleFormula) {
    std::vector<float> velocity, saliency;
    for (double v = 0.001; v < 1e5; v *= 1.1) {
        for (double s = 0.0; s <= 1.0; s += 0.01) {
            velocity.push_back(static_cast<float>(v));
            saliency.push_back(static_cast<float>(s));
        }
    }
    std::vector<float> out(velocity.size());
    retinal_velocity_row(velocity.data(), saliency.data(), static_cast<int>(out.size()), out.data());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double exact = written_retinal_velocity(velocity[i], saliency[i]);
        ASSERT_NEAR(out[i], exact, 1e-6 * (exact + 1)) << velocity[i] << " " << saliency[i];
        ASSERT_GE(out[i], 0.15f);
    }
}

TEST(Perception, SaliencyIsMoreLenientThanFullTrackingAndThatThanNoMotion) {
    const SyntheticFrame frame = make_synthetic_frame(320, 240);
    const auto aleph_with = [&](Guide guide) {
        return mean_of(compute_perception(frame.estimate, frame.velocity, {}, {}, {.guide = guide}).aleph);
    };
    EXPECT_GT(aleph_with(Guide::saliency), 1.1 * aleph_with(Guide::full));
    EXPECT_GT(aleph_with(Guide::full), 1.1 * aleph_with(Guide::spatial));
    EXPECT_GT(aleph_with(Guide::spatial), 1.1);
    EXPECT_EQ(aleph_with(Guide::none), 1.0);
}

TEST(Perception, OutputsAreThoseAskedFor) {
    const SyntheticFrame frame = make_synthetic_frame(64, 48);
    const PerceptionMaps bare = compute_perception(frame.estimate, frame.velocity, {}, {}, {});
    EXPECT_TRUE(bare.retinal_velocity.empty());
    EXPECT_TRUE(bare.conspicuity_motion.empty());
    EXPECT_TRUE(same_size(bare.saliency, frame.velocity));
    for (const SaliencyGrid grid : {SaliencyGrid::full, SaliencyGrid::center}) {
        const PerceptionMaps all =
            compute_perception(frame.estimate, frame.velocity, {}, {}, {.grid = grid}, {true, true});
        for (const Image<float>* map : {&all.retinal_velocity, &all.conspicuity_intensity, &all.conspicuity_color,
                                        &all.conspicuity_orientation, &all.conspicuity_motion}) {
            ASSERT_TRUE(same_size(*map, frame.velocity));
            EXPECT_GT(mean_of(*map), 0.0);
        }
        for (std::size_t i = 0; i < all.aleph.size(); ++i) {
            const double v = written_retinal_velocity(frame.velocity.pixels[i], all.saliency.pixels[i]);
            ASSERT_NEAR(all.retinal_velocity.pixels[i], v, 1e-5 * v);
        }
    }
    const PerceptionMaps none =
        compute_perception(frame.estimate, frame.velocity, {}, {}, {.guide = Guide::none}, {true, true});
    EXPECT_EQ(none.aleph, Image<float>(64, 48, 1.0f));
    EXPECT_EQ(none.retinal_velocity, Image<float>(64, 48, 0.15f));
}

TEST(Perception, RefusesWhatDoesNotFit) {
    const Image<Rgb> estimate(8, 8);
    const Image<float> velocity(8, 8);
    EXPECT_THROW(compute_perception(estimate, Image<float>(8, 7), {}, {}, {}), InputError);
    EXPECT_THROW(compute_perception({}, {}, {}, {}, {}), InputError);
    for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
        EXPECT_THROW(compute_perception(estimate, velocity, {.pixels_per_degree = bad}, {}, {}), InputError) << bad;
        EXPECT_THROW(compute_perception(estimate, velocity, {.display_white = bad}, {}, {}), InputError) << bad;
    }
    for (const FrameRate bad : {FrameRate{0, 1}, FrameRate{-1, 1}, FrameRate{1, 0}, FrameRate{0, 0}}) {
        EXPECT_THROW(compute_perception(estimate, velocity, {}, bad, {}), InputError) << bad.per_second();
    }
}

}  // namespace
}  // namespace aleph
