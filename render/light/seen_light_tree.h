#pragma once
// Which of very many lights reach what the camera sees: those that do not are chosen seldom.

#include "render/light/light_choice.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// Lights of a picture that reach nothing in it.
struct HiddenLights {
    float scale = 1.0f;       ///< of their strength, for choosing among lights
    std::vector<bool> which;  ///< ShadingScene::instances, then ScenePose::lights, then the environment

    bool empty() const { return which.empty(); }
};

/// Rays between places that the camera sees and each light tell which lights reach any of them. All others together are
/// then as strong as a quarter of those, so that four of five samples are of lights that do, however many are hidden;
/// and a light that reaches only what lies between the places is still chosen at least a fifth as often as by
/// LightSet::tree. Empty where that tree does: where there are few lights, or so many that the rays would cost more
/// than they save, or where little is hidden. A pure function of its arguments.
HiddenLights find_hidden_lights(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                RayCounts& counts);

/// LightingContext::seen of a picture. No groups if nothing is hidden.
/// @param lights  of the picture, or of another time while its shutter is open
LightTree make_seen_light_tree(const ShadingScene& shading, const LightSet& lights, const HiddenLights& hidden);

}  // namespace aleph
