// Irradiance records and their index: queries at a record, small angles, corners, walls, opposite normals, large
// caches.

#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const RadiusBounds any_radius{1e-3f, 1e3f};

class Randoms {
  public:
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    glm::vec3 in_cube(float half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    glm::vec3 direction() {
        glm::vec3 v;
        do v = in_cube(1.0f);
        while (glm::dot(v, v) > 1.0f || glm::dot(v, v) < 1e-4f);
        return glm::normalize(v);
    }

    glm::vec3 mostly_up() { return glm::normalize(glm::vec3(0.0f, 1.5f, 0.0f) + in_cube(1.0f)); }

  private:
    std::mt19937 engine_{2000};
};

IrradianceRecord make_plain_record(const glm::vec3& position, const glm::vec3& normal, float radius,
                                   float irradiance = 1.0f) {
    IrradianceRecord record{.position = position, .radius = radius, .normal = normal, .irradiance = Rgb(irradiance)};
    record.accuracy = 1e-3f;  // for every query
    return record;
}

/// IrradianceCache::interpolate by a search through all records, in double.
std::optional<glm::dvec3> search_all(const IrradianceCache& cache, const CacheQuery& query) {
    const float accuracy = std::min(query.accuracy, 1.0f);
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (const IrradianceRecord& record : cache.records()) {
        const float error = interpolation_error(record, query.position, query.normal);
        if (!(error < accuracy) || is_beyond_clearance(record, query.position)) continue;
        const double weight = 1.0 - static_cast<double>(error) / accuracy;
        sum += glm::dvec3(extrapolate(record, query.position, query.normal)) * weight;
        total += weight;
    }
    if (total == 0.0) return std::nullopt;
    return sum / total;
}

TEST(IrradianceCache, IC01_ErrorAtTheRecordsOwnNormalIsZeroNeverNan) {
    Randoms random;
    for (int i = 0; i < 1'000'000; ++i) {
        const glm::vec3 n = random.direction();
        ASSERT_EQ(interpolation_error(make_plain_record(glm::vec3(0.0f), n, 1.0f), glm::vec3(0.0f), n), 0.0f);
    }
}

TEST(IrradianceCache, IC02_SmallAnglesKeepTheirSize) {
    for (const double angle : {1.0, 0.1, 1e-2, 1e-3, 1e-4}) {
        // Not along an axis, so that components are rounded.
        const glm::dvec3 n = glm::normalize(glm::dvec3(1.0, 2.0, 3.0)),
                         across = glm::normalize(glm::dvec3(3.0, 0.0, -1.0));
        const glm::dvec3 turned = n * std::cos(angle) + across * std::sin(angle);
        const IrradianceRecord record = make_plain_record(glm::vec3(0.0f), glm::vec3(n), 1.0f);
        const double expected = std::sqrt(2.0) * std::sin(0.5 * angle);  // sqrt(1 - cos)
        EXPECT_NEAR(interpolation_error(record, glm::vec3(0.0f), glm::vec3(turned)), expected, 1e-3 * expected)
            << angle;
    }
}

TEST(IrradianceCache, IC03_AtTheRecordItsOwnValueComesBack) {
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    cache.insert(make_plain_record(glm::vec3(0.0f), up, 1.0f, 7.0f));
    const std::optional<Rgb> found = cache.interpolate({glm::vec3(0.0f), up, 0.1f});
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, 7.0f, 7e-5f);
    // A record whose error is nearly alpha has next to no weight.
    cache.insert(make_plain_record({0.9f, 0.0f, 0.0f}, up, 1.0f, 7.0f));
    const IrradianceRecord& far = cache.records()[1];
    EXPECT_NEAR(interpolation_error(far, glm::vec3(0.0f), up), 0.9f, 1e-6f);
    EXPECT_EQ(cache.interpolate({glm::vec3(0.0f), up, 1.0f})->x, 7.0f);
}

TEST(IrradianceCache, IC04_RadiiStayWithinTheirBounds) {
    IrradianceSample corner{.irradiance = Rgb(1.0f)};
    corner.nearest_distance = 0.0f;
    EXPECT_EQ(make_record(glm::vec3(0.0f), up, 1.0f, corner, {0.01f, 5.0f})->radius, 0.01f);
    corner.nearest_distance = float_infinity;
    EXPECT_EQ(make_record(glm::vec3(0.0f), up, 1.0f, corner, {0.01f, 5.0f})->radius, 5.0f);
    corner.nearest_distance = 1.0f;
    EXPECT_EQ(make_record(glm::vec3(0.0f), up, 1.0f, corner, {0.01f, 5.0f})->radius, 3.5f);  // times the distance
    // Neighbour clamping stops at the smallest radius too.
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    corner.nearest_distance = 0.0f;
    cache.insert(make_record(glm::vec3(0.0f), up, 1.0f, corner, {1e-6f, 5.0f}).value());
    cache.insert(make_record(glm::vec3(0.0f), up, 1.0f, corner, {0.02f, 5.0f}).value());
    EXPECT_EQ(cache.records()[1].radius, 0.02f);
}

TEST(IrradianceCache, IC05_SelfHitsDoNotShrinkTheRadius) {
    const auto nearest_distance = [](bool speck) {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.5));
        add_mesh(scene, make_faceted_sphere(2.0, 96, white));
        if (speck) {
            // 1e-5 m above the point, less than 1e-4 of the radius, and small: like a self-hit by rounding.
            add_mesh(scene, make_quad(1e-6, 1e-6, white), {0.0, 1.2e-5, 0.0}, z_to_down);
        }
        return Gathering(std::move(scene))
            .gather(make_point(glm::vec3(0.0f), up, 1e-5f), {choose_strata(2048), {1, 2, 3, 4}})
            .nearest_distance;
    };
    const float clean = nearest_distance(false);
    EXPECT_NEAR(nearest_distance(true), clean, 0.01f * clean);
}

TEST(IrradianceCache, IC07_GradientsNextToAWallStayBounded) {
    for (const double distance : {1e-2, 1e-4, 1e-6, 1e-8, 0.0}) {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.8));
        add_mesh(scene, make_quad(2.0, 2.0, white), {0.0, 0.0, -distance});
        add_mesh(scene, make_quad(2.0, 2.0, white), {0.0, 1.0, 0.0}, z_to_down);
        add_light(scene, Light::Kind::point, glm::dvec3(5.0), {0.1, 0.3, 0.5});
        const IrradianceSample sample = Gathering(std::move(scene)).at(glm::vec3(0.0f), up, 1024);
        ASSERT_GT(sample.irradiance.x, 0.0f) << distance;
        const IrradianceRecord record = make_record(glm::vec3(0.0f), up, 1.0f, sample, any_radius).value();
        for (std::size_t c = 0; c < 3; ++c) {
            const float e = record.irradiance[static_cast<int>(c)] * 1.0001f;
            ASSERT_LE(glm::length(record.gradients.translation[c]) * record.radius, e) << distance;
            ASSERT_LE(glm::length(record.gradients.rotation[c]), e) << distance;
        }
        Randoms random;
        for (int i = 0; i < 1000; ++i) {
            const Rgb value = extrapolate(record, random.in_cube(record.radius), random.direction());
            ASSERT_GE(value.x, 0.0f);
            ASSERT_LE(value.x, 2.0f * record.irradiance.x);
        }
    }
    // An float_infinity gradient, as from a distance of 0, counts as 0.
    IrradianceSample broken{.irradiance = Rgb(1.0f)};
    broken.nearest_distance = 1.0f;
    broken.gradients.translation.fill(glm::vec3(float_infinity, 0.0f, 0.0f));
    broken.gradients.rotation.fill(glm::vec3(float_nan, 0.0f, 0.0f));
    const IrradianceRecord record = make_record(glm::vec3(0.0f), up, 1.0f, broken, any_radius).value();
    EXPECT_EQ(extrapolate(record, glm::vec3(0.1f), {1.0f, 0.0f, 0.0f}), Rgb(1.0f));
    // Luminance hardly shows how steep the blue of yellow light is.
    IrradianceSample yellow{.irradiance = Rgb(1.0f, 1.0f, 0.01f)};
    yellow.nearest_distance = 1.0f;
    yellow.gradients.translation[2] = glm::vec3(1.0f, 0.0f, 0.0f);
    const IrradianceRecord steep = make_record(glm::vec3(0.0f), up, 1.0f, yellow, any_radius).value();
    EXPECT_NEAR(glm::length(steep.gradients.translation[2]) * steep.radius, 0.01f, 1e-6f);
    EXPECT_EQ(extrapolate(steep, glm::vec3(-3.0f * steep.radius, 0.0f, 0.0f), up).z, 0.0f);
    EXPECT_EQ(extrapolate(steep, glm::vec3(3.0f * steep.radius, 0.0f, 0.0f), up).z, 0.02f);
}

TEST(IrradianceCache, IrradianceThatIsNotFiniteMakesNoRecord) {
    IrradianceSample sample;
    sample.nearest_distance = 1.0f;
    for (const float bad : {float_nan, float_infinity, -float_infinity}) {
        for (int c = 0; c < 3; ++c) {
            sample.irradiance = Rgb(1.0f);
            sample.irradiance[c] = bad;
            EXPECT_FALSE(make_record(glm::vec3(0.0f), up, 1.0f, sample, any_radius).has_value()) << bad << ' ' << c;
        }
    }
    sample.irradiance = Rgb(1.0f);
    EXPECT_TRUE(make_record(glm::vec3(0.0f), up, 1.0f, sample, any_radius).has_value());
}

TEST(IrradianceCache, IC08_RecordsInFrontOfThePointAreRefused) {
    const IrradianceRecord above = make_plain_record({0.0f, 0.1f, 0.0f}, up, 1.0f);
    EXPECT_EQ(interpolation_error(above, glm::vec3(0.0f), up),
              float_infinity);  // the record is on a step above the point
    EXPECT_NEAR(interpolation_error(above, {0.0f, 0.19f, 0.0f}, up), 0.09f, 1e-6f);
    EXPECT_EQ(interpolation_error(above, {0.0f, 0.21f, 0.0f}, up), float_infinity);  // the point is on a step
    EXPECT_NEAR(interpolation_error(above, {0.0f, 0.06f, 0.0f}, up), 0.04f, 1e-6f);  // within .05 R_i
}

TEST(IrradianceCache, IC09_OppositeNormalsNeverMatch) {
    const glm::vec3 front(0.0f, 0.0f, 1.0f);
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    cache.insert(make_plain_record(glm::vec3(0.0f), front, 100.0f, 3.0f));
    for (const float accuracy : {0.1f, 1.0f, 1.42f, 100.0f, float_infinity}) {
        EXPECT_FALSE(cache.covers({glm::vec3(0.0f), -front, accuracy}));
        EXPECT_FALSE(cache.covers({glm::vec3(0.0f), {1.0f, 0.0f, 0.0f}, accuracy}));  // at right angles
        EXPECT_FALSE(cache.interpolate({glm::vec3(0.0f), -front, accuracy}).has_value());
        EXPECT_TRUE(cache.covers({glm::vec3(0.0f), front, accuracy}));
    }
    // An accuracy above 1 counts as 1: a record more than its radius away is not used.
    EXPECT_FALSE(cache.covers({{100.5f, 0.0f, 0.0f}, front, 1.42f}));
}

TEST(IrradianceCache, IC11_TheIndexFindsWhatALinearSearchFinds) {
    Randoms random;
    // The bounds are too small: some records lie outside.
    IrradianceCache cache(glm::vec3(-0.9f), glm::vec3(0.9f));
    for (int i = 0; i < 10'000; ++i) {
        const float radius = std::exp(random.uniform(std::log(0.01f), std::log(1.0f)));
        IrradianceRecord record =
            make_plain_record(random.in_cube(1.0f), random.mostly_up(), radius, random.uniform(0.0f, 5.0f));
        record.min_radius = 0.6f * radius;  // without it, the smallest of 10,000 radii would shrink all others
        for (std::size_t c = 0; c < 3; ++c) {
            record.gradients.translation[c] = random.in_cube(1.0f);
            record.gradients.rotation[c] = random.in_cube(1.0f);
        }
        cache.insert(record);
    }
    int covered = 0;
    for (int i = 0; i < 10'000; ++i) {
        // Queries have their own accuracy, which may be above that for which the records were made, and above 1.
        const float accuracy = i % 10 == 0 ? 1.2f : random.uniform(0.05f, 1.0f);
        const CacheQuery query{random.in_cube(1.1f), random.mostly_up(), accuracy};
        const std::optional<glm::dvec3> expected = search_all(cache, query);
        const std::optional<Rgb> found = cache.interpolate(query);
        ASSERT_EQ(cache.covers(query), expected.has_value());
        ASSERT_EQ(found.has_value(), expected.has_value());
        if (!expected) continue;
        ++covered;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR((*found)[c], (*expected)[c], 1e-5 * (1.0 + std::abs((*expected)[c])));
    }
    EXPECT_GT(covered, 1000);
    EXPECT_LT(covered, 9900);
}

TEST(IrradianceCache, IC11_NeighbouringRadiiDifferByNoMoreThanTheirDistance) {
    Randoms random;
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    for (int i = 0; i < 500; ++i) {
        cache.insert(make_plain_record(random.in_cube(1.0f), up, std::exp(random.uniform(-5.0f, 1.0f))));
    }
    for (const IrradianceRecord& a : cache.records()) {
        for (const IrradianceRecord& b : cache.records()) {
            ASSERT_LE(a.radius, (b.radius + glm::length(a.position - b.position)) * 1.0001f);
        }
    }
}

TEST(IrradianceCache, IC15_EmptyAndOneRecord) {
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    EXPECT_FALSE(cache.covers({glm::vec3(0.0f), up, 1.0f}));
    EXPECT_FALSE(cache.interpolate({glm::vec3(0.0f), up, 1.0f}).has_value());
    cache.insert(make_plain_record(glm::vec3(0.5f), up, 0.5f, 2.0f));
    EXPECT_TRUE(cache.covers({glm::vec3(0.5f), up, 0.01f}));
    EXPECT_FALSE(cache.covers({glm::vec3(-0.5f), up, 1.0f}));
    EXPECT_FALSE(cache.covers({glm::vec3(0.5f), up, 0.0f}));  // accuracy 0 accepts nothing
}

}  // namespace
}  // namespace aleph
