#include "render/shade/frame_irradiance.h"

#include "render/cache/further_bounces.h"

namespace aleph {

FrameIrradiance::FrameIrradiance(const IndirectContext& context, const IrradianceCache* cache)
    : KnownIrradiance(count_bounces(context.settings)), context_(context), cache_(cache) {}

std::optional<Rgb> FrameIrradiance::find(const ViewedSurface& surface, const Hit& hit, float accuracy, const Rgb&,
                                         RayTask& task) const {
    if (context_.carried != nullptr) {
        PixelSurface place{surface};
        place.hit = hit;
        if (const std::optional<Rgb> found = context_.carried->find(place, accuracy, task)) return found;
    }
    if (cache_ == nullptr) return std::nullopt;
    return cache_->interpolate({surface.point.position, surface.point.normal, accuracy * shade_reach, &task});
}

}  // namespace aleph
