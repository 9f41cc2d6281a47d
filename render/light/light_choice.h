#pragma once
// One light for a surface point, chosen among all, and whether it reaches the point.

#include <optional>

#include "render/light/lights.h"
#include "render/surface/media.h"
#include "render/surface/ray_task.h"
#include "render/surface/scatter.h"

namespace aleph {

/// Trees of the same lights. Each of `others` comes with a sample of what is hidden with a probability of `share`: the
/// choice between the two makes no noise where hidden lights bring nothing.
struct SplitLights {
    LightTree others, hidden;
    float share = 0.0f;
};

/// The parts of a posed scene that shading needs.
struct LightingContext {
    const ShadingScene& shading;
    const LightSet& lights;
    const RayScene& rays;
    Media around{};  ///< of the points that paths start from, such as the camera
    // Knowledge of the lights (known_lights.h).
    const SplitLights* seen = nullptr;      ///< for direct light of what the camera sees; null: LightSet::tree alone
    const LightTree* met = nullptr;         ///< for light that reaches it indirectly; null: LightSet::tree
    const SkyOpenings* openings = nullptr;  ///< null: none
};

/// The receiver by which lights are chosen for a surface. It may refer to it.
inline Receiver make_receiver(const LightingContext& context, const LitSurface& lit) {
    return {lit.point.ray_origin(), lit.point.normal, lit.material.has_glass(),
            lit.material.is_gloss_alone() ? &lit : nullptr, context.openings};
}

/// The same for a Lambert surface.
inline Receiver make_lambert_receiver(const LightingContext& context, const SurfacePlace& place) {
    return {place.ray_origin(), place.normal, false, nullptr, context.openings};
}

/// The receiver with what it sees of the openings, for lights that are chosen as well as sampled: found once.
/// @param seen  set where there are openings; the receiver refers to it
inline Receiver with_openings(Receiver receiver, std::optional<SeenOpenings>& seen) {
    if (receiver.openings != nullptr) receiver.seen = &seen.emplace(see_openings(*receiver.openings, receiver));
    return receiver;
}

/// Light of one light that a surface scatters towards its viewer, before its shadow ray is cast.
struct ScatteredLight {
    Ray shadow_ray;
    Rgb radiance{0.0f};
    bool shadowed = true;  ///< false: nothing stands between, and the ray need not be cast
};

/// Independent numbers in [0,1), from which a light is sampled.
struct LightNumbers {
    float choice = 0.0f;
    glm::vec2 point{0.0f};
};

/// A sample of one light, chosen in proportion to about what each brings without shadow (light_cut.h). Unbiased for the
/// sum of all lights.
/// @param shares  of the lobes from which directions are sampled as well, for the weights of scatter_towards
ScatteredLight choose_light(const LightingContext& context, const LitSurface& lit, const LobeShares& shares,
                            const LightNumbers& numbers);
/// The same for a white Lambert surface whose other lobes, if any, are not sampled.
ScatteredLight choose_lambert_light(const LightingContext& context, const SurfacePlace& place,
                                    const LightNumbers& numbers);

/// The ray from a surface to a light that was sampled from its viewer's side (Receiver). Behind the surface it starts
/// elsewhere, and still ends at the sampled point: it must not reach the light.
Ray make_shadow_ray(const LitSurface& lit, const LightSample& sample);

/// Smooth sheets of glass that a straight ray passes at most.
inline constexpr int max_sheets = 64;

/// Takes a ray through the smooth sheet that it met, and multiplies `passed` by the share of light that the sheet lets
/// pass. @return false: the surface is no such sheet
bool pass_sheet(const ShadingScene& shading, const Hit& hit, Ray& ray, Rgb& passed);

/// The hit of a ray beyond smooth sheets of glass.
/// @param ray     moved beyond them
/// @param passed  multiplied by what they let pass
/// @param count   increased by the rays that are cast
Hit find_beyond_sheets(const LightingContext& context, RayTask& task, Ray& ray, Rgb& passed, std::uint64_t& count);

/// Share of light that the medium leaves between a surface and a light. It is one medium: the walls of volumes stop
/// shadow rays.
/// @param around  the viewer's side of the surface
Rgb transmit_to_light(const Media& around, const LitSurface& lit, const Ray& shadow_ray);

/// Share of light that passes along a shadow ray: smooth sheets of glass and blended surfaces pass some, everything
/// else stops it.
Rgb find_transmittance(const LightingContext& context, RayTask& task, const Ray& ray);

}  // namespace aleph
