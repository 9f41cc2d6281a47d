#pragma once
// Points, cages and triangles to JSON; the reading half is meshes.cpp and cages.cpp.

#include <nlohmann/json.hpp>

#include "engine/scene/scene.h"

namespace aleph {

nlohmann::ordered_json write_points(const PointCache& cache, const FrameRate& rate);

/// A shape as it was authored.
nlohmann::ordered_json write_shape(const Shape& shape);

/// @param points  name of the cage's points
nlohmann::ordered_json write_cage(const Cage& cage, const std::string& points);

/// A mesh's lists.
/// @param cache  its points over time; none where it has none
nlohmann::ordered_json write_triangles(const Mesh& mesh, const PointCache* cache, const FrameRate& rate);

}  // namespace aleph
