#pragma once
// Knowledge of a picture's lights, found by rays before its samples, which then go where light comes from.

#include "render/light/light_choice.h"
#include "render/light/sky_openings.h"
#include "render/pixels/pixel_surfaces.h"

namespace aleph {

/// Lights that reach none of some places.
struct HiddenLights {
    float share = 0.0f;       ///< samples of these lights for each of the others: 2 / sqrt(places), at most 1 / 2
    float scale = 1.0f;       ///< factor of their strength, with which they bring `share` of what the others bring
    std::vector<bool> which;  ///< ShadingScene::instances, then ScenePose::lights, then the environment

    bool empty() const { return which.empty(); }
};

/// Decides how lights are sampled, never what the mean of the samples is.
struct KnownLights {
    std::optional<SkyOpenings> openings;  ///< of the room that the camera sees
    HiddenLights unseen;                  ///< from places that the camera sees
    HiddenLights unmet;                   ///< from these, and from places that rays by cosine from them meet
};

/// Rays between places and each light tell which lights reach any of them: 8 to 1,024 places, fewer of them the more
/// lights there are. Nothing is hidden where there is one light, or so many that the rays would cost more than they
/// save, or where those that are hidden would bring little. A pure function of its arguments.
/// @param counts  increased, rays as RayCounts::shadow
KnownLights find_known_lights(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              RayCounts& counts);

/// Adds what is known of another time. Hidden are lights that are hidden at both.
/// @param shift  m, from the coordinates of that time to these
void add_known_lights(const KnownLights& other, const glm::vec3& shift, KnownLights& known);

/// The lights by what is known of them.
struct KnownLightTrees {
    SplitLights seen;  ///< LightingContext::seen; no groups if nothing is hidden
    LightTree met;     ///< LightingContext::met, likewise

    KnownLightTrees() = default;
    /// @param lights  of the picture, or of another time while its shutter is open
    KnownLightTrees(const ShadingScene& shading, const LightSet& lights, const KnownLights& known);
};

}  // namespace aleph
