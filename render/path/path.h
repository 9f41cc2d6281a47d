#pragma once
// Light along paths: what reaches a surface point by any number of scattering events, without bias. Path tracing with
// next-event estimation (Kajiya 1986) and multiple importance sampling (Veach 1997), ended by Russian roulette.

#include <functional>
#include <optional>

#include "render/light/bright_surfaces.h"
#include "render/pixels/pixel_sequence.h"
#include "render/surface/media.h"

namespace aleph {

/// Indirect irradiance that is known at surfaces which paths meet. There a path takes it in place of a random ray from
/// the Lambert layer, and goes on by the other lobes alone.
struct KnownIrradiance {
    int bounces = 0;  ///< of the light that is known (PathLimits::bounces)
    /// Irradiance at a surface; nothing where it is not known to this accuracy. Called from any thread.
    /// @param accuracy  alpha: the relative error that is allowed
    /// @param weight    radiance that the path brings of a unit of it
    std::function<std::optional<Rgb>(const ViewedSurface& surface, const Hit& hit, float accuracy, const Rgb& weight,
                                     RayTask& task)>
        find{};
    const KnownIrradiance* fewer = nullptr;  ///< light of fewer bounces; null: none is known
};

/// alpha for look-ups along a path. One of weight w brings an error of w times that of the look-up to the pixel. The
/// square root of w leaves room for surfaces that are brighter in a reflection than the pixel itself.
/// @param accuracy  alpha of the pixel
/// @param pdf       of the path's last turn, per steradian: a wide lobe averages over many places; 0 for a mirror
float loosen_accuracy(float accuracy, float weight, float pdf);

/// How far paths go on.
struct PathLimits {
    int bounces = 0;  ///< times that a Lambert layer may turn the path
    int depth = 0;    ///< surfaces that may scatter, of all kinds
};

/// How light counts that the next ray meets straight away at a lamp or the environment.
enum class EmissionWeight : std::uint8_t {
    full,      ///< nothing else can find it: a camera ray, a mirror
    weighted,  ///< against sampling the light itself
    none,      ///< it is already counted
};

/// A path up to its last ray.
struct PathState {
    PathLimits left;
    Rgb throughput{1.0f};
    EmissionWeight emission = EmissionWeight::full;
    float pdf = 0.0f;        ///< density of the last turn, per steradian, if `weighted`
    Receiver from{};         ///< where it turned
    int roulette_after = 4;  ///< surfaces that scatter before Russian roulette may end the path
    float survival = 1.0f;   ///< chance to survive it, times the path's weight; at most 1
    int splits = 0;          ///< times that both parts of the light at smooth glass may be followed
    bool turned = false;     ///< at a Lambert layer
    Media media{};
    /// Used at surfaces that the path meets while the bounces that are left are those that it holds; null: nothing is
    /// known, and all light is found without bias.
    const KnownIrradiance* known = nullptr;
    float accuracy = 0.0f;                  ///< alpha of the pixel, for `known`
    const BrightSampler* bright = nullptr;  ///< weighs what the next ray meets; null: by 1
    int patch = no_index;                   ///< that this ray is aimed at
};

/// A path of indirect light, after a turn at a Lambert layer: lamps that its ray meets straight away are direct light,
/// which is computed elsewhere.
inline PathState start_indirect(const PathLimits& left, const Media& media) {
    return {.left = left, .emission = EmissionWeight::none, .turned = true, .media = media};
}

/// Emission of a surface that the path's last ray meets.
Rgb met_emission(const LightingContext& context, const PathState& state, const ViewedSurface& surface, const Hit& hit);

/// Light that the surface scatters towards its viewer, without its own emission.
Rgb scatter_light(const LightingContext& context, RayTask& task, ViewedSurface surface, PathState state,
                  RandomStream& random);

/// Light that comes back along a sampled direction: from lamps and the environment that the ray meets, and what the
/// surface there scatters, within the state's limits. Its weight is included.
Rgb follow_sample(const LightingContext& context, RayTask& task, const LitSurface& lit, const ScatterSample& sample,
                  PathState state, RandomStream& random);

/// Light that comes back along a ray, in the same way.
Rgb follow_ray(const LightingContext& context, RayTask& task, const Ray& ray, const PathState& state,
               RandomStream& random);

/// Samples of direct light, shared out among all lights.
struct DirectSamples {
    int first = 0;  ///< of the pixel's sequence
    int count = 1;
};

/// Radiance that a surface scatters from the lights, without its own emission: the mean of these samples, each of one
/// light that is chosen by about what it brings. Unbiased. The light and the point on it take one point of
/// SampleUse::light_point. Samples of the lobes are left to the caller. Each light is weighted against them by its own
/// density alone (power heuristic, Veach 1997), as if it were the only one: so a ray that meets the light needs no
/// other weight than that of PathState, whatever the choice of lights and the number of samples.
/// @param shares  of the lobes from which directions are sampled as well; those of share 0 have full weight
Rgb sample_direct_light(const LightingContext& context, RayTask& task, const LitSurface& lit, const LobeShares& shares,
                        const PixelSequence& sequence, const DirectSamples& samples);

inline constexpr float min_estimate_alpha = 0.1f;  ///< GGX width of the quick estimate's lobes

/// Direct light from a fixed pattern of points on each light. The pattern is the same for every pixel, so the result
/// has no noise that the model of vision would take for detail. Biased: penumbrae come in steps, and narrow highlights
/// are widened. More than 16 lights share the samples that 16 would have.
/// @param samples   per light that has an area
/// @param followed  lobes whose rays find lights as well (scatter_towards)
Rgb estimate_direct_light(const LightingContext& context, RayTask& task, const ViewedSurface& surface, int samples,
                          const LobeShares& followed = {});

}  // namespace aleph
