// When the samples of an archive's properties lie.

#include <fmt/format.h>

#include "engine/alembic/archive.h"
#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr double reached = 1e-5;  // s; a sample this near after a time counts as reached

}  // namespace

AlembicSamples AlembicArchive::samples(const AlembicProperty& property) const {
    AlembicSamples samples;
    const auto fail = [&](const std::string& reason) { throw InputError(file(), printable(property.name), reason); };
    if (property.sample_count == 0) return samples;
    if (property.is_constant()) {
        samples.indices = {0};
        return samples;
    }
    const TimeSampling& sampling = time_samplings_[property.time_sampling];
    const std::uint64_t begin = property.first_changed - 1, end = property.last_changed + 1;
    // A sample is one child of the group, or two for arrays: the header may claim more than there are.
    if (end - begin > property.group.size)
        fail(fmt::format("it claims {} samples and holds {}", end - begin, property.group.size));
    if (sampling.kind == TimeSampling::Kind::acyclic && sampling.times.size() < end)
        fail(fmt::format("{} samples but only {} times", end, sampling.times.size()));
    budget_.charge(end - begin, 16);

    const bool whole_shutter = sampling.kind == TimeSampling::Kind::cyclic &&
                               sampling.times.back() - sampling.times.front() >= sampling.period * (1.0 - 1e-6);
    if (sampling.kind == TimeSampling::Kind::uniform) {
        samples.sampling = sampling;
        samples.sampling.start = sample_time(sampling, begin);
        for (std::uint64_t i = begin; i < end; ++i) samples.indices.push_back(i);
    } else if (sampling.kind == TimeSampling::Kind::cyclic && begin == 0 && !whole_shutter) {
        samples.sampling = sampling;
        for (std::uint64_t i = begin; i < end; ++i) samples.indices.push_back(i);
    } else {
        // A shutter as long as the frame ends when the next one begins: the first of the two samples is kept.
        samples.sampling.kind = TimeSampling::Kind::acyclic;
        std::vector<double>& times = samples.sampling.times;
        for (std::uint64_t i = begin; i < end; ++i) {
            const double time = sample_time(sampling, i);
            if (whole_shutter && !times.empty() && time - times.back() < 1e-6 * sampling.period) continue;
            times.push_back(time);
            samples.indices.push_back(i);
        }
    }
    validate(samples.sampling, samples.indices.size(), file(), printable(property.name));
    return samples;
}

std::size_t alembic_floor(const TimeSampling& sampling, std::size_t count, double seconds) {
    std::size_t floor = find_samples(sampling, count, seconds).floor;
    const bool reaches_next = floor + 1 < count && seconds > sample_time(sampling, 0) &&
                              sample_time(sampling, floor + 1) - seconds <= reached;
    return reaches_next ? floor + 1 : floor;
}

}  // namespace aleph
