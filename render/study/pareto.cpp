#include "render/study/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ranges>
#include <utility>

#include "engine/base/errors.h"

namespace aleph {

namespace {

/// Percent of pixels: less is one pixel of a small picture.
constexpr double least_error = 0.01;
constexpr double least_cost = 1e-9;

double log_cost(const CostPoint& point) {
    return std::log(std::max(point.cost, least_cost));
}

double log_error(double error) {
    return std::log(std::max(error, least_error));
}

/// Indices of all points by ascending cost, then error, then place.
std::vector<std::size_t> sort_by_cost(std::span<const CostPoint> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(points[i].cost, points[i].error); });
    return order;
}

}  // namespace

bool dominates(const CostPoint& a, const CostPoint& b) {
    return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

std::vector<int> rank_points(std::span<const CostPoint> points) {
    std::vector<int> ranks(points.size(), -1);
    std::size_t left = points.size();
    for (int rank = 0; left > 0; ++rank) {
        std::vector<std::size_t> front;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (ranks[i] >= 0) continue;
            const auto beats = [&](std::size_t j) { return ranks[j] < 0 && dominates(points[j], points[i]); };
            if (std::ranges::none_of(std::views::iota(std::size_t{0}, points.size()), beats)) front.push_back(i);
        }
        ALEPH_CHECK(!front.empty(), "points that are no numbers");
        for (const std::size_t i : front) ranks[i] = rank;
        left -= front.size();
    }
    return ranks;
}

std::vector<double> crowding_distances(std::span<const CostPoint> points, std::span<const int> ranks) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::vector<double> distances(points.size(), infinite);
    const std::vector<std::size_t> order = sort_by_cost(points);
    const int ranks_end = ranks.empty() ? 0 : *std::ranges::max_element(ranks) + 1;
    for (int rank = 0; rank < ranks_end; ++rank) {
        // Within a rank errors fall as costs rise, so that one order serves both.
        std::vector<std::size_t> members;
        std::ranges::copy_if(order, std::back_inserter(members), [&](std::size_t i) { return ranks[i] == rank; });
        if (members.size() < 3) continue;
        const CostPoint &first = points[members.front()], &last = points[members.back()];
        const double costs = log_cost(last) - log_cost(first), errors = log_error(first.error) - log_error(last.error);
        for (std::size_t k = 1; k + 1 < members.size(); ++k) {
            const CostPoint &before = points[members[k - 1]], &after = points[members[k + 1]];
            double sum = 0.0;
            if (costs > 0.0) sum += (log_cost(after) - log_cost(before)) / costs;
            if (errors > 0.0) sum += (log_error(before.error) - log_error(after.error)) / errors;
            distances[members[k]] = sum;
        }
    }
    return distances;
}

std::vector<std::size_t> keep_best(std::span<const CostPoint> points, std::size_t count) {
    const std::vector<int> ranks = rank_points(points);
    const std::vector<double> distances = crowding_distances(points, ranks);
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return std::pair(ranks[i], -distances[i]); });
    order.resize(std::min(count, order.size()));
    std::ranges::sort(order);
    return order;
}

std::vector<std::size_t> list_front(std::span<const CostPoint> points) {
    std::vector<std::size_t> front;
    for (const std::size_t i : sort_by_cost(points)) {
        if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
    }
    return front;
}

std::optional<std::size_t> find_cheapest(std::span<const CostPoint> points, double most_error) {
    for (const std::size_t i : list_front(points)) {
        if (points[i].error <= most_error) return i;
    }
    return std::nullopt;
}

FrontCost interpolate_front(std::span<const CostPoint> points, double error) {
    const std::vector<std::size_t> front = list_front(points);
    ALEPH_CHECK(!front.empty(), "a front without points");
    const auto error_of = [&](std::size_t i) { return log_error(points[i].error); };
    const double wanted = log_error(error);
    if (wanted > error_of(front.front())) return {points[front.front()].cost, FrontCost::Bound::at_most};
    const auto right = std::ranges::find_if(front, [&](std::size_t i) { return error_of(i) <= wanted; });
    if (right == front.end()) return {points[front.back()].cost, FrontCost::Bound::more};
    if (error_of(*right) == wanted) return {points[*right].cost, FrontCost::Bound::between};
    const std::size_t left = *(right - 1);  // the first errs by more than is wanted, or by as much
    const double share = (error_of(left) - wanted) / (error_of(left) - error_of(*right));
    return {std::exp(std::lerp(log_cost(points[left]), log_cost(points[*right]), share)), FrontCost::Bound::between};
}

}  // namespace aleph
