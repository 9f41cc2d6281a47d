#pragma once
// How far shutter and lens spread the picture of a point, where only the camera moves.

#include <optional>
#include <vector>

#include "engine/pose/camera_view.h"
#include "render/plan/effects_plan.h"

namespace aleph {

/// How far the picture moves while a camera takes these values in turn, about the middle one; nothing if that is not
/// known, because it moves past objects.
/// @param nearest  m, distance of what is in view; 0: not known
/// @param largest  set to the largest distance between two places of a point, pixels
std::optional<BlurMoments> find_camera_blur(const std::vector<CameraValues>& cameras, int width, int height,
                                            double nearest, double& largest);

/// Largest diameter of the circle of confusion, pixels.
/// @param nearest  m along the view direction, of what is in view
double find_largest_circle(const CameraView& view, double radius, double focus, double nearest);

}  // namespace aleph
