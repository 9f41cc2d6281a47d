#pragma once
// The writer of points, cages, shapes and triangles. The reader: meshes.cpp and cages.cpp.

#include <nlohmann/json.hpp>

#include "engine/scene/scene.h"

namespace aleph {

nlohmann::ordered_json write_points(const PointCache& cache, const FrameRate& rate);

/// The shape's parameters.
nlohmann::ordered_json write_shape(const Shape& shape);

/// @param points  name of the cage's points
nlohmann::ordered_json write_cage(const Cage& cage, const std::string& points);

/// Vertices and triangles as lists.
/// @param cache  its points over time; null if it has none
nlohmann::ordered_json write_triangles(const Mesh& mesh, const PointCache* cache, const FrameRate& rate);

}  // namespace aleph
