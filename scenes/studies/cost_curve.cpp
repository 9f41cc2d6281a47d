#include "scenes/studies/cost_curve.h"

#include <algorithm>
#include <cmath>

namespace aleph {

std::optional<Cost> cost_at(std::vector<CostPoint> points, double percent, double least_percent) {
    std::ranges::sort(points, {}, &CostPoint::rays);
    const auto beyond = [&](const CostPoint& point) { return point.percent > percent; };
    const auto last_beyond = std::find_if(points.rbegin(), points.rend(), beyond);
    if (last_beyond == points.rend() || last_beyond == points.rbegin()) return std::nullopt;
    const CostPoint &loose = *last_beyond, &tight = *std::prev(last_beyond);
    const double high = std::log(loose.percent), low = std::log(std::max(tight.percent, least_percent));
    const double share = std::min(1.0, (high - std::log(percent)) / std::max(high - low, 1e-9));
    const auto between = [&](double a, double b) {
        return std::exp(std::lerp(std::log(std::max(a, 1e-9)), std::log(std::max(b, 1e-9)), share));
    };
    return Cost{between(loose.rays, tight.rays), between(loose.seconds, tight.seconds)};
}

}  // namespace aleph
