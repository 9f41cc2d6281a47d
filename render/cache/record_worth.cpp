#include "render/cache/record_worth.h"

#include <numbers>

#include "render/cache/gather_at.h"
#include "render/guide/stopping_rule.h"

namespace aleph {

namespace {

// In rays of a gather, about: what a sample costs without its irradiance, and one of the rays for its irradiance.
constexpr double sample_cost = 6.0, ray_cost = 1.5;

/// Samples that a pixel takes for the sake of other light.
constexpr double usual_samples = 20.0;

/// Standard error of a record, over that of the mean of samples. Records lie about two pixels apart: noise that is
/// smooth over a pixel is 2.5 times as visible as that of single pixels at 60 cd/m2, and 2.9 times at 5 (castleCSF, as
/// in NoiseVisibility). Where records reach farther, those around them make it less (IrradianceCache::finish).
constexpr double record_noise = 0.5;

/// The light that a pixel reflects by a record, over the standard error that the mean of its samples may have.
double find_relative_light(const ExpectedRecord& expected, float reflected, float tolerance) {
    return reflected * expected.irradiance * error_deviations / tolerance;
}

}  // namespace

bool is_worth_record(const ExpectedRecord& expected, float footprint, float accuracy, float reflected, float tolerance,
                     int rays) {
    const double reach = expected.reach.at(accuracy) / footprint;
    const double pixels = std::numbers::pi * reach * reach;
    const double light = find_relative_light(expected, reflected, tolerance);
    const double more_samples = expected.ray_variance * light * light / sample_rays;
    const double rays_cost = sample_rays * ray_cost;
    return rays <= pixels * (usual_samples * rays_cost + more_samples * (sample_cost + rays_cost));
}

int add_rays_for_noise(int rays, const ExpectedRecord& expected, float reflected, float tolerance) {
    const double noise = record_noise / find_relative_light(expected, reflected, tolerance);
    return choose_rays_for_noise(expected.ray_variance, noise, rays, most_rays);
}

}  // namespace aleph
