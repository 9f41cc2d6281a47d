#pragma once
// Shading one sample of a pixel: emission, direct light, gloss, and indirect light read from a filled cache.

#include <vector>

#include "render/direct_light.h"
#include "render/gather.h"
#include "render/indirect_context.h"
#include "render/pixel_samples.h"

namespace aleph {

/// The scene while a sample is taken.
struct SampleMoment {
    LightingContext lighting;
    const CameraView& view;
};

/// The work of one task: its rays, and what it counts.
struct ShadingTask : RayTask {
    ShadingTask(const RayScene& rays, GatherScratch& buffers) : RayTask(rays), scratch(buffers) {}

    GatherScratch& scratch;
    std::uint64_t lookups = 0, hits = 0, computed = 0, invalid = 0;
};

/// How a frame's samples are shaded.
struct SampleShading {
    const IndirectContext& context;
    std::uint32_t moment = 0;  ///< of SamplePlace
    bool by_paths = false;     ///< all light along paths
    bool indirect = false;     ///< there is indirect light
    /// Finished; null: irradiance that no key moment knows is gathered at every sample.
    const IrradianceCache* cache = nullptr;
    const KnownIrradiance* known = nullptr;  ///< to paths from lobes; null: they find all light by themselves
    /// Radiance by which each pixel's samples may err: a part of it is left to irradiance that stands in for lobes
    /// (glossy_light.h). Null: none.
    const Image<float>* gloss_tolerance = nullptr;
    LightPoints points{};              ///< on each light, of a pixel's first sample
    Image<float>* records = nullptr;   ///< counts irradiance values computed here; of the frame's size
    Image<RecordUse>* uses = nullptr;  ///< records that were read; null: not asked for
};

/// Light that a pixel's surface sends to the camera.
/// @param light  set
/// @return false: the cache has no record here, and `light` lacks indirect light (add_indirect)
bool shade_sample(const SampleShading& shading, const SampleMoment& moment, ShadingTask& task,
                  const PixelSurface& surface, SampleLight& light);

/// Adds the indirect light that shade_sample did not find. Where there is still no record, it is gathered.
void add_indirect(const SampleShading& shading, ShadingTask& task, const PixelSurface& surface, SampleLight& light);

}  // namespace aleph
