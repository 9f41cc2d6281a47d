// Irradiance gathered over the hemisphere against closed forms (discs, rectangles, plates, spheres), and its gradients
// against differences of closed forms.

#include "render/cache/gather.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/penumbra.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A ceiling lit from below by directional light, so that all of it reflects the same known radiance without noise.
/// There is no floor: irradiance is gathered at points where it would be.
/// @param ceiling  of the first material, whose albedo is that given
Scene make_lit_ceiling(const Mesh& ceiling, const glm::dvec3& position, double albedo, double lux) {
    Scene scene;
    add_lambert(scene, glm::dvec3(albedo));
    add_mesh(scene, ceiling, position);
    add_light(scene, Light::Kind::directional, glm::dvec3(lux), glm::dvec3(0.0), z_to_down);
    return scene;
}

/// It reflects a radiosity of 3.
Scene make_lit_disc(float radius, unsigned segments, const glm::dvec3& position) {
    return make_lit_ceiling(make_disc_facing_down(radius, segments, 0), position, 0.6, 5.0);
}

/// The mean over independent gathers is the truth, and within this share of it.
void expect_irradiance(Gathering& gathering, const glm::vec3& position, const glm::vec3& normal, double expected,
                       double share = 0.01) {
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean mean;
        for (std::uint32_t run = 0; run < trial.times(256u); ++run) {
            mean.add(gathering.at(position, normal, 512, run + trial.seed).irradiance.x);
        }
        trial.near(mean, expected, 1e-4 * expected);
        EXPECT_NEAR(mean.mean(), expected, share * expected);
    }));
}

TEST(Gather, MC04_StrataUseTheSamplesAskedFor) {
    for (int n = 1; n <= 10'007; ++n) {
        const HemisphereStrata strata = choose_strata(n);
        ASSERT_LE(strata.count(), n);
        ASSERT_LE(3 * (n - strata.count()), strata.columns) << n;  // a third of a row of cells at most is left out
        ASSERT_LE(100 * (n - strata.count()), 8 * n) << n;         // what the setting's description says
        if (n < 64) continue;
        const double ratio = static_cast<double>(strata.columns) / strata.rows;
        ASSERT_GT(ratio, pi / 3.0) << n;
        ASSERT_LT(ratio, pi * 3.0) << n;
    }
    for (const int n : {1, 2, 3, 4, 5, 7, 16, 64, 256, 512, 1000, 1024, 2048, 4096, 8192})
        EXPECT_EQ(choose_strata(n).count(), n);
    EXPECT_EQ(choose_strata(1024).columns, 64);
}

TEST(Gather, DiscOverheadIsSineSquared) {
    for (const float height : {0.3f, 1.0f, 3.0f}) {
        Gathering gathering(make_lit_disc(1.0f, 720, {0.0, height, 0.0}));
        const double sine2 = 1.0 / (1.0 + height * height);
        expect_irradiance(gathering, glm::vec3(0.0f), up, 0.6 * 5.0 * sine2);
    }
}

/// Schlick's (1 - c)^5, integrated over a ceiling that is seen up to an angle of 1 - cosine = m: m^6 / 6 - m^7 / 7.
TEST(Gather, RaysCountByWhatEntersTheLambertLayer) {
    SurfaceMaterial plastic;
    plastic.gloss.f0_max = 0.04f;
    plastic.gloss.f90_max = 1.0f;
    for (const float height : {0.3f, 1.0f, 3.0f}) {
        Gathering gathering(make_lit_disc(1.0f, 720, {0.0, height, 0.0}));
        const double sine2 = 1.0 / (1.0 + height * height), m = 1.0 - std::sqrt(1.0 - sine2);
        const double entering = 0.5 * sine2 - (std::pow(m, 6.0) / 6.0 - std::pow(m, 7.0) / 7.0);
        const double expected = 3.0 * 2.0 * entering / (1.0 - 1.0 / 21.0);
        const SurfacePoint point = make_point(glm::vec3(0.0f), up);
        const IrradianceSample sample =
            gathering.gather(point, {choose_strata(16384), {5, 0, 0, 0}}, {.material = &plastic});
        EXPECT_NEAR(sample.irradiance.x, expected, 4e-3 * expected) << height;
        EXPECT_GT(std::abs(expected - 3.0 * sine2), 0.01 * expected) << height;
    }
}

TEST(Gather, EndlessCeilingGivesItsRadiosity) {
    Gathering gathering(make_lit_disc(5000.0f, 64, {0.0, 1.0, 0.0}));
    const IrradianceSample sample = gathering.at(glm::vec3(0.0f), up, 1024);
    EXPECT_NEAR(sample.irradiance.x, 3.0, 1e-3);
    // Irradiance is the same everywhere. It changes with rotation only in second order, because below the horizon it is
    // dark.
    EXPECT_LT(glm::length(sample.gradients.translation[0]), 0.02 * 3.0);
    EXPECT_LT(glm::length(sample.gradients.rotation[0]), 0.02 * 3.0);
}

TEST(Gather, BackOfTheCeilingIsLitByWhatMeetsIt) {
    // The light comes from below. Above the ceiling, facing down, only its unlit back is visible.
    Gathering gathering(make_lit_disc(5.0f, 64, {0.0, 1.0, 0.0}));
    EXPECT_EQ(gathering.at({0.0f, 2.0f, 0.0f}, -up, 256).irradiance, Rgb(0.0f));
    EXPECT_EQ(gathering.at({0.0f, 2.0f, 0.0f}, up, 256).irradiance, Rgb(0.0f));
}

Mesh make_quad_facing_down(double width, double depth, int material) {
    Mesh mesh = make_quad(width, depth, material);
    for (glm::vec3& p : mesh.positions) p = {p.x, 0.0f, p.y};  // faces down
    mesh.normals.clear();
    return mesh;
}

TEST(Gather, ParallelRectangle) {
    Gathering gathering(make_lit_ceiling(make_quad_facing_down(2.0, 1.0, 0), {0.0, 0.8, 0.0}, 0.5, 2.0));
    expect_irradiance(gathering, glm::vec3(0.0f), up, 4.0 * corner_factor(1.0, 0.5, 0.8));
    expect_irradiance(gathering, {1.0f, 0.0f, 0.5f}, up, corner_factor(2.0, 1.0, 0.8));  // under a corner
    expect_irradiance(gathering, {1.0f, 0.0f, 0.0f}, up, 2.0 * corner_factor(2.0, 0.5, 0.8));
}

TEST(Gather, ShadowsOfTheLightAreSeen) {
    // A blind below the point keeps the light off half of the ceiling. The blind's lit underside is not visible from
    // the point, which is above it.
    const Mesh ceiling = make_quad_facing_down(2.0, 1.0, 0);
    Scene scene = make_lit_ceiling(ceiling, {0.0, 0.8, 0.0}, 0.5, 2.0);
    add_mesh(scene, flip_winding(ceiling), {1.0, -0.5, 0.0});
    Gathering gathering(std::move(scene));
    expect_irradiance(gathering, glm::vec3(0.0f), up, 2.0 * corner_factor(1.0, 0.5, 0.8));
}

TEST(Gather, ManyLightsAddUp) {
    // More lights than are compared at a hit. The choice among them must not lose energy.
    Scene scene = make_lit_ceiling(make_quad_facing_down(2.0, 1.0, 0), {0.0, 0.8, 0.0}, 0.5, 0.1);
    for (int i = 1; i < 40; ++i)
        add_light(scene, Light::Kind::directional, glm::dvec3(i % 3 == 0 ? 0.0 : 0.1), glm::dvec3(0.0), z_to_down);
    Gathering gathering(std::move(scene));
    expect_irradiance(gathering, glm::vec3(0.0f), up, 27 * 0.05 * 4.0 * corner_factor(1.0, 0.5, 0.8), 0.02);
}

TEST(Gather, NearestDistanceInASphereIsItsRadius) {
    for (const double radius : {0.01, 2.0, 1000.0}) {
        Scene scene;
        add_mesh(scene, make_faceted_sphere(radius, 128, add_lambert(scene, glm::dvec3(0.5))));
        Gathering gathering(std::move(scene));
        EXPECT_NEAR(gathering.at(glm::vec3(0.0f), up, 256).nearest_distance, radius, 0.01 * radius);
    }
}

TEST(Gather, InTheOpenTheDistanceIsInfinite) {
    Gathering gathering(make_lit_disc(1.0f, 16, {0.0, 1.0, 0.0}));
    const IrradianceSample sample = gathering.at({0.0f, 2.0f, 0.0f}, up, 64);
    EXPECT_EQ(sample.nearest_distance, float_infinity);
    EXPECT_EQ(sample.irradiance, Rgb(0.0f));
    EXPECT_EQ(sample.gradients.translation[0], glm::vec3(0.0f));
    EXPECT_EQ(gathering.task.counts.gather, 64u);
    EXPECT_EQ(gathering.task.counts.shadow, 0u);
}

TEST(Gather, DependsOnTheKeyAlone) {
    Scene scene;
    add_mesh(scene, make_faceted_sphere(2.0, 32, add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true)));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.5, 1.0, 0.2});
    Gathering one(scene), other(scene);
    other.at({0.1f, 0.1f, 0.1f}, up, 1024, 9);  // leaves its values in the buffers
    const IrradianceSample a = one.at(glm::vec3(0.0f), up, 256, 5), b = other.at(glm::vec3(0.0f), up, 256, 5);
    EXPECT_EQ(a.irradiance, b.irradiance);
    EXPECT_EQ(a.gradients.translation, b.gradients.translation);
    EXPECT_NE(one.at(glm::vec3(0.0f), up, 256, 6).irradiance, b.irradiance);
}

/// A dark ceiling at height 1 with a small bright patch off the axis, as the derivation of the gradients assumes.
/// Irradiance of a small patch: radiance area cos cos' / d^2.
struct Patch {
    static constexpr double x = 0.7, size = 0.2, height = 1.0, radiosity = 6.0;

    static Scene make_scene() {
        Scene scene;
        const int black = add_lambert(scene, glm::dvec3(0.0)), white = add_lambert(scene, glm::dvec3(1.0));
        add_mesh(scene, make_disc_facing_down(100.0f, 64, black), {0.0, height + 1e-4, 0.0});
        add_mesh(scene, make_quad_facing_down(size, size, white), {x, height, 0.0});
        add_light(scene, Light::Kind::directional, glm::dvec3(radiosity), glm::dvec3(0.0), z_to_down);
        return scene;
    }

    /// Irradiance at a place on the floor for a unit normal, integrated over the patch.
    static double irradiance(const glm::dvec3& place, const glm::dvec3& normal) {
        constexpr int n = 40;
        double sum = 0.0;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const glm::dvec3 q(x + size * ((i + 0.5) / n - 0.5), height, size * ((j + 0.5) / n - 0.5));
                const glm::dvec3 d = q - place;
                const double r2 = glm::dot(d, d);
                sum += std::max(0.0, glm::dot(d, normal)) * d.y / (r2 * r2);
            }
        }
        return sum * radiosity / pi * (size * size / (n * n));
    }
};

/// Compares the mean of a component over gathers with the central difference of the closed form.
void expect_gradient(const std::function<double(const IrradianceSample&)>& predicted,
                     const std::function<double(double)>& truth, double share) {
    Gathering gathering(Patch::make_scene());
    const double step = 1e-4, expected = (truth(step) - truth(-step)) / (2.0 * step);
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean mean;
        for (std::uint32_t run = 0; run < trial.times(24u); ++run) {
            mean.add(predicted(gathering.at(glm::vec3(0.0f), up, 16384, run + trial.seed)));
        }
        trial.near(mean, expected, share * std::abs(expected));
        EXPECT_LT(mean.error(), 0.05 * std::abs(expected));
    }));
}

TEST(Gather, TranslationGradientAgainstDifferences) {
    expect_gradient([](const IrradianceSample& s) { return s.gradients.translation[0].x; },
                    [](double d) {
                        return Patch::irradiance({d, 0.0, 0.0}, {0.0, 1.0, 0.0});
                    },
                    0.1);
    // Across, the patch is symmetric: the gradient is 0.
    Gathering gathering(Patch::make_scene());
    const IrradianceSample sample = gathering.at(glm::vec3(0.0f), up, 16384);
    EXPECT_LT(std::abs(sample.gradients.translation[0].z), 0.2f * std::abs(sample.gradients.translation[0].x));
    EXPECT_GT(sample.gradients.translation[0].x, 0.0f);  // brighter towards the patch
}

TEST(Gather, RotationGradientAgainstDifferences) {
    // Records use it as dE = dot(cross(N_i, N), gradient).
    const auto turned = [](double angle) { return glm::dvec3(std::sin(angle), std::cos(angle), 0.0); };
    expect_gradient(
        [&](const IrradianceSample& s) {
            const glm::vec3 axis = glm::cross(up, glm::vec3(1.0f, 0.0f, 0.0f));
            return static_cast<double>(glm::dot(axis, s.gradients.rotation[0]));
        },
        [&](double angle) { return Patch::irradiance(glm::dvec3(0.0), turned(angle)); }, 0.02);
}

}  // namespace
}  // namespace aleph
