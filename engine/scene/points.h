#pragma once
// The points of a point cache at a time.

#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// A cache's points, m, linear between samples. On a sample they are exactly the sample's; between samples that agree,
/// exactly theirs.
std::vector<glm::dvec3> sample_points(const PointCache& cache, double seconds);

/// False only where sample_points gives the same points at every time.
bool is_animated(const PointCache& cache);

}  // namespace aleph
