#include "perception/vision/display_hold.h"

#include <cmath>
#include <numbers>

namespace aleph {

double hold_transfer(double rho, double tracked, double persistence, const FrameRate& frame_rate) {
    constexpr double max_input = 1e30;
    // std::fmax and std::fmin return the other argument for a NaN.
    rho = std::fmin(std::fmax(rho, 0.0), max_input);
    tracked = std::fmin(std::fmax(tracked, 0.0), max_input);
    persistence = std::fmin(std::fmax(persistence, 0.0), 1.0);
    const auto loss = [rho](double width) {
        const double cycles = 4.0 / std::numbers::pi * rho * width;
        return 1.0 + cycles * cycles;
    };
    const double display = loss(persistence * tracked / frame_rate.per_second());
    const double eye = loss(persistence * (eye_blur_slope * tracked + eye_blur_offset));
    return loss(persistence * eye_blur_offset) / eye / display;
}

}  // namespace aleph
