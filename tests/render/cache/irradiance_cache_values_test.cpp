// Caches of two or three records, with weights, radii and averages by hand.

#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr glm::vec3 origin(1.0f, 2.0f, -3.0f);

IrradianceRecord make_record_at(float x, float radius, float irradiance = 1.0f, float accuracy = 0.5f) {
    return {.position = origin + glm::vec3(x, 0.0f, 0.0f),
            .radius = radius,
            .normal = up,
            .irradiance = Rgb(irradiance),
            .tangent = make_basis(up).tangent,
            .accuracy = accuracy};
}

IrradianceCache make_empty_cache() {
    return {glm::vec3(-8.0f), glm::vec3(8.0f)};
}

CacheQuery make_query(float x, float accuracy) {
    return {origin + glm::vec3(x, 0.0f, 0.0f), up, accuracy};
}

TEST(IrradianceCacheValues, RadiiAreClampedByDistance) {
    IrradianceCache cache = make_empty_cache();
    cache.insert(make_record_at(0.0f, 1.0f));
    const glm::vec3 beside = origin + glm::vec3(0.5f, 0.0f, 0.0f);
    EXPECT_EQ(cache.radius_bound(beside, up, 9.0f), 1.5f);
    EXPECT_EQ(cache.radius_bound(beside, up, 1.25f), 1.25f);
    EXPECT_EQ(cache.radius_bound(beside, -up, 9.0f), 9.0f);
    EXPECT_EQ(cache.radius_bound(beside, {1.0f, 0.0f, 0.0f}, 9.0f), 9.0f);  // at right angles
    cache.insert(make_record_at(2.0f, 9.0f));
    EXPECT_EQ(cache.records()[1].radius, 3.0f);
    // A small one shrinks both, down to their least radii; not those that face away.
    IrradianceRecord away = make_record_at(4.0f, 5.0f);
    away.normal = -up;
    cache.insert(away);
    IrradianceRecord bounded = make_record_at(0.0f, 1.0f);
    bounded.min_radius = 0.75f;
    cache.insert(bounded);
    IrradianceRecord across = make_record_at(0.0f, 2.0f);
    across.normal = {1.0f, 0.0f, 0.0f};
    cache.insert(across);
    cache.insert(make_record_at(0.5f, 0.125f));
    EXPECT_EQ(cache.records()[0].radius, 0.625f);
    EXPECT_EQ(cache.records()[1].radius, 1.625f);
    EXPECT_EQ(cache.records()[2].radius, 5.0f);
    EXPECT_EQ(cache.records()[3].radius, 0.75f);
    EXPECT_EQ(cache.records()[4].radius, 2.0f);
    EXPECT_EQ(cache.records()[5].radius, 0.125f);
}

TEST(IrradianceCacheValues, WeightsFallWithError) {
    IrradianceCache cache = make_empty_cache();
    cache.insert(make_record_at(0.0f, 1.0f, 2.0f, 0.25f));
    cache.insert(make_record_at(0.25f, 1.0f, 8.0f, 1.0f));
    cache.restore({make_record_at(0.0f, 1.0f, 2.0f, 0.25f), make_record_at(0.25f, 1.0f, 8.0f, 1.0f)});
    RecordUse use;
    CacheQuery query = make_query(0.0625f, 0.5f);
    query.used = &use;
    // Errors of 1/16 and 3/16 against 1/2; that the second record is for a looser accuracy does not count.
    const double first = 1.0 - 0.125, second = 1.0 - 0.375;
    EXPECT_NEAR(cache.interpolate(query)->y, (2.0 * first + 8.0 * second) / (first + second), 1e-5);
    EXPECT_EQ(use.count, 2.0f);
    EXPECT_NEAR(use.weights, first + second, 1e-6);
    EXPECT_NEAR(use.reaches, 0.5 * (first + second), 1e-6);
    // One whose error is just the accuracy is not used.
    EXPECT_EQ(cache.interpolate(make_query(-0.25f, 0.5f))->y, 2.0f);
    EXPECT_FALSE(cache.interpolate(make_query(-0.5f, 0.5f)).has_value());
    EXPECT_TRUE(cache.interpolate(make_query(-0.75f, 3.0f)).has_value());  // counts as 1
    EXPECT_FALSE(cache.interpolate(make_query(-1.0f, 3.0f)).has_value());
    // The spread shortens the reach: 1/4 m, times the root of 1/4.
    IrradianceRecord spread = make_record_at(0.0f, 1.0f, 2.0f, 0.25f);
    spread.growth = 16.0f;
    cache.restore({spread});
    RecordUse shorter;
    query = make_query(0.0f, 0.25f);
    query.used = &shorter;
    EXPECT_TRUE(cache.interpolate(query).has_value());
    EXPECT_EQ(shorter.reaches, 0.125f);
    EXPECT_TRUE(cache.interpolate(make_query(0.1249f, 0.25f)).has_value());
    EXPECT_FALSE(cache.interpolate(make_query(0.1251f, 0.25f)).has_value());
}

TEST(IrradianceCacheValues, MuchLooserRecordsCoverNothing) {
    for (const auto& [accuracy, covers] : {std::pair(0.375f, true), std::pair(0.376f, false)}) {
        IrradianceCache cache = make_empty_cache();
        cache.insert(make_record_at(0.0f, 1.0f, 1.0f, accuracy));
        EXPECT_EQ(cache.covers(make_query(0.1f, 0.25f)), covers);
        EXPECT_TRUE(cache.covers(make_query(0.1f, 0.26f)));
        EXPECT_FALSE(cache.covers(make_query(0.3f, 0.26f)));
        EXPECT_FALSE(cache.covers(make_query(0.5f, 0.5f)));  // an error that is just the accuracy
    }
}

TEST(IrradianceCacheValues, ExpectedRecordsAreMeansWeightedByDistance) {
    IrradianceCache cache = make_empty_cache();
    EXPECT_FALSE(cache.expect(make_query(0.0f, 0.1f), 9.0f).has_value());
    const auto add = [&](float x, float radius, float variance, const glm::vec3& normal = up) {
        IrradianceRecord record = make_record_at(x, radius);
        record.normal = normal;
        record.noise.ray_variance = variance;
        record.irradiance = Rgb(10.0f * variance);
        cache.insert(record);
    };
    add(0.0f, 1.0f, 8.0f);
    add(0.25f, 0.75f, 2.0f);
    add(0.125f, 1.0f, 99.0f, -up);
    add(0.125f, 1.0f, 99.0f, {1.0f, 0.0f, 0.0f});
    // Within 4 alpha R: of 1/2 and of 3/8 m.
    const double first = 1.0 - 0.0625 / 0.5, second = 1.0 - 0.1875 / 0.375;
    const ExpectedRecord between = *cache.expect(make_query(0.0625f, 0.125f), 9.0f);
    EXPECT_NEAR(between.ray_variance, (8.0 * first + 2.0 * second) / (first + second), 1e-5);
    EXPECT_NEAR(between.irradiance, 10.0f * between.ray_variance, 1e-4);
    EXPECT_EQ(between.radius, 0.9375f);  // neighbour clamping by the second
    EXPECT_EQ(cache.expect(make_query(0.0625f, 0.125f), 0.5f)->radius, 0.5f);
    EXPECT_EQ(cache.expect(make_query(-0.25f, 0.125f), 9.0f)->ray_variance, 8.0f);
    const ExpectedRecord far = *cache.expect(make_query(-0.5f, 0.125f), 9.0f);  // none near: the mean of all
    EXPECT_EQ(far.ray_variance, 52.0f);
    EXPECT_NEAR(far.irradiance, 520.0f, 1e-3);
    cache.restore({make_record_at(0.0f, 1.0f)});
    EXPECT_EQ(cache.expect(make_query(5.0f, 0.1f), 9.0f)->ray_variance, 0.0f);
}

TEST(IrradianceCacheValues, RecordsAreComparedWithinTwiceTheirReach) {
    // alpha R of the larger one is 1/4 m.
    for (const auto& [x, compared] : {std::pair(0.5f, true), std::pair(0.51f, false), std::pair(-0.5f, true)}) {
        for (const bool larger_first : {false, true}) {
            IrradianceCache cache = make_empty_cache();
            const IrradianceRecord larger = make_record_at(0.0f, 1.0f, 1.0f, 0.25f);
            IrradianceRecord smaller = make_record_at(x, 0.6f, 0.5f, 0.25f);
            smaller.max_growth = 1.0f;
            cache.insert(larger_first ? larger : smaller);
            cache.insert(larger_first ? smaller : larger);
            const IrradianceRecord& a = cache.records()[larger_first ? 0 : 1];
            const IrradianceRecord& b = cache.records()[larger_first ? 1 : 0];
            const double growth = (0.5 / 0.75) / (0.5 * 0.25);
            EXPECT_NEAR(a.growth, compared ? growth : 0.0, 1e-4) << x;
            EXPECT_EQ(b.growth, compared ? 1.0f : 0.0f) << x;  // its bound
        }
    }
    // Not where the normals differ by more than both would allow: |N - N'| < 2 alpha sqrt 2.
    for (const auto& [sine, compared] : {std::pair(0.279f, true), std::pair(0.281f, false)}) {
        IrradianceCache cache = make_empty_cache();
        cache.insert(make_record_at(0.0f, 1.0f, 1.0f, 0.1f));
        IrradianceRecord turned = make_record_at(0.01f, 1.0f, 0.5f, 0.1f);
        turned.normal = {0.0f, std::sqrt(1.0f - sine * sine), sine};
        cache.insert(turned);
        EXPECT_EQ(cache.records()[0].growth > 0.0f, compared) << sine;
        EXPECT_EQ(cache.records()[1].growth > 0.0f, compared) << sine;
    }
}

TEST(IrradianceCacheValues, FinishAveragesWhatDiffersByNoise) {
    const auto make_pair = [](float value) {
        std::vector<IrradianceRecord> records = {make_record_at(0.0f, 1.0f, 1.0f, 0.25f),
                                                 make_record_at(0.125f, 1.0f, value, 0.25f)};
        for (IrradianceRecord& record : records) record.noise.error = 0.1f;
        records[1].gradients.translation.fill({0.4f, 0.0f, 0.8f});
        records[1].gradients.rotation.fill({0.0f, 0.0f, 0.3f});
        return records;
    };
    // The error of 1/8 against 2 alpha: a weight of 3/4, beside the record's own of 1.
    IrradianceCache cache = make_empty_cache();
    cache.restore(make_pair(1.2f));
    cache.finish();
    ASSERT_EQ(cache.records().size(), 2u);
    const IrradianceRecord* first = &cache.records()[cache.records()[0].position.x == origin.x ? 0 : 1];
    EXPECT_NEAR(first->irradiance.y, (1.0 + 0.75 * (1.2 - 0.05)) / 1.75, 1e-6);
    expect_near(first->gradients.translation[1], glm::dvec3(0.4, 0.0, 0.8) * (0.75 / 1.75), 1e-6);
    expect_near(first->gradients.rotation[1], glm::dvec3(0.0, 0.0, 0.3) * (0.75 / 1.75), 1e-6);
    // A difference of 2.5 standard deviations of both, as a share of the larger: .3535 of 1.5, of 1.6.
    for (const auto& [value, averaged] : {std::pair(1.59f, true), std::pair(1.64f, false)}) {
        IrradianceCache other = make_empty_cache();
        other.restore(make_pair(value));
        other.finish();
        first = &other.records()[other.records()[0].position.x == origin.x ? 0 : 1];
        EXPECT_NEAR(first->irradiance.y, averaged ? (1.0 + 0.75 * (value - 0.05)) / 1.75 : 1.0, 1e-6) << value;
    }
    // The first records may be kept.
    cache.restore(make_pair(1.2f));
    cache.finish(1);
    first = &cache.records()[cache.records()[0].position.x == origin.x ? 0 : 1];
    const IrradianceRecord* second = &cache.records()[cache.records()[0].position.x == origin.x ? 1 : 0];
    EXPECT_EQ(first->irradiance.y, 1.0f);
    EXPECT_NEAR(second->irradiance.y, (1.2 + 0.75 * 1.0) / 1.75, 1e-6);
    // Not beyond the clearance of either.
    for (const std::size_t blocked : {0, 1}) {
        std::vector<IrradianceRecord> records = make_pair(1.2f);
        records[blocked].space.sectors.fill(0.12f);
        cache.restore(records);
        cache.finish();
        for (const IrradianceRecord& record : cache.records()) {
            EXPECT_EQ(record.irradiance.y, record.position.x == origin.x ? 1.0f : 1.2f);
        }
    }
}

TEST(IrradianceCacheValues, FinishSharesRareLight) {
    IrradianceCache cache = make_empty_cache();
    // By what the records have: 1 to 3, besides one that is too far, one that faces away, and one that is kept.
    const float reach = 8.0f * 0.25f;
    const std::array<float, 6> light{5.0f, 1.0f, 3.0f, 2.0f, 7.0f, 9.0f};
    std::vector<IrradianceRecord> records;
    for (std::size_t i = 0; i < light.size(); ++i) {
        records.push_back(make_record_at(0.3f * static_cast<float>(i), 0.01f, light[i], 0.01f));
        records.back().min_radius = 0.25f;
    }
    records[2].rare = {6.0f, 12.0f, 0.0f};
    records[4].position.x = records[2].position.x + 1.01f * reach;
    records[5].normal = -up;
    cache.restore(records);
    cache.finish(1);
    const auto find = [&](float x) {
        return std::ranges::find_if(cache.records(), [x](const auto& r) { return r.position.x == x; })->irradiance;
    };
    const std::array<float, 6> share{0.0f, 1.0f / 6.0f, 3.0f / 6.0f, 2.0f / 6.0f, 0.0f, 0.0f};
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Rgb found = find(records[i].position.x);
        EXPECT_NEAR(found.x, light[i] + share[i] * 6.0f, 1e-5) << i;
        EXPECT_NEAR(found.y, light[i] + share[i] * 12.0f, 1e-5) << i;
    }
    cache.finish();
    EXPECT_NEAR(find(records[2].position.x).x, 6.0f, 1e-5) << "only once";
    // In the dark evenly.
    for (IrradianceRecord& record : records) record.irradiance = Rgb(0.0f);
    cache.restore(records);
    cache.finish();
    for (const std::size_t i : {0u, 1u, 2u, 3u}) EXPECT_NEAR(find(records[i].position.x).x, 6.0 / 4.0, 1e-5) << i;
}

/// As below a ball of glass, which gathers a lamp's light: a record is no spot of its least reach.
TEST(IrradianceCacheValues, FinishLeavesOutWhatStandsOut) {
    const auto sum_records = [](float light, float least_radius, float turned = 1.0f, bool leave_out = true) {
        std::vector<IrradianceRecord> records;
        for (const float x : {0.0f, 0.75f, -0.75f}) records.push_back(make_record_at(x, 0.5f, x == 0.0f ? light : 1));
        for (IrradianceRecord& record : records) record.min_radius = least_radius;
        records[0].normal *= turned;
        records[1].rare = Rgb(4.0f);
        IrradianceCache cache = make_empty_cache();
        cache.restore(records);
        cache.finish(0, leave_out);
        float sum = 0.0f;
        for (const IrradianceRecord& record : cache.records()) sum += record.irradiance.x;
        return sum;
    };
    EXPECT_NEAR(sum_records(9.0f, 0.5f), 6.0, 1e-5) << "the others take all rare light";
    EXPECT_NEAR(sum_records(7.0f, 0.5f), 13.0, 1e-5);
    EXPECT_NEAR(sum_records(9.0f, 0.25f), 15.0, 1e-5) << "its reach can shrink";
    EXPECT_NEAR(sum_records(9.0f, 0.5f, -1.0f), 15.0, 1e-5) << "nothing to compare it with";
    EXPECT_NEAR(sum_records(9.0f, 0.5f, 1.0f, false), 15.0, 1e-5);
}

TEST(IrradianceCacheValues, BeyondTheClearanceARayDecides) {
    // A low wall half way from the record to a place 2 m away. Rays are lifted by .02 of the distance.
    for (const auto& [height, blocked] : {std::pair(0.039, false), std::pair(0.041, true)}) {
        Scene scene;
        const int black = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true);
        const glm::dvec3 shift(30.0, 0.0, 0.0), at = shift + glm::dvec3(origin);  // rays have other coordinates
        const glm::dquat quarter = turn_about_y(pi / 2);
        add_mesh(scene, make_quad(2.0, 2.0 * height, black), at + glm::dvec3(1.0, 0.0, 0.0), quarter);
        add_mesh(scene, make_quad(2.0, 2.0, black), at + glm::dvec3(2.1, 0.0, 0.0), quarter);   // behind the query
        add_mesh(scene, make_quad(2.0, 2.0, black), at + glm::dvec3(-0.1, 0.0, 0.0), quarter);  // behind the record
        const Stage stage(std::move(scene));
        RayTask task(stage.rays);
        IrradianceCache cache = make_empty_cache();
        IrradianceRecord record = make_record_at(0.0f, 4.0f, 3.0f, 0.75f);
        record.space.sectors.fill(1.0f);
        cache.insert(record);
        CacheQuery query = make_query(2.0f, 0.75f);
        EXPECT_FALSE(cache.covers(query));  // without rays
        query.task = &task;
        query.ray_shift = glm::vec3(shift - glm::dvec3(stage.rays.anchor()));
        EXPECT_EQ(cache.covers(query), !blocked);
        EXPECT_EQ(cache.interpolate(query).has_value(), !blocked);
        EXPECT_EQ(task.counts.shadow, 2u);
        query.position.x = origin.x + 0.99f;  // within it, none is cast
        EXPECT_TRUE(cache.covers(query));
        EXPECT_EQ(task.counts.shadow, 2u);
    }
}

IrradianceRecord make_flat_record(const glm::vec3& position, float irradiance, float noise) {
    return {.position = position,
            .radius = 1.0f,
            .normal = up,
            .irradiance = Rgb(irradiance),
            .noise = {.error = noise},
            .accuracy = 0.2f};
}

TEST(RecordCorrection, AveragesLowerNoiseAndKeepEdges) {
    constexpr float noise = 0.03f, edge = 0.4f;
    std::mt19937 engine(5);
    std::normal_distribution<float> deviate(0.0f, noise);
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    for (int z = 0; z < 12; ++z) {
        for (int x = 0; x < 24; ++x) {
            const float light = x < 12 ? 1.0f : edge;
            const glm::vec3 place(0.05f * static_cast<float>(x - 12) + 0.025f, 0.0f, 0.05f * static_cast<float>(z - 6));
            cache.insert(make_flat_record(place, light * (1.0f + deviate(engine)), noise));
        }
    }
    const auto squared_error = [&] {
        double sum = 0.0;
        for (const IrradianceRecord& record : cache.records()) {
            const double light = record.position.x < 0.0f ? 1.0 : edge;
            sum += std::pow(record.irradiance.x / light - 1.0, 2.0);
        }
        return sum / static_cast<double>(cache.records().size());
    };
    const double before = squared_error();
    EXPECT_NEAR(before, noise * noise, 0.3 * noise * noise);
    cache.finish();
    EXPECT_EQ(cache.records().size(), 288u);
    EXPECT_LT(squared_error(), 0.3 * before);
}

}  // namespace
}  // namespace aleph
