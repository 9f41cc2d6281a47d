#pragma once
// The rays that a computation casts, for benchmarks that trace them again with Embree alone.

#include <functional>
#include <vector>

#include "engine/rays/ray_scene.h"
#include "tests/benchmarks/raw_embree.h"

namespace aleph {

/// The rays that `run` casts through Embree, in their order, relative to origin_of_recorded. A ray that goes through
/// several of RayScene's trees is recorded at the first, through which all rays go. They are recorded by functions of
/// the program that stand in for Embree's, so that `run` must cast them on one thread.
std::vector<RawRay> record_rays(const std::function<void()>& run);

/// m, world: RayScene's rays are relative to its flat tree's origin in the first tree, or to the anchor where it has
/// none.
glm::dvec3 origin_of_recorded(const RayScene& rays, const ScenePose& pose);

}  // namespace aleph
