#include "tests/perception/grating_run.h"

#include <algorithm>
#include <cmath>

#include "perception/perception.h"
#include "perception/vision/vision_model.h"
#include "tests/perception/vision_formulas.h"

namespace aleph {

namespace {

double relative(double found, double known) {
    return std::abs(found / known - 1.0);
}

}  // namespace

void GratingErrors::merge(const GratingErrors& other) {
    response = std::max(response, other.response);
    adaptation = std::max(adaptation, other.adaptation);
    aleph_written = std::max(aleph_written, other.aleph_written);
    aleph_scalar = std::max(aleph_scalar, other.aleph_scalar);
    aleph_lowest = std::min(aleph_lowest, other.aleph_lowest);
    aleph_highest = std::max(aleph_highest, other.aleph_highest);
    compared += other.compared;
    left_out += other.left_out;
}

GratingErrors run_grating(const GratingRun& run, int step) {
    const Image<Rgb> picture = make_grating(run.grating);
    const Image<float> velocity(picture.width, picture.height, static_cast<float>(run.velocity));
    PerceptionOutputs outputs;
    outputs.bands = true;
    const PerceptionMaps maps =
        compute_perception(picture, velocity, run.viewing, run.frame_rate, run.perception, outputs);

    const VisionModel* const vision = run.perception.vision;
    const double moving = run.perception.guide == Guide::spatial ? 0.0 : static_cast<float>(run.velocity);
    EyeMotion motion{.retinal = written_retinal_velocity(moving, tracking_efficiency),
                     .tracked = written_tracked_velocity(moving, tracking_efficiency),
                     .persistence = run.viewing.persistence,
                     .frame_rate = run.frame_rate.per_second()};
    const auto rho = band_frequencies(run.perception.bands, run.viewing.pixels_per_degree);
    GratingErrors errors;
    for (int x = 0; x < picture.width; x += step) {
        const auto bands = exact_bands(run.grating.angular(), x);
        double sum = 0.0;
        for (const double band : bands) sum += band;
        if (sum < least_band_sum) {
            ++errors.left_out;
            continue;
        }
        ++errors.compared;
        if (vision->uses_luminance()) {
            const double share = exact_adaptation(run.grating, x, run.viewing.pixels_per_degree);
            motion.luminance = run.viewing.display_white * share;
            errors.adaptation =
                std::max(errors.adaptation, relative(maps.adaptation(x, Grating::middle), motion.luminance));
        }
        double written = 0.0, scalar = 0.0;
        for (int i = 0; i < band_count; ++i) {
            const double response = bands[i] / sum;
            written += response * written_elevation(vision, rho[i], motion);
            scalar += response * vision->elevation({rho[i], motion.retinal, motion.tracked, motion.luminance},
                                                   {run.viewing, run.frame_rate});
            errors.response = std::max(
                errors.response, std::abs(maps.responses[static_cast<std::size_t>(i)](x, Grating::middle) - response));
        }
        const double found = maps.aleph(x, Grating::middle);
        errors.aleph_written = std::max(errors.aleph_written, relative(found, written));
        errors.aleph_scalar = std::max(errors.aleph_scalar, relative(found, scalar));
        errors.aleph_lowest = std::min(errors.aleph_lowest, written);
        errors.aleph_highest = std::max(errors.aleph_highest, written);
    }
    return errors;
}

}  // namespace aleph
