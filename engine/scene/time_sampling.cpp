#include "engine/scene/time_sampling.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr double snap_fraction = 1e-9;  // of the distance between two samples

[[noreturn]] void refuse_key(const std::string& file, const std::string& place, std::size_t key,
                             const std::string& reason) {
    throw InputError(file, place, fmt::format("key {}: {}", key, reason));
}

void validate_times(const std::vector<double>& times, std::size_t count, const std::string& file,
                    const std::string& place) {
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(times[i]))
            refuse_key(file, place, i, fmt::format("its time is {}; it must be finite", times[i]));
        if (i == 0 || times[i] > times[i - 1]) continue;
        const char* fault = times[i] == times[i - 1] ? "has the same time as" : "lies before";
        refuse_key(file, place, i,
                   fmt::format("its time {} s {} the key before it, {} s", times[i], fault, times[i - 1]));
    }
}

}  // namespace

double sample_time(const TimeSampling& sampling, std::size_t i) {
    switch (sampling.kind) {
        case TimeSampling::Kind::uniform:
            return sampling.start + static_cast<double>(i) * sampling.period;
        case TimeSampling::Kind::cyclic: {
            const std::size_t n = sampling.times.size();
            return sampling.times[i % n] + static_cast<double>(i / n) * sampling.period;
        }
        case TimeSampling::Kind::acyclic:
            break;
    }
    return sampling.times[i];
}

SampleSpan find_samples(const TimeSampling& sampling, std::size_t count, double seconds) {
    if (count <= 1) return {};
    std::size_t next = 0;  // the first sample after that time, found by halves: clang 14 cannot read std::views::iota
    for (std::size_t end = count; next < end;) {
        const std::size_t middle = next + (end - next) / 2;
        if (sample_time(sampling, middle) <= seconds) {
            next = middle + 1;
        } else {
            end = middle;
        }
    }
    if (next == 0) return {0, 0, 0.0};
    if (next == count) return {count - 1, count - 1, 0.0};

    // Times are subtracted before anything is divided, so that a late shot is as exact as an early one.
    const double before = sample_time(sampling, next - 1);
    const double gap = sample_time(sampling, next) - before;
    const double fraction = gap > 0.0 ? (seconds - before) / gap : 0.0;
    if (fraction <= snap_fraction) return {next - 1, next - 1, 0.0};
    if (fraction >= 1.0 - snap_fraction) return {next, next, 0.0};
    return {next - 1, next, fraction};
}

std::size_t nearest_sample(const TimeSampling& sampling, std::size_t count, double seconds) {
    const SampleSpan span = find_samples(sampling, count, seconds);
    return span.fraction > 0.5 + snap_fraction ? span.ceil : span.floor;
}

void validate(const TimeSampling& sampling, std::size_t count, const std::string& file, const std::string& place) {
    using Kind = TimeSampling::Kind;
    if (count == 0) throw InputError(file, place, "it has no keys");
    if (sampling.kind == Kind::uniform && !std::isfinite(sampling.start))
        throw InputError(file, place, fmt::format("its start time is {}; it must be finite", sampling.start));
    if (sampling.kind != Kind::acyclic && !(sampling.period > 0.0 && std::isfinite(sampling.period)))
        throw InputError(file, place, fmt::format("its period is {} s; it must be positive", sampling.period));

    if (sampling.kind == Kind::acyclic) {
        if (sampling.times.size() < count)
            throw InputError(file, place, fmt::format("{} keys but only {} times", count, sampling.times.size()));
        validate_times(sampling.times, count, file, place);
    } else if (sampling.kind == Kind::cyclic) {
        if (sampling.times.empty()) throw InputError(file, place, "its cycle has no times");
        validate_times(sampling.times, sampling.times.size(), file, place);
        if (!(sampling.times.back() - sampling.times.front() < sampling.period))
            throw InputError(file, place, fmt::format("its times span more than the cycle's {} s", sampling.period));
    }

    const double last = sample_time(sampling, count - 1);
    if (!std::isfinite(last) || !std::isfinite(last - sample_time(sampling, 0)))
        refuse_key(file, place, count - 1, "its time is too large");
    if (count > 1 && !(last > sample_time(sampling, count - 2)))
        refuse_key(file, place, count - 1, "its time cannot be told from the key before it");
}

}  // namespace aleph
