#pragma once
// Polygon meshes and subdivision surfaces alike: samples between changes of topology, geometry parameters, face sets.

#include <optional>
#include <vector>

#include "engine/alembic/reader.h"

namespace aleph {

/// One topology of a surface and the samples of its points.
struct SurfaceRun {
    double begin = 0.0;                        ///< s; the topology counts from here on
    std::vector<int> face_counts;              ///< points of each face
    std::vector<int> face_points;              ///< face by face, as stored
    std::vector<std::size_t> first_corner;     ///< of each face, into face_points
    TimeSampling sampling;                     ///< of point_samples
    std::vector<std::uint64_t> point_samples;  ///< of P
    std::size_t point_count = 0;
    Track<double> present{1.0};
    int points = no_index;  ///< point cache

    std::size_t corner_count() const { return face_points.size(); }
};

/// Splits a surface's samples at changes of topology, checks the topology, and makes a point cache for each run.
/// Empty where the surface never has faces. Warns where the topology changes.
std::vector<SurfaceRun> read_runs(AlembicReader& reader, int object, const AlembicCompound& geom);

enum class GeometryScope { constant, per_face, per_point, per_corner };

/// Values on a surface: plain, or indexed.
struct GeometryParameter {
    AlembicProperty values;
    std::optional<AlembicProperty> indices;
    GeometryScope scope = GeometryScope::constant;
};

struct ParameterSample {
    std::vector<float> values;  ///< `extent` for each element
    std::vector<int> indices;   ///< into the elements; empty: one to one
    std::size_t extent = 1;

    std::size_t count() const { return indices.empty() ? values.size() / extent : indices.size(); }
    /// First value of item i.
    const float* at(std::size_t i) const { return values.data() + extent * element(i); }
    /// Equal for items that the file stores once.
    std::size_t element(std::size_t i) const { return indices.empty() ? i : static_cast<std::size_t>(indices[i]); }
};

/// The parameter of a name; none where it is missing, empty or has fewer than `extent` values to an element.
std::optional<GeometryParameter> find_parameter(const AlembicArchive& archive, const AlembicCompound& compound,
                                                std::string_view name, std::size_t extent);

bool is_constant(const GeometryParameter& parameter);

/// The item of a scope at a corner.
std::size_t scope_item(GeometryScope scope, const SurfaceRun& run, std::size_t face, std::size_t corner);

/// The parameter at a time, if its size fits the surface; otherwise none, and a warning.
std::optional<ParameterSample> read_fitting(AlembicReader& reader, int object, const GeometryParameter& parameter,
                                            const SurfaceRun& run, double seconds, std::string_view name);

/// The number of the sample that is valid at a time: the last one at or before it.
std::uint64_t sample_at(const AlembicArchive& archive, const AlembicProperty& property, double seconds);

/// Materials of a surface's faces. The assignment of a face set replaces that of the surface.
struct SurfaceParts {
    std::vector<int> materials;   ///< of each part
    std::vector<int> face_parts;  ///< into materials, face by face
};
SurfaceParts read_parts(AlembicReader& reader, int object, const AlembicCompound& top, const SurfaceRun& run);

}  // namespace aleph
