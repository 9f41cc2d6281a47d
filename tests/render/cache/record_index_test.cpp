// The octree of records: its cells, and which of them a look-up enters.

#include <numeric>

#include "render/cache/record_index.h"
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

TEST(RecordIndex, CellsAreHalvedAroundTheRecord) {
    RecordIndex index = make_index();
    index.add({2.5f, 0.5f, 3.6f}, {0.6f, 7.0f}, 0.5f);  // reaches .3
    const std::vector<Cell> cells = cells_of(index);
    ASSERT_EQ(cells.size(), 2u);
    EXPECT_EQ(cells[0].center, glm::vec3(2.0f, 0.0f, 4.0f));
    EXPECT_EQ(cells[0].half_size, 1.0f);
    EXPECT_EQ(cells[0].first_record, -1);
    EXPECT_EQ(cells[1].center, glm::vec3(2.5f, 0.5f, 3.5f));
    EXPECT_EQ(cells[1].half_size, 0.5f);
    EXPECT_EQ(cells[1].first_record, 0);
    for (const Cell& cell : cells) {
        EXPECT_EQ(cell.most.radius, 0.6f);
        EXPECT_EQ(cell.most.spread, 7.0f);
        EXPECT_EQ(cell.min_radius, 0.6f);
    }
    // A reach of just half the cell's half side goes one further down.
    RecordIndex half = make_index();
    half.add({2.5f, 0.5f, 3.6f}, {0.5f}, 0.5f);
    EXPECT_EQ(cells_of(half).back().half_size, 0.25f);
    EXPECT_EQ(cells_of(half).back().center, glm::vec3(2.25f, 0.25f, 3.75f));
    // The spread bounds the reach too: sqrt(.25) x .6.
    RecordIndex spread = make_index();
    spread.add({2.5f, 0.5f, 3.6f}, {9.0f, 0.6f}, 0.25f);
    EXPECT_EQ(cells_of(spread).back().half_size, 0.5f);
}

TEST(RecordIndex, TheBoxIsACubeOfItsLongestSide) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 low(10.0f), high(11.0f);
        low[axis] = 6.0f;
        RecordIndex index(low, high);
        index.add(0.5f * (low + high), {1.0f}, 1.0f);  // at the centre: in the lowest child
        ASSERT_EQ(cells_of(index).size(), 1u) << axis;
        EXPECT_EQ(cells_of(index)[0].half_size, 1.25f) << axis;
        EXPECT_EQ(cells_of(index)[0].center, 0.5f * (low + high) - 1.25f) << axis;
    }
    RecordIndex point(glm::vec3(0.0f), glm::vec3(0.0f));
    point.add(glm::vec3(0.0f), {0.4e-6f}, 1.0f);
    EXPECT_EQ(cells_of(point).at(0).half_size, 0.5e-6f);
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

TEST(RecordIndex, ReachFollowsAccuracy) {
    EXPECT_EQ((RecordReach{8.0f, 2.0f}.at(0.25f)), 1.0f);
    EXPECT_EQ((RecordReach{2.0f, 2.0f}.at(0.25f)), 0.5f);
    EXPECT_EQ((RecordReach{8.0f}.at(0.25f)), 2.0f);
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

}  // namespace
}  // namespace aleph
