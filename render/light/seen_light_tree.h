#pragma once
// Which of very many lights reach what the camera sees: those that do not are chosen seldom.

#include "render/light/light_choice.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// LightingContext::seen of a picture. Rays between places that the camera sees and each light tell which lights reach
/// any of them. All others together are then as strong as a quarter of those, so that four of five samples are of
/// lights that do, however many are hidden; and a light that reaches only what lies between the places is still chosen
/// at least a fifth as often as by LightSet::tree. No groups where that tree does: where there are few lights, or so
/// many that the rays would cost more than they save, or where little is hidden. A pure function of its arguments.
LightTree make_seen_light_tree(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                               RayCounts& counts);

}  // namespace aleph
