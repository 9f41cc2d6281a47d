#include "motion/velocity.h"

#include <fmt/format.h>
#include <cmath>
#include <string>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"

namespace aleph {
namespace {

void require_positive(double value, const std::string& name) {
    if (!(value > 0.0) || !std::isfinite(value)) {
        throw InputError("", name, fmt::format("must be positive and finite, not {}", value));
    }
}

}  // namespace

Image<float> compute_image_velocity(const MotionField& motion, const ViewingConditions& viewing,
                                    const FrameRate& frame_rate) {
    require_positive(viewing.pixels_per_degree, "pixels per degree");
    require_positive(frame_rate.per_second(), "frames per second");
    const double degrees_per_second = frame_rate.per_second() / viewing.pixels_per_degree;

    Image<float> velocity(motion.path_length.width, motion.path_length.height);
    constexpr std::size_t pixels_per_chunk = 1 << 14;
    parallel_each(velocity.size(), pixels_per_chunk, [&](std::size_t i) {
        const MotionValidity validity = motion.validity.pixels[i];
        const bool unknown = validity == MotionValidity::behind_camera || validity == MotionValidity::no_counterpart;
        velocity.pixels[i] = unknown ? 0.0f : static_cast<float>(motion.path_length.pixels[i] * degrees_per_second);
    });
    return velocity;
}

}  // namespace aleph
