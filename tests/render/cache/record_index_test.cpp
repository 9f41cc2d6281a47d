// The octree of records: its cells, and which of them a look-up enters. Lists of records for look-ups at one accuracy:
// they find what a search of all records finds.

#include <numeric>

#include "engine/base/sampling.h"
#include "render/cache/irradiance_cache.h"
#include "render/cache/record_index.h"
#include "render/cache/record_lists.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Cell = RecordIndex::Cell;

/// All cells below the root.
std::vector<Cell> cells_of(const RecordIndex& index) {
    std::vector<Cell> cells;
    index.visit(
        [&](const Cell& cell) {
            cells.push_back(cell);
            return true;
        },
        [](int) { return true; });
    return cells;
}

/// A cube around (1, 1, 3) with the half side 2.
RecordIndex make_index() {
    return {{-1.0f, 0.0f, 2.0f}, {3.0f, 2.0f, 4.0f}};
}

TEST(RecordIndex, RecordsOutsideStayInTheRoot) {
    RecordIndex index = make_index();
    for (const glm::vec3& place :
         {glm::vec3(3.01f, 1.0f, 3.0f), glm::vec3(1.0f, -1.01f, 3.0f), glm::vec3(1.0f, 1.0f, 5.01f)})
        index.add(place, {0.1f}, 1.0f);
    EXPECT_TRUE(cells_of(index).empty());
    EXPECT_EQ(index.ordered().size(), 3u);
    index.add({3.0f, 1.0f, 3.0f}, {1.0f}, 1.0f);  // on the border
    EXPECT_EQ(cells_of(index).size(), 1u);
    EXPECT_EQ(cells_of(index)[0].center, glm::vec3(2.0f, 0.0f, 2.0f));
}

TEST(RecordIndex, CellsEndAtTheDeepestLevel) {
    RecordIndex index = make_index();
    index.add({1.5f, 1.5f, 3.5f}, {0.0f}, 1.0f);
    EXPECT_EQ(cells_of(index).size(), 24u);
    EXPECT_EQ(cells_of(index).back().half_size, std::ldexp(2.0f, -24));
    RecordIndex point(glm::vec3(0.0f), glm::vec3(0.0f));
    point.add(glm::vec3(0.0f), {0.4e-6f}, 1.0f);
    EXPECT_EQ(cells_of(point).at(0).half_size, 0.5e-6f);
}

TEST(RecordIndex, CellsKnowTheirRecordsBounds) {
    RecordIndex index = make_index();
    index.add({2.5f, 0.5f, 3.5f}, {0.9f, 5.0f}, 1.0f);
    index.add({2.6f, 0.6f, 3.6f}, {0.3f, 8.0f}, 1.0f);  // two levels below
    std::vector<Cell> cells = cells_of(index);
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_EQ(cells[0].most.radius, 0.9f);
    EXPECT_EQ(cells[0].most.spread, 8.0f);
    EXPECT_EQ(cells[0].min_radius, 0.3f);
    EXPECT_EQ(cells[1].most.radius, 0.3f);
    EXPECT_EQ(cells[1].first_record, 1);
    index.lower_radius({2.5f, 0.4f, 3.5f}, 0.2f);  // beside the second level's cell
    cells = cells_of(index);
    EXPECT_EQ(cells[0].min_radius, 0.2f);
    index.lower_radius({2.6f, 0.6f, 3.4f}, 0.1f);
    cells = cells_of(index);
    EXPECT_EQ(cells[0].min_radius, 0.1f);
    EXPECT_EQ(cells[1].min_radius, 0.1f);
    EXPECT_EQ(cells[0].most.radius, 0.9f);
}

TEST(RecordIndex, DistanceToACellIsZeroInside) {
    Cell cell;
    cell.center = {1.0f, 2.0f, 3.0f};
    cell.half_size = 0.5f;
    EXPECT_EQ(cell.distance_to({1.4f, 1.6f, 3.5f}), 0.0f);
    EXPECT_EQ(cell.distance_to({3.0f, 2.0f, 3.0f}), 1.5f);
    EXPECT_EQ(cell.distance_to({-3.0f, -1.5f, 3.2f}), std::hypot(3.5f, 3.0f));
}

TEST(RecordIndex, NearIsWithinCellReachAndExtra) {
    // In the cell around (2.5, .5, 3.5) with the half side .5, whose record reaches .25 at the accuracy of .25.
    for (const RecordReach& reach : {RecordReach{1.0f}, RecordReach{9.0f, 0.5f}}) {
        RecordIndex index = make_index();
        index.add({2.5f, 0.5f, 3.6f}, reach, reach.radius == 1.0f ? 0.3f : 0.36f);
        const auto finds = [&](const glm::vec3& position, float extra) {
            bool found = false;
            index.visit_near(position, 0.25f, extra, [&](int) { return found = true; });
            return found;
        };
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : {-1.0f, 1.0f}) {
                glm::vec3 at(2.5f, 0.5f, 3.5f);
                const float middle = at[axis];
                at[axis] = middle + side * 0.75f;
                EXPECT_TRUE(finds(at, 0.0f)) << axis;
                at[axis] = middle + side * 0.751f;
                EXPECT_FALSE(finds(at, 0.0f)) << axis;
                EXPECT_TRUE(finds(at, 0.125f)) << axis;
                at[axis] = middle + side * 0.876f;
                EXPECT_FALSE(finds(at, 0.125f)) << axis;
            }
        }
    }
}

TEST(RecordIndex, OrderKeepsCellsTogether) {
    RecordIndex index = make_index();
    const glm::vec3 places[] = {{0.1f, 0.1f, 2.1f}, {2.9f, 1.9f, 3.9f}};
    for (int i = 0; i < 20; ++i) index.add(places[i % 2], {0.3f}, 1.0f);
    const std::vector<int> order = index.ordered();
    EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), 20u);
    const auto change = [&](int a, int b) { return a % 2 != b % 2; };
    EXPECT_EQ(std::ranges::count(order, order[0] % 2, [](int i) { return i % 2; }), 10);
    EXPECT_EQ(std::inner_product(order.begin() + 1, order.end(), order.begin(), 0, std::plus<>(), change), 1);
    // A visit ends where a record says so.
    int visited = 0;
    index.visit([](const Cell&) { return true; }, [&](int) { return ++visited < 7; });
    EXPECT_EQ(visited, 7);
    // The same box without records.
    RecordIndex empty = index.emptied();
    EXPECT_TRUE(empty.ordered().empty());
    empty.add({2.5f, 0.5f, 3.6f}, {0.6f}, 1.0f);
    EXPECT_EQ(cells_of(empty).back().center, glm::vec3(2.0f, 0.0f, 4.0f));
}

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
