#pragma once
// Shadows of light from afar that move while the shutter is open: little light comes to a point from what lies in them.

#include "render/time/shutter_light.h"

namespace aleph {

/// About the largest share of a point's light that is missing at one of two times and not at the other because things
/// hide the sun: they hide it along their shadows, and at most r^2 / d^2 of what the point receives comes from within r
/// of the middle of one, d away.
/// @param position, moved, instance, enough  as those of find_hidden_change
float find_sunlight_change(const ShadingScene& frame, const std::vector<ShutterMover>& movers,
                           const glm::vec3& position, const glm::vec3& moved, int instance, float enough);

}  // namespace aleph
