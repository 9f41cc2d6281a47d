#pragma once
// Shading one sample of a pixel: emission, direct light, gloss, and indirect light read from a filled cache.

#include "render/cache/indirect_context.h"
#include "render/path/path.h"
#include "render/pixels/pixel_samples.h"
#include "render/time/shutter_light.h"

namespace aleph {

/// The scene while a sample is taken.
struct SampleScene {
    LightingContext lighting;
    const CameraView& view;
    Lens lens{};
    std::uint64_t rays_cast = 0;  ///< to find what surrounds the camera
    double at = 0.0;              ///< frames, while the shutter is open
};

/// The work of one task: its rays, and what it counts.
struct ShadingTask : RayTask {
    /// @param rays        at the samples' time
    /// @param frame_rays  at the shutter's centre: another scene while the shutter is open
    ShadingTask(const RayScene& rays, const RayScene& frame_rays) : RayTask(rays), at_frame(frame_rays) {}

    RayTask at_frame;
    std::uint64_t lookups = 0, hits = 0, invalid = 0;
};

/// How a frame's samples are shaded.
struct SampleShading {
    const IndirectContext& context;
    bool indirect = false;  ///< there is indirect light
    /// Finished; null: there are no records. Samples find irradiance that is not known by paths of their own.
    const IrradianceCache* cache = nullptr;
    const KnownIrradiance* known = nullptr;  ///< to paths; null: they find all light by themselves
    bool blurred = false;                    ///< the shutter is open: what `shutter` does not know is found by paths
    const ShutterLight* shutter = nullptr;   ///< null: it knows nothing
    Image<RecordUse>* uses = nullptr;        ///< records that were read; null: not asked for
};

/// Keeps the random numbers of paths apart from those of direct light and of gathers (gather_at.cpp).
inline constexpr std::uint32_t path_seed_mask = 0x70617468u;

/// Random numbers of a pixel sample's path.
/// @param noise_key  SamplePlace::noise_key
RandomStream path_stream(std::uint32_t seed, std::uint32_t noise_key, const PixelSurface& surface,
                         std::uint32_t mask = path_seed_mask);

/// A path of the settings' length that begins at a pixel's surface.
/// @param around  the camera
PathState start_path(const RenderSettings& settings, const Media& around);

/// The scene with the media that a sample's ray passes before its surface in place of those around the camera. They
/// differ where rays do not begin at the camera itself: on a lens, and in an orthographic view.
SampleScene scene_before(const SampleScene& scene, RayTask& task, const PixelSurface& surface);

/// Share of light that reaches the camera through the media before a surface.
Rgb share_left(const Media& before, const PixelSurface& surface);

/// Radiance that reaches the camera from what a sample's ray met, without what that reflects.
/// @param direction  of the ray, unit
Rgb find_emission(const SampleScene& scene, RayTask& task, const SamplePlace& place, const Hit& hit,
                  const glm::vec3& direction, const glm::ivec2& pixel);

/// Sets what a sample's light tells of its surface.
void begin_light(const PixelSurface& surface, SampleLight& light);

/// Finds the light that a pixel's surface sends to the camera, with the cache.
/// @param scene  scene_before
/// @param light  after begin_light
void shade_sample(const SampleShading& shading, const SampleScene& scene, ShadingTask& task,
                  const PixelSurface& surface, const PixelSamples& pixel, SampleLight& light);

}  // namespace aleph
