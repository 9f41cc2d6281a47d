#pragma once
// Lights that things hide at one time and not at another. All that such a light sends out may be missing then, and with
// it the indirect light of places that are far from the thing: a lid on a lamp, a slide before a spot.

#include "render/time/shutter_light.h"

namespace aleph {

/// About the largest share of a light that things hide at one of two times and not at the other. A sphere of radius r
/// at distance d hides at most r^2 / d^2 of what a lamp sends out, a spot's over sin^2 of its cone, and of a lamp of
/// area A 2 pi r^2 / A. If it moves by s past the lamp, of radius a, that changes by no more than 3 s / max(d, min(r,
/// a)) of itself, and by as much as its material fades.
/// @param movers  find_movers of the frame
float find_shadow_change(const ShadingScene& frame, const std::vector<ShutterMover>& movers);

/// The same of light from afar, for one point: things hide it along their shadows, and at most r^2 / d^2 of what the
/// point receives comes from within r of the middle of one, d away.
/// @param position, moved, instance, enough  as those of find_hidden_change
float find_sunlight_change(const ShadingScene& frame, const std::vector<ShutterMover>& movers,
                           const glm::vec3& position, const glm::vec3& moved, int instance, float enough);

}  // namespace aleph
