#pragma once
// When the samples of a property lie, in seconds. Alembic's model: uniform, cyclic or acyclic.

#include <cstddef>
#include <string>
#include <vector>

namespace aleph {

struct TimeSampling {
    enum class Kind {
        uniform,  ///< sample i at start + i * period
        cyclic,   ///< `times` within a cycle of `period`, repeated: times[i % n] + (i / n) * period
        acyclic,  ///< sample i at times[i]
    };
    Kind kind = Kind::uniform;
    double start = 0.0;         ///< s; uniform only
    double period = 1.0;        ///< s; uniform and cyclic
    std::vector<double> times;  ///< s, strictly increasing; cyclic and acyclic

    bool operator==(const TimeSampling&) const = default;
};

/// Where a time falls among samples: between `floor` and `ceil`, `fraction` of the way (0 where they are equal).
struct SampleSpan {
    std::size_t floor = 0;
    std::size_t ceil = 0;
    double fraction = 0.0;
};

/// Time of sample i, s.
double sample_time(const TimeSampling& sampling, std::size_t i);

/// The samples around a time. Times before the first (and NaN) and after the last sample hold. A time on one, or within
/// a relative 1e-9 of one frame of it (exported times carry float noise), is that sample.
/// @param count  samples that the property has; at least 1
SampleSpan find_samples(const TimeSampling& sampling, std::size_t count, double seconds);

/// The sample nearest in time; the earlier one in a tie.
std::size_t nearest_sample(const TimeSampling& sampling, std::size_t count, double seconds);

/// @throws InputError (place as given) where `count` samples cannot lie under this sampling: times not finite or not
/// strictly increasing, period not positive, too few times.
void validate(const TimeSampling& sampling, std::size_t count, const std::string& file, const std::string& place);

}  // namespace aleph
