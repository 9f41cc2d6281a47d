#pragma once
// The rays of one task of a parallel loop.

#include "engine/rays/ray_scene.h"
#include "render/settings/ray_counts.h"

namespace aleph {

/// Make one per task: it is cheap, and nothing in it is shared with other threads.
struct RayTask {
    /// @param blend  what blended surfaces do to the rays; `random` is unbiased
    explicit RayTask(const RayScene& rays, Blend blend = Blend::random) : tracer(rays, blend) {}

    Tracer tracer;
    RayCounts counts;  ///< of the rays that `tracer` cast, by purpose
};

}  // namespace aleph
