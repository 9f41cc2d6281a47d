#include "engine/alembic/alembic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/alembic/reader.h"
#include "engine/base/errors.h"
#include "engine/base/files.h"

namespace aleph {

constexpr std::size_t max_warnings = 100;  // of different texts

AlembicReader::AlembicReader(const AlembicArchive& source) : archive(source) {
    for (std::size_t i = 1; i < archive.objects().size(); ++i) {
        const AlembicObject& object = archive.objects()[i];
        child_of.try_emplace({object.parent, object.name}, static_cast<int>(i));
    }
}

void AlembicReader::warn(int object, const std::string& text) {
    const auto known = std::ranges::find(warnings_, text, &Warning::text);
    if (known != warnings_.end()) {
        ++known->count;
    } else if (warnings_.size() < max_warnings) {
        warnings_.push_back({text, printable(archive.path(object), 200), 1});
    } else {
        ++left_out_;
    }
}

std::vector<std::string> AlembicReader::list_warnings() const {
    std::vector<std::string> warnings;
    for (const auto& [text, place, count] : warnings_) {
        warnings.push_back(fmt::format("{}: {}{}: {}", archive.file(), place,
                                       count > 1 ? fmt::format(" and {} more", count - 1) : "", text));
    }
    if (left_out_ > 0) warnings.push_back(fmt::format("{}: and {} more warnings", archive.file(), left_out_));
    return warnings;
}

void AlembicReader::widen(const AlembicProperty& property) {
    if (property.is_constant()) return;
    const TimeSampling& sampling = archive.time_samplings()[property.time_sampling];
    std::uint64_t end = property.sample_count - 1;
    if (sampling.kind == TimeSampling::Kind::acyclic) end = std::min<std::uint64_t>(end, sampling.times.size() - 1);
    first = std::min(first, sample_time(sampling, 0));
    last = std::max(last, sample_time(sampling, end));
}

namespace {

constexpr double rate_tolerance = 1e-5;  // relative; 24 and 23.976 differ by 1e-3

/// Rates in use, as fractions, then any whole number.
std::optional<FrameRate> name_rate(double per_second) {
    constexpr std::array<FrameRate, 5> fractions{{{24000, 1001}, {30000, 1001}, {48000, 1001}, {60000, 1001}, {25, 2}}};
    if (!(per_second >= 1.0 && per_second <= 10000.0)) return std::nullopt;
    const auto is_near = [&](double rate) { return std::abs(per_second - rate) <= rate_tolerance * rate; };
    if (const double whole = std::round(per_second); is_near(whole))
        return FrameRate{static_cast<std::int64_t>(whole), 1};
    for (const FrameRate& rate : fractions)
        if (is_near(rate.per_second())) return rate;
    return std::nullopt;
}

/// The distance of a sampling's samples or cycles; 0 where it is not the same everywhere.
double period_of(const TimeSampling& sampling) {
    if (sampling.kind != TimeSampling::Kind::acyclic) return sampling.period;
    if (sampling.times.size() < 2) return 0.0;
    const double mean =
        (sampling.times.back() - sampling.times.front()) / static_cast<double>(sampling.times.size() - 1);
    for (std::size_t i = 1; i < sampling.times.size(); ++i)
        if (std::abs(sampling.times[i] - sampling.times[i - 1] - mean) > 1e-4 * mean) return 0.0;
    return mean;
}

/// From the sampling with the most samples whose distance is a frame of a rate in use, else from the metadata.
std::optional<FrameRate> find_frame_rate(const AlembicArchive& archive) {
    std::optional<FrameRate> best;
    std::uint64_t most = 1;
    for (std::size_t i = 1; i < archive.time_samplings().size(); ++i) {
        const double period = period_of(archive.time_samplings()[i]);
        const auto rate = period > 0.0 ? name_rate(1.0 / period) : std::nullopt;
        if (!rate || archive.sample_maxima()[i] <= most) continue;
        best = rate;
        most = archive.sample_maxima()[i];
    }
    if (best) return best;
    const std::string& said = metadata_value(archive.metadata(), "FramesPerTimeUnit");
    double rate = 0.0;
    std::from_chars(said.data(), said.data() + said.size(), rate);
    return name_rate(rate);
}

}  // namespace

FileTiming append_alembic(const std::filesystem::path& path, Scene& scene, int parent_node, int include_index) {
    const std::string file = path.string();
    const AlembicArchive archive(read_regular_file(path, file, ""), file);
    AlembicReader reader(archive);
    reader.part.source.file = file;
    try {
        read_objects(reader);
    } catch (const std::bad_alloc&) {
        throw InputError(file, "", "there is not enough memory for what the archive holds");
    }
    FileTiming timing;
    timing.frame_rate = find_frame_rate(archive);
    if (reader.first <= reader.last) {
        timing.first = reader.first;
        timing.last = reader.last;
    }
    for (std::string& warning : reader.list_warnings()) reader.part.source.warnings.push_back(std::move(warning));
    append_part(scene, std::move(reader.part), parent_node, include_index);
    return timing;
}

}  // namespace aleph
