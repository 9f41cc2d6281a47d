// Ranks, crowding and fronts of points made by hand.

#include "render/study/pareto.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Pareto, RanksAreFrontsOfWhatIsLeft) {
    const std::vector<CostPoint> points{{4.0, 4.0}, {1.0, 8.0}, {2.0, 4.0}, {8.0, 1.0},
                                        {4.0, 8.0}, {9.0, 9.0}, {2.0, 4.0}, {3.0, 5.0}};
    EXPECT_EQ(rank_points(points), (std::vector<int>{1, 0, 0, 0, 2, 3, 0, 1}));
    EXPECT_TRUE(rank_points({}).empty());
}

TEST(Pareto, CrowdingIsTheExtentOfTheNeighboursInLogarithms) {
    // Costs and errors over three decades; the last two points are of another rank.
    const std::vector<CostPoint> points{{1000.0, 0.1}, {1.0, 100.0},  {10.0, 10.0},
                                        {100.0, 5.0},  {10.0, 100.0}, {100.0, 50.0}};
    const std::vector<int> ranks = rank_points(points);
    EXPECT_EQ(ranks, (std::vector<int>{0, 0, 0, 0, 1, 1}));
    const std::vector<double> distances = crowding_distances(points, ranks);
    EXPECT_EQ(distances[0], infinity);
    EXPECT_EQ(distances[1], infinity);
    EXPECT_NEAR(distances[2], 2.0 / 3.0 + std::log10(100.0 / 5.0) / 3.0, 1e-12);
    EXPECT_NEAR(distances[3], 2.0 / 3.0 + std::log10(10.0 / 0.1) / 3.0, 1e-12);
    EXPECT_EQ(distances[4], infinity);
    EXPECT_EQ(distances[5], infinity);
}

TEST(Pareto, CrowdingTakesErrorsBelowTheLeastAsEqual) {
    const std::vector<CostPoint> points{{1.0, 0.008}, {10.0, 0.004}, {100.0, 0.0}};
    const std::vector<double> distances = crowding_distances(points, rank_points(points));
    EXPECT_DOUBLE_EQ(distances[1], 1.0) << "costs alone tell them apart";
}

TEST(Pareto, KeepsLowRanksThenTheEndsThenWhatStandsAlone) {
    const std::vector<CostPoint> points{{9.0, 90.0},   // rank 1
                                        {1.0, 80.0},   // an end
                                        {2.0, 20.0},   // crowded by the next
                                        {2.1, 19.0},   // crowded
                                        {20.0, 2.0},   // alone
                                        {40.0, 1.0}};  // an end
    EXPECT_EQ(keep_best(points, 2), (std::vector<std::size_t>{1, 5}));
    EXPECT_EQ(keep_best(points, 3), (std::vector<std::size_t>{1, 4, 5}));
    EXPECT_EQ(keep_best(points, 4), (std::vector<std::size_t>{1, 3, 4, 5}));
    EXPECT_EQ(keep_best(points, 5), (std::vector<std::size_t>{1, 2, 3, 4, 5}));
    EXPECT_EQ(keep_best(points, 9), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Pareto, KeepsTheFirstOfEqualPoints) {
    const std::vector<CostPoint> points{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}};
    EXPECT_EQ(keep_best(points, 1), std::vector<std::size_t>{0});
    EXPECT_EQ(list_front(points), std::vector<std::size_t>{0});
}

const std::vector<CostPoint> front{{4.0, 1.0}, {1.0, 16.0}, {5.0, 2.0}, {64.0, 0.25}};  // {5, 2} is beaten

TEST(Pareto, FrontIsSortedByCost) {
    EXPECT_EQ(list_front(front), (std::vector<std::size_t>{1, 0, 3}));
    EXPECT_EQ(find_cheapest(front, 1.0), 0u);
    EXPECT_EQ(find_cheapest(front, 0.9), 3u);
    EXPECT_EQ(find_cheapest(front, 100.0), 1u);
    EXPECT_FALSE(find_cheapest(front, 0.2).has_value());
}

void expect_cost(double error, double cost, FrontCost::Bound bound) {
    const FrontCost found = interpolate_front(front, error);
    EXPECT_NEAR(found.cost, cost, 1e-12 * cost) << error;
    EXPECT_EQ(found.bound, bound) << error;
}

TEST(Pareto, CostOfAnErrorIsInterpolatedInLogarithms) {
    using Bound = FrontCost::Bound;
    expect_cost(16.0, 1.0, Bound::between);
    expect_cost(4.0, 2.0, Bound::between);
    expect_cost(1.0, 4.0, Bound::between);
    expect_cost(0.5, 16.0, Bound::between);
    expect_cost(0.25, 64.0, Bound::between);
    expect_cost(17.0, 1.0, Bound::at_most);
    expect_cost(0.2, 64.0, Bound::more);
}

TEST(Pareto, ErrorsBelowTheLeastAreEqual) {
    const std::vector<CostPoint> points{{1.0, 1.0}, {3.0, 0.005}, {9.0, 0.0}};
    EXPECT_EQ(interpolate_front(points, 0.0).cost, 3.0);
    EXPECT_EQ(interpolate_front(points, 0.0).bound, FrontCost::Bound::between);
    EXPECT_NEAR(interpolate_front(points, 0.1).cost, std::sqrt(3.0), 1e-12);
    const std::vector<CostPoint> one{{2.0, 0.0}};
    EXPECT_EQ(interpolate_front(one, 0.0).cost, 2.0);
    EXPECT_EQ(interpolate_front(one, 3.0).bound, FrontCost::Bound::at_most);
}

}  // namespace
}  // namespace aleph
