#pragma once
// One coarse irradiance cache for the light of the second and all further bounces.
//
// Irradiance of n bounces is a gather of direct light and of what hits scatter of E_(n-1), their irradiance of n - 1
// bounces. E_(n-1) changes slowly, and reaches the picture averaged over a hemisphere and times the albedo: few records
// with few rays hold it. They lie where gather rays from the picture arrive. Each record casts its rays once, and keeps
// for each the direct light that it found and the records from which the irradiance of the hit is interpolated
// (light_transport.h). Going from E_1 to E_2 and so on then takes no more rays: work does not grow with the bounces.

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
class FurtherIrradiance final : public KnownIrradiance {
  public:
    explicit FurtherIrradiance(const MultiBounceLight& light);

    std::optional<Rgb> find(const ViewedSurface& surface, const Hit& hit, float accuracy, const Rgb& weight,
                            RayTask& task) const override;

  private:
    const MultiBounceLight light_;
};

/// Irradiance of all bounces that a frame knows before it is shaded: that of lighting keyframes, and of its own cache.
class FrameIrradiance final : public KnownIrradiance {
  public:
    /// Keeps a reference to the context.
    /// @param context  carried light comes first
    /// @param cache    of the frame, filled; null: none
    FrameIrradiance(const IndirectContext& context, const IrradianceCache* cache);

    std::optional<Rgb> find(const ViewedSurface& surface, const Hit& hit, float accuracy, const Rgb& weight,
                            RayTask& task) const override;

  private:
    const IndirectContext& context_;
    const IrradianceCache* cache_;
};

/// Computes it where the gathers that fill the picture's cache need it.
/// @param context  of the picture
/// @param seen     surfaces of the picture whose light will be gathered (add_seen_surfaces)
/// @param counts   increased
/// @return nothing if the picture has one bounce, or `seen` is empty
std::optional<FurtherBounces> solve_further_bounces(const IndirectContext& context,
                                                    const std::vector<PixelSurface>& seen, FrameCounts& counts);

/// The same from its records; nothing if there are none.
std::optional<FurtherBounces> restore_further_bounces(const IndirectContext& context,
                                                      const std::vector<IrradianceRecord>& records);

}  // namespace aleph
