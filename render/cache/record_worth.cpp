#include "render/cache/record_worth.h"

#include <numbers>

#include "render/guide/stopping_rule.h"

namespace aleph {

namespace {

// In rays of a gather, about: what a sample costs without its irradiance, and one of the rays for its irradiance.
constexpr double sample_cost = 6.0, ray_cost = 1.5;

/// Samples that a pixel takes for the sake of other light.
constexpr double usual_samples = 20.0;

}  // namespace

bool is_worth_record(const ExpectedRecord& expected, float footprint, float accuracy, float reflected, float tolerance,
                     int rays) {
    const double reach = expected.reach.at(accuracy) / footprint;
    const double pixels = std::numbers::pi * reach * reach;
    const double light = reflected * expected.irradiance * error_deviations / tolerance;
    const double more_samples = expected.ray_variance * light * light / sample_rays;
    const double rays_cost = sample_rays * ray_cost;
    return rays <= pixels * (usual_samples * rays_cost + more_samples * (sample_cost + rays_cost));
}

}  // namespace aleph
