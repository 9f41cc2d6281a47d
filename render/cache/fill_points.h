#pragma once
// The surfaces that a sample of the pixels shows, as far as filling a cache needs them.

#include "render/cache/indirect_context.h"

namespace aleph {

/// The surface of a pixel's sample.
struct FillPoint {
    glm::vec3 position{0.0f};  ///< m, relative to the anchor of IndirectContext::lighting
    float footprint = -1.0f;   ///< m, of the pixel; negative: no record is needed, or light is known (CarriedLight)
    glm::vec3 normal{0.0f};    ///< unit
    float reflected = 0.0f;    ///< luminance of radiance over irradiance
};

/// The point of a surface that needs light.
FillPoint make_fill_point(const PixelSurface& surface);

/// The surface that a pixel shows, in the pose whose light is wanted; nothing if it is not there.
std::optional<PixelSurface> find_surface(const IndirectContext& context, const SampleHits& sample, int x, int y);

/// The same if its light has to be computed.
std::optional<PixelSurface> find_needed(const IndirectContext& context, const SampleHits& sample, int x, int y,
                                        RayTask& task);

/// Those of every `step`th pixel of every `step`th row; elsewhere no light is needed.
/// @param counts  increased by the rays cast
Image<FillPoint> find_points(const IndirectContext& context, const SampleHits& sample, int step, RayCounts& counts);

}  // namespace aleph
