// The surface model: reciprocity, densities, weights, energy.

#include "render/surface/bsdf.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const std::vector<float> widths{1e-3f, 0.02f, 0.1f, 0.3f, 0.7f, 1.0f};
const std::vector<float> cosines{1.0f, 0.9f, 0.5f, 0.2f, 0.05f};

TEST(Bsdf, MC15_Reciprocity) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> unit(1e-3f, 1.0f), angle(0.0f, 6.28f);
    const auto expect_equal = [](float there, float back) {
        ASSERT_NEAR(there, back, 1e-5f * std::max(there, back));
        ASSERT_GE(there, 0.0f);
    };
    for (const float alpha : widths) {
        for (const float stretch : {0.0f, 0.5f}) {
            SurfaceMaterial material = make_white_plastic(alpha);
            material.gloss.stretch = stretch;
            int lit = 0;
            for (int i = 0; i < 4000; ++i) {
                const glm::vec3 a = direction_of(unit(engine), angle(engine));
                // Every other pair is near a mirror's, where narrow lobes are bright.
                glm::vec3 b = direction_of(unit(engine), angle(engine));
                if (i % 2 == 0) b = glm::normalize(glm::vec3(-a.x, -a.y, a.z) + 0.5f * alpha * b);
                const float there = evaluate_glossy(material, a, b).x;
                expect_equal(there, evaluate_glossy(material, b, a).x);
                expect_equal(evaluate_diffuse(material, a.z, b.z).x, evaluate_diffuse(material, b.z, a.z).x);
                lit += there > 0.0f;
            }
            EXPECT_GT(lit, 1000) << alpha;
        }
    }
}

TEST(Bsdf, NothingBelowTheSurface) {
    const SurfaceMaterial material = make_white_plastic(0.3f);
    const glm::vec3 above = direction_of(0.5f), below(above.x, above.y, -above.z);
    for (const auto& [view, light] : {std::pair(above, below), std::pair(below, above), std::pair(below, below)}) {
        EXPECT_EQ(evaluate_glossy(material, view, light), Rgb(0.0f));
        EXPECT_EQ(pdf_glossy(material, view, light), 0.0f);
    }
}

/// Expected visible-normal density against the share of samples that stay above the surface, and their mean direction.
TEST(Bsdf, DensityIntegratesToWhatSamplesDo) {
    for (const float alpha : widths) {
        const SurfaceMaterial material = make_metal(alpha);
        for (const float cosine : cosines) {
            if (cosine < 0.1f) continue;  // the grid of half vectors is too coarse there; the chi-square test covers it
            const glm::vec3 view = direction_of(cosine);
            EXPECT_TRUE(holds([&](Trial& trial) {
                RandomStream random({2 + trial.seed, 0, 0, 0});
                Mean above, x, z;
                for (int i = 0; i < trial.times(100'000); ++i) {
                    const glm::vec3 light = sample_glossy(material, view, random.next_2d());
                    ASSERT_NEAR(glm::dot(light, light), 1.0f, 1e-4f);
                    const bool up = light.z > 0.0f;
                    above.add(up ? 1.0 : 0.0);
                    x.add(up ? glm::dot(light, view) : 0.0);
                    z.add(up ? light.z : 0.0);
                }
                const auto pdf = [&](const glm::vec3& l) { return static_cast<double>(pdf_glossy(material, view, l)); };
                trial.near(above, integrate_around_lobe(alpha, view, pdf), 3e-3);
                trial.near(
                    x, integrate_around_lobe(alpha, view, [&](const auto& l) { return pdf(l) * glm::dot(l, view); }),
                    3e-3);
                trial.near(z, integrate_around_lobe(alpha, view, [&](const auto& l) { return pdf(l) * l.z; }), 3e-3);
            })) << alpha
                << ' ' << cosine;
        }
    }
}

TEST(Bsdf, SamplesFollowTheDensityChiSquare) {
    constexpr int rows = 8, columns = 16, fine = 24;
    for (const float alpha : {0.3f, 0.7f, 1.0f}) {
        const SurfaceMaterial material = make_metal(alpha);
        for (const float cosine : {0.95f, 0.5f, 0.15f, 0.05f}) {
            const glm::vec3 view = direction_of(cosine);
            EXPECT_TRUE(holds([&](Trial& trial) {
                const int n = trial.times(200'000);
                RandomStream random({3 + trial.seed, 0, 0, 0});
                std::vector<double> seen(rows * columns + 1, 0.0), expected(rows * columns + 1, 0.0);
                for (int i = 0; i < n; ++i) {
                    const glm::vec3 l = sample_glossy(material, view, random.next_2d());
                    if (l.z <= 0.0f) {
                        seen.back() += 1.0;
                        continue;
                    }
                    const double azimuth = std::atan2(l.y, l.x) + pi;
                    const int row = std::min(rows - 1, static_cast<int>(l.z * rows));
                    const int column = std::min(columns - 1, static_cast<int>(azimuth / (2.0 * pi) * columns));
                    seen[row * columns + column] += 1.0;
                }
                double total = 0.0;
                for (int i = 0; i < rows * fine; ++i) {
                    for (int k = 0; k < columns * fine; ++k) {
                        const double z = (i + 0.5) / (rows * fine),
                                     azimuth = 2.0 * pi * (k + 0.5) / (columns * fine) - pi;
                        const double p = pdf_glossy(material, view,
                                                    direction_of(static_cast<float>(z), static_cast<float>(azimuth))) *
                                         2.0 * pi / (rows * fine * columns * fine);
                        expected[i / fine * columns + k / fine] += n * p;
                        total += p;
                    }
                }
                expected.back() = n * (1.0 - total);
                double chi2 = 0.0;
                int bins = 0;
                for (std::size_t b = 0; b < seen.size(); ++b) {
                    if (expected[b] < 20.0) continue;
                    chi2 += (seen[b] - expected[b]) * (seen[b] - expected[b]) / expected[b];
                    ++bins;
                }
                EXPECT_GT(bins, 40);
                trial.at_most(chi2, std::sqrt(2.0 * bins), bins);
            })) << alpha
                << ' ' << cosine;
        }
    }
}

TEST(Bsdf, MC08_SampleWeightsDoNotExceedOne) {
    RandomStream random({4, 0, 0, 0});
    for (const float alpha : widths) {
        const SurfaceMaterial material = make_metal(alpha);
        for (const float cosine : {1.0f, 0.9f, 0.5f, 0.2f, 0.05f, 1e-2f, 1e-4f, 1e-6f}) {
            const glm::vec3 view = direction_of(cosine);
            int reflected = 0;
            for (int i = 0; i < 20'000; ++i) {
                const glm::vec3 light = sample_glossy(material, view, random.next_2d());
                if (light.z <= 0.0f) continue;
                const float pdf = pdf_glossy(material, view, light);
                if (pdf == 0.0f) continue;
                ++reflected;
                ASSERT_LE(evaluate_glossy(material, view, light).x * light.z / pdf, 1.0f + 1e-5f)
                    << alpha << ' ' << cosine;
            }
            EXPECT_GT(reflected, 5000) << alpha << ' ' << cosine;
        }
    }
}

TEST(Bsdf, FresnelStaysBetweenZeroAndOne) {
    for (const float f0 : {0.0f, 0.04f, 1.0f}) {
        SurfaceMaterial material = make_white_plastic(0.5f);
        material.gloss.f0_max = f0;
        for (int i = 0; i <= 100; ++i) {
            const float transmission = diffuse_transmission(material, static_cast<float>(i) / 100.0f);
            ASSERT_GE(transmission, 0.0f);
            ASSERT_LE(transmission, 1.0f - f0 + 1e-6f);
        }
        EXPECT_NEAR(diffuse_transmission(material, 1.0f), 1.0f - f0, 1e-6f);
        EXPECT_NEAR(diffuse_transmission(material, 0.0f), 0.0f, 1e-6f);
        // The mean in closed form against its integral, 2 cos d cos.
        double mean = 0.0;
        for (int i = 0; i < 10'000; ++i) {
            const float c = (static_cast<float>(i) + 0.5f) / 10'000.0f;
            mean += 2.0 * c * diffuse_transmission(material, c) / 10'000.0;
        }
        EXPECT_NEAR(mean_diffuse_transmission(material), mean, 1e-5);
    }
}

TEST(Bsdf, EnergyIsNotCreated) {
    for (const float alpha : widths) {
        for (const float cosine : cosines) {
            const glm::vec3 view = direction_of(cosine);
            const auto albedo = [&](const SurfaceMaterial& m) {
                return integrate_around_lobe(
                    alpha, view,
                    [&](const auto& l) { return static_cast<double>(evaluate_glossy(m, view, l).x) * l.z; }, 256);
            };
            EXPECT_LE(albedo(make_metal(alpha)), 1.002) << alpha << ' ' << cosine;
            const SurfaceMaterial plastic = make_white_plastic(alpha);
            // Under uniform light of radiance 1, irradiance is pi. The Lambert layer's share has a closed form.
            const double diffuse = diffuse_radiance(plastic, cosine, Rgb(static_cast<float>(pi))).x;
            EXPECT_LE(albedo(plastic) + diffuse, 1.002) << alpha << ' ' << cosine;
        }
    }
    EXPECT_GT(integrate_around_lobe(
                  0.1f, direction_of(0.9f),
                  [&](const auto& l) {
                      return static_cast<double>(evaluate_glossy(make_metal(0.1f), direction_of(0.9f), l).x) * l.z;
                  }),
              0.98);
}

}  // namespace
}  // namespace aleph
