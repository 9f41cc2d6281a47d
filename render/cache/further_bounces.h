#pragma once
// One coarse irradiance cache for the light of the second and all further bounces (README.md, Multi-bounce light).

#include <optional>
#include <vector>

#include "render/cache/indirect_context.h"
#include "render/path/path.h"

namespace aleph {

/// Bounces of the picture's indirect light: the last surface of a path scatters direct light only.
int count_bounces(const RenderSettings& settings);

/// Irradiance of one bounce fewer than the picture's.
struct FurtherBounces {
    IrradianceCache cache;
    float accuracy = 0.0f;  ///< alpha of its records
};

/// Makes the light that gathers for the picture find at their hits beside direct light.
/// @param known  null: random paths only, without bias
MultiBounceLight make_multi_bounce_light(const RenderSettings& settings, const FurtherBounces* known);

/// The same for paths, which use it after their first turn at a Lambert layer.
KnownIrradiance make_further_irradiance(const MultiBounceLight& light);

/// Irradiance of all bounces that a frame knows before it is shaded: that of lighting keyframes, which the context
/// carries, and then of its own cache. Keeps references; the cache may be null.
KnownIrradiance make_frame_irradiance(const IndirectContext& context, const IrradianceCache* cache);

/// Computes it where the gathers that fill the picture's cache need it.
/// @param seen  surfaces of the picture whose light will be gathered (add_seen_surfaces)
/// @return nothing if the picture has one bounce, or `seen` is empty
std::optional<FurtherBounces> solve_further_bounces(const IndirectContext& context,
                                                    const std::vector<PixelSurface>& seen, FrameCounts& counts);

/// The same from its records; nothing if there are none.
std::optional<FurtherBounces> restore_further_bounces(const IndirectContext& context,
                                                      const std::vector<IrradianceRecord>& records);

/// Irradiance of `bounces` bounces in place of that of one.
/// @param context   of the records' gathers, which noted light of further bounces (MultiBounceLight::noted)
/// @param gathered  of each record (FillPlaces::gathered)
/// @param bounces   at least 2
/// @return the records of the cache with this irradiance and its gradients
std::vector<IrradianceRecord> add_bounces(const IndirectContext& context, const IrradianceCache& cache, float accuracy,
                                          std::vector<KeptRays> gathered, int bounces, RayCounts& counts);

}  // namespace aleph
