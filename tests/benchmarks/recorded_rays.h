#pragma once
// The rays that a computation casts, for benchmarks that trace them again with Embree alone.

#include <functional>
#include <vector>

#include "tests/benchmarks/raw_embree.h"

namespace aleph {

/// The rays that `run` casts through Embree, in their order, each once. They are recorded by functions of the program
/// that stand in for Embree's, so that `run` must cast them on one thread.
std::vector<RawRay> record_rays(const std::function<void()>& run);

}  // namespace aleph
