#pragma once
// Points of a cost and an error, of which less is better: which ones nothing beats, and what the others cost beside
// them.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace aleph {

struct CostPoint {
    double cost = 0.0;   ///< seconds
    double error = 0.0;  ///< percent
};

/// True if a costs as little as b and errs as little, and less in one of the two.
bool dominates(const CostPoint& a, const CostPoint& b);

/// Ranks by non-dominated sorting (Deb et al. 2002): 0 for the front, 1 for the front of what is left without it, and
/// so on.
std::vector<int> rank_points(std::span<const CostPoint> points);

/// How far apart the neighbours of each point lie within its rank (Deb et al. 2002), in logarithms of cost and error,
/// each as a part of the rank's extent; infinite for the ends of a rank. Errors below .01 % count as .01 %.
std::vector<double> crowding_distances(std::span<const CostPoint> points, std::span<const int> ranks);

/// Indices of the `count` best points, in ascending order: those of lower ranks, and within a rank those with more
/// room around them. Of points that are equal in both the first are kept.
std::vector<std::size_t> keep_best(std::span<const CostPoint> points, std::size_t count);

/// Indices of the front, by ascending cost. Of equal points it has the first.
std::vector<std::size_t> list_front(std::span<const CostPoint> points);

/// The cheapest point that errs by no more; nothing if all err by more.
std::optional<std::size_t> find_cheapest(std::span<const CostPoint> points, double most_error);

/// The cost of erring as little, as far as points tell.
struct FrontCost {
    enum class Bound {
        between,  ///< between two points of the front
        at_most,  ///< the cheapest point errs less
        more,     ///< the best point errs more
    };
    double cost = 0.0;
    Bound bound = Bound::between;
};

/// The cost at which the front has this error. Between two points the logarithm of the cost follows that of the error.
/// Errors below .01 % count as .01 %.
/// @param points  at least one
FrontCost interpolate_front(std::span<const CostPoint> points, double error);

}  // namespace aleph
