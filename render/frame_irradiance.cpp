#include "render/frame_irradiance.h"

#include "render/bounce_levels.h"

namespace aleph {

FrameIrradiance::FrameIrradiance(const IndirectContext& context, const IrradianceCache* cache)
    : KnownIrradiance(count_bounces(context.settings)),
      carried_(context.carried),
      cache_(cache),
      reach_(static_cast<float>(context.settings.shade_reach)) {}

std::optional<Rgb> FrameIrradiance::find(const ViewedSurface& surface, const Hit& hit, float accuracy,
                                         RayTask& task) const {
    if (carried_ != nullptr) {
        PixelSurface place{surface};
        place.hit = hit;
        if (const std::optional<Rgb> found = carried_->find(place, accuracy, task)) return found;
    }
    if (cache_ == nullptr) return std::nullopt;
    return cache_->interpolate({surface.point.position, surface.point.normal, accuracy * reach_, &task});
}

}  // namespace aleph
