#pragma once
// The indirect irradiance that a frame knows before it is shaded: that of lighting keyframes, and that of its own
// cache.

#include "render/cache/indirect_context.h"
#include "render/path/known_irradiance.h"

namespace aleph {

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

}  // namespace aleph
