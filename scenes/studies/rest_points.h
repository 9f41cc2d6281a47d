#pragma once
// Surface points whose light stays the same from one frame to the next, and what a renderer makes of them.

#include <array>
#include <vector>

#include "scenes/studies/study_frame.h"

namespace aleph {

/// A point of a surface at rest, seen at a pixel's centre in one frame and between up to four pixels in the next.
struct RestPoint {
    std::size_t pixel = 0;                 ///< index in the first frame
    std::array<std::size_t, 4> targets{};  ///< indices in the next frame
    std::array<float, 4> weights{};        ///< of the targets, bilinear; they sum to 1
    Rgb reflected{0.0f};                   ///< reflect_unit_irradiance in the first frame
    double threshold = 0.0;                ///< cd/m2
};

/// Points of instances that cannot move, one in each block of so many pixels, whose surroundings do not change their
/// light: two gathers with the same rays, one in each frame, differ by less than a hundredth of the threshold. The
/// point is followed exactly; it has to be visible in the next frame, on the same smooth surface in all target pixels.
/// @param threshold  cd/m2, of the first frame
std::vector<RestPoint> find_rest_points(const StudyFrame& now, const StudyFrame& next, const RenderSettings& settings,
                                        const Image<float>& threshold, int block);

/// Irradiance from the indirect light of a picture (ShadedFrame::indirect): divided by what surfaces reflect. Negative
/// where a surface reflects too little to tell.
Image<Rgb> find_irradiance(const StudyFrame& frame, const Image<Rgb>& indirect);

/// Change of the points' reflected light from one frame to the next over the threshold, ascending.
std::vector<double> measure_flicker(const StudyFrame& now, const std::vector<RestPoint>& points,
                                    const Image<Rgb>& irradiance_now, const Image<Rgb>& irradiance_next);

}  // namespace aleph
