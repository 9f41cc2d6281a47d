#pragma once
// The rays of one task of a parallel loop.

#include <mutex>

#include "engine/base/parallel.h"
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

/// Calls body(i, task) for every i below `count`, on all threads: pieces of `grain` share a task.
template <class Body>
void cast_parallel(std::size_t count, std::size_t grain, const RayScene& rays, RayCounts& counts, const Body& body,
                   Blend blend = Blend::random) {
    std::mutex counts_mutex;
    parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        RayTask task(rays, blend);
        for (std::size_t i = begin; i < end; ++i) body(static_cast<int>(i), task);
        const std::lock_guard lock(counts_mutex);
        counts += task.counts;
    });
}

}  // namespace aleph
