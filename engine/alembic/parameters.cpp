// Geometry parameters: normals, texture coordinates and the like, plain or indexed, in every scope.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/alembic/surface.h"
#include "engine/base/errors.h"
#include "engine/base/index.h"

namespace aleph {
namespace {

GeometryScope scope_of(const AlembicMetadata& metadata) {
    const std::string& name = metadata_value(metadata, "geoScope");
    if (name == "uni") return GeometryScope::per_face;
    if (name == "var" || name == "vtx") return GeometryScope::per_point;
    if (name == "fvr") return GeometryScope::per_corner;
    return GeometryScope::constant;
}

/// @throws InputError where an index is out of range
ParameterSample read_parameter(const AlembicArchive& archive, const GeometryParameter& parameter, double seconds) {
    ParameterSample sample;
    sample.extent = parameter.values.extent;
    sample.values = archive.numbers<float>(parameter.values, sample_at(archive, parameter.values, seconds));
    if (!parameter.indices) return sample;
    sample.indices = archive.numbers<int>(*parameter.indices, sample_at(archive, *parameter.indices, seconds));
    const std::size_t elements = sample.values.size() / sample.extent;
    for (const int index : sample.indices) {
        if (index < 0 || static_cast<std::size_t>(index) >= elements)
            archive.fail(parameter.values, fmt::format("index {} is beyond the {} values", index, elements));
    }
    if (sample.indices.empty()) sample.values.clear();  // indexed, without items
    return sample;
}

/// Items that a scope has on a surface.
std::size_t scope_count(GeometryScope scope, const SurfaceRun& run) {
    const std::array counts{std::size_t{1}, run.face_counts.size(), run.point_count, run.corner_count()};
    return counts[index_of(scope)];
}

}  // namespace

std::optional<GeometryParameter> find_parameter(const AlembicArchive& archive, const AlembicCompound& compound,
                                                std::string_view name, std::size_t extent) {
    const AlembicProperty* property = compound.find(name);
    if (property == nullptr) return std::nullopt;
    GeometryParameter parameter;
    parameter.scope = scope_of(property->metadata);
    if (property->kind == AlembicProperty::Kind::compound) {
        const AlembicCompound indexed = archive.properties(*property);
        const AlembicProperty* values = indexed.find(".vals");
        if (values == nullptr) return std::nullopt;
        parameter.values = *values;
        if (const AlembicProperty* indices = indexed.find_sampled(".indices")) parameter.indices = *indices;
    } else {
        parameter.values = *property;
    }
    const bool fits = parameter.values.extent >= extent && is_real(parameter.values.type);
    if (parameter.values.sample_count == 0 || !fits) return std::nullopt;
    return parameter;
}

bool is_constant(const GeometryParameter& parameter) {
    return parameter.values.is_constant() && (!parameter.indices || parameter.indices->is_constant());
}

std::size_t scope_item(GeometryScope scope, const SurfaceRun& run, std::size_t face, std::size_t corner) {
    const std::array items{std::size_t{0}, face, static_cast<std::size_t>(run.face_points[corner]), corner};
    return items[index_of(scope)];
}

std::optional<ParameterSample> read_fitting(AlembicReader& reader, int object, const GeometryParameter& parameter,
                                            const SurfaceRun& run, double seconds, std::string_view name) {
    std::optional<ParameterSample> sample;
    try {
        sample = read_parameter(reader.archive, parameter, seconds);
    } catch (const InputError& error) {
        reader.warn(object, fmt::format("{} are left out: {}", name, error.reason()));
        return std::nullopt;
    }
    if (!std::ranges::all_of(sample->values, [](float value) { return std::isfinite(value); })) {
        reader.warn(object, fmt::format("{} are left out: not all values are finite", name));
        return std::nullopt;
    }
    const std::size_t expected = scope_count(parameter.scope, run);
    if (sample->count() == expected || (parameter.scope == GeometryScope::constant && sample->count() > 0))
        return sample;
    reader.warn(object,
                fmt::format("{} are left out: {} values where the surface has {}", name, sample->count(), expected));
    return std::nullopt;
}

}  // namespace aleph
