#pragma once
// Indirect irradiance that is known at surfaces which paths meet. There a path takes it in place of a random ray from
// the Lambert layer, and goes on by the other lobes alone.

#include <optional>

#include "render/surface/ray_task.h"
#include "render/surface/surface_material.h"

namespace aleph {

struct KnownIrradiance {
    /// @param held  bounces of the light that is known (PathLimits::bounces)
    explicit KnownIrradiance(int held) : bounces(held) {}
    virtual ~KnownIrradiance() = default;

    /// Irradiance at a surface; nothing where it is not known to this accuracy. Called from any thread.
    /// @param surface   at the hit
    /// @param accuracy  alpha: the relative error that is allowed
    /// @param weight    radiance that the path brings of a unit of it
    /// @param task      casts rays to records where something may stand in between
    virtual std::optional<Rgb> find(const ViewedSurface& surface, const Hit& hit, float accuracy, const Rgb& weight,
                                    RayTask& task) const = 0;

    const int bounces;
    const KnownIrradiance* fewer = nullptr;  ///< light of fewer bounces; null: none is known
};

}  // namespace aleph
