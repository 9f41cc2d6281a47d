// Lists of records for look-ups at one accuracy: they find what a search of all records finds.

#include "render/cache/record_lists.h"

#include <map>

#include "engine/base/sampling.h"
#include "render/cache/irradiance_cache.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Records on a floor and two walls of a room of 4 m, whose radii and growths differ widely.
std::vector<IrradianceRecord> make_room_records(int count) {
    std::vector<IrradianceRecord> records;
    RandomStream random({1, 2, 3, 4});
    for (int i = 0; i < count; ++i) {
        IrradianceRecord record;
        const int axis = i % 3;
        record.position = 4.0f * glm::vec3(random.next(), random.next(), random.next());
        record.position[axis] = 0.0f;
        record.normal = glm::vec3(0.1f * random.next(), 0.1f * random.next(), 0.1f * random.next());
        record.normal[axis] = 1.0f;
        record.normal = glm::normalize(record.normal);
        record.radius = std::exp2(-5.0f * random.next());
        record.growth = i % 4 == 0 ? 0.0f : std::exp2(8.0f * random.next());
        record.space.headroom = i % 5 == 0 ? 0.01f : std::numeric_limits<float>::infinity();
        records.push_back(record);
    }
    return records;
}

using Found = std::map<int, float>;

Found search_lists(const RecordLists& lists, const glm::vec3& position, const glm::vec3& normal, float accuracy) {
    Found found;
    lists.visit(position, normal, accuracy,
                [&](int number, float error) { EXPECT_TRUE(found.emplace(number, error).second) << "visited twice"; });
    return found;
}

Found search_all(const std::vector<IrradianceRecord>& records, float accuracy, const glm::vec3& position,
                 const glm::vec3& normal) {
    Found found;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const float error = interpolation_error(records[i], position, normal);
        if (error < accuracy) found.emplace(static_cast<int>(i), error);
    }
    return found;
}

TEST(RecordLists, FindWhatASearchOfAllRecordsFinds) {
    for (const int count : {1, 7, 8, 9, 3000}) {
        const std::vector<IrradianceRecord> records = make_room_records(count);
        for (const float accuracy : {0.05f, 0.4f, 0.98f}) {
            const RecordLists lists(records, accuracy);
            EXPECT_EQ(lists.accuracy(), accuracy);
            RandomStream random({5, 6, 7, 8});
            std::size_t found = 0;
            for (int i = 0; i < 2000; ++i) {
                // Near a record, so that few look-ups are empty; some outside of all.
                const IrradianceRecord& near = records[static_cast<std::size_t>(i * 7 % count)];
                const float reach = 1.5f * accuracy * near.radius;
                glm::vec3 position = near.position, normal = near.normal;
                for (int axis = 0; axis < 3; ++axis) {
                    const bool off = near.normal[axis] < 0.5f;
                    position[axis] += (off ? reach : 0.1f * reach) * (2.0f * random.next() - 1.0f);
                    normal[axis] += accuracy * (random.next() - 0.5f);
                }
                normal = glm::normalize(normal);
                const Found expected = search_all(records, accuracy, position, normal);
                EXPECT_EQ(search_lists(lists, position, normal, accuracy), expected);
                found += expected.size();
            }
            EXPECT_GT(found, 150u);
        }
    }
}

TEST(RecordLists, AreEmptyOutsideAndWithoutRecords) {
    const RecordLists none(std::vector<IrradianceRecord>{}, 0.5f);
    EXPECT_TRUE(search_lists(none, glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, 0.5f).empty());
    const RecordLists some(make_room_records(20), 0.5f);
    for (const float far :
         {100.0f, -100.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
        EXPECT_TRUE(search_lists(some, glm::vec3(far, 0.0f, 0.0f), {0.0f, 0.0f, 1.0f}, 0.5f).empty());
}

TEST(RecordLists, ACacheInterpolatesTheSameWithAndWithoutThem) {
    IrradianceCache cache(glm::vec3(0.0f), glm::vec3(4.0f));
    std::vector<IrradianceRecord> records = make_room_records(500);
    RandomStream random({9, 9, 9, 9});
    for (IrradianceRecord& record : records) {
        record.irradiance = {random.next(), random.next(), random.next()};
        record.space.sectors.fill(std::numeric_limits<float>::infinity());
        record.accuracy = 0.2f;  // lists for 1.4, 2.8 times this, and for 1
    }
    IrradianceCache prepared = cache;
    cache.restore(records);
    prepared.restore(records);
    prepared.prepare();
    int found = 0;
    for (const IrradianceRecord& at : make_room_records(300)) {
        for (const float accuracy : {0.6f, 0.28f, 0.2f, 1.0f}) {
            const CacheQuery query{at.position, at.normal, accuracy};
            const auto expected = cache.interpolate(query), value = prepared.interpolate(query);
            ASSERT_EQ(value.has_value(), expected.has_value());
            if (!value) continue;
            ++found;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR((*value)[c], (*expected)[c], 1e-6f);
        }
    }
    EXPECT_GT(found, 300);
    // A new record ends them.
    IrradianceRecord added = records.front();
    added.irradiance = Rgb(1000.0f);
    added.position += 1e-3f;
    prepared.insert(added);
    const auto changed = prepared.interpolate({added.position, added.normal, 0.6f});
    ASSERT_TRUE(changed.has_value());
    EXPECT_GT(changed->x, 10.0f);
}

}  // namespace
}  // namespace aleph
