#pragma once
// The four ways to ask a property for a value at a time: at the sample before, after or nearest, or between them.

#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

enum class Lookup {
    floor,         ///< the sample at or before the time; the first one before all samples
    ceil,          ///< the sample at or after the time; the last one after all samples
    near,          ///< the sample nearest in time, the earlier one in a tie
    interpolated,  ///< as the property says: tracks by their interpolation, points linearly
};

/// Where a look-up reads: `floor` and `ceil` are the same sample unless it interpolates between two.
SampleSpan look_up(const TimeSampling& sampling, std::size_t count, double seconds, Lookup lookup);

/// A track's value; cubic tracks give the value of the key. Same types as evaluate(track, seconds).
template <class T>
T evaluate(const Track<T>& track, double seconds, Lookup lookup) {
    if (lookup == Lookup::interpolated || track.key_count() <= 1) return evaluate(track, seconds);
    return key_value(track, look_up(track.sampling, track.key_count(), seconds, lookup).floor);
}

/// A cache's points, m. On a sample they are exactly the sample's; where neighbouring samples agree, exactly theirs.
std::vector<glm::dvec3> sample_points(const PointCache& cache, double seconds, Lookup lookup = Lookup::interpolated);

/// False only where sample_points gives the same points at every time.
bool is_animated(const PointCache& cache);

}  // namespace aleph
