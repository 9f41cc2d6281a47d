#pragma once
// Light that passes between the records of a cache: from where each of their gather rays finds irradiance of further
// bounces. It is a sparse linear map, applied once for each bounce.
//
// The irradiance at a ray's hit comes from the records around, by the weights of their interpolation. Where no record
// reaches (gap_reach), one random ray gathers it, which finds light in the same way. So every bounce counts once,
// wherever light goes.

#include <vector>

#include "render/cache/indirect_context.h"

namespace aleph {

/// Irradiance of `bounces` bounces in place of that of one.
/// @param context   of the records' gathers, which noted light of further bounces (MultiBounceLight::noted)
/// @param accuracy  alpha of look-ups
/// @param gathered  of each record (FillPlaces::gathered)
/// @param bounces   at least 2
/// @param counts    increased by the rays cast
/// @return the records of the cache with this irradiance and its gradients
std::vector<IrradianceRecord> add_bounces(const IndirectContext& context, const IrradianceCache& cache, float accuracy,
                                          std::vector<KeptRays> gathered, int bounces, RayCounts& counts);

}  // namespace aleph
