// Samples of an archive's properties: when they lie, where they are stored, and their values.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <type_traits>

#include "engine/alembic/archive.h"
#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr std::size_t digest_bytes = 16;  // before the values of every sample
constexpr std::uint64_t max_rank = 64;    // dimensions of one array

/// Bytes of one plain value, in the order of PlainType; text has none.
constexpr std::array<std::size_t, 14> widths{1, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8, 0, 0};

std::size_t width_of(PlainType type) {
    return widths[static_cast<std::size_t>(type)];
}

template <class T>
T decode_number(PlainType type, const std::uint8_t* bytes) {
    const std::uint64_t bits = decode_little_endian({bytes, width_of(type)});
    switch (type) {
        case PlainType::boolean:
            return bits != 0;
        case PlainType::i8:
            return static_cast<T>(static_cast<std::int8_t>(bits));
        case PlainType::i16:
            return static_cast<T>(static_cast<std::int16_t>(bits));
        case PlainType::i32:
            return static_cast<T>(static_cast<std::int32_t>(bits));
        case PlainType::i64:
            return static_cast<T>(static_cast<std::int64_t>(bits));
        case PlainType::f16:
            return static_cast<T>(glm::unpackHalf1x16(static_cast<std::uint16_t>(bits)));
        case PlainType::f32:
            return static_cast<T>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        case PlainType::f64:
            if constexpr (std::is_same_v<T, float>) {  // beyond its range is undefined
                const double value = std::bit_cast<double>(bits), most = std::numeric_limits<float>::max();
                return static_cast<float>(std::isnan(value) ? value : std::clamp(value, -most, most));
            } else {
                return static_cast<T>(std::bit_cast<double>(bits));
            }
        default:
            return static_cast<T>(bits);
    }
}

bool is_text(PlainType type) {
    return width_of(type) == 0;
}

/// Position among the stored samples, of which there is at least one.
std::uint64_t slot_of(const AlembicProperty& property, std::uint64_t sample) {
    const std::uint64_t i = std::min(sample, property.sample_count - 1);
    const std::uint64_t first = property.first_changed, last = property.last_changed;
    if (i < first || (first == 0 && last == 0)) return 0;
    return i >= last ? last - first + 1 : i - first + 1;
}

}  // namespace

AlembicSamples AlembicArchive::samples(const AlembicProperty& property) const {
    AlembicSamples samples;
    if (property.sample_count == 0) return samples;
    if (property.is_constant()) {
        samples.indices = {0};
        return samples;
    }
    const TimeSampling& sampling = time_samplings_[property.time_sampling];
    const std::uint64_t begin = property.first_changed - 1, end = property.last_changed + 1;
    // A sample is one child of the group, or two for arrays: the header may claim more than there are.
    if (end - begin > property.group.size)
        fail(property, fmt::format("it claims {} samples and holds {}", end - begin, property.group.size));
    if (sampling.kind == TimeSampling::Kind::acyclic && sampling.times.size() < end)
        fail(property, fmt::format("{} samples but only {} times", end, sampling.times.size()));
    budget_.charge(end - begin, 16);

    const bool whole_shutter = sampling.kind == TimeSampling::Kind::cyclic &&
                               sampling.times.back() - sampling.times.front() >= sampling.period * (1.0 - 1e-6);
    const bool is_uniform = sampling.kind == TimeSampling::Kind::uniform;
    if (is_uniform || (sampling.kind == TimeSampling::Kind::cyclic && begin == 0 && !whole_shutter)) {
        samples.sampling = sampling;
        if (is_uniform) samples.sampling.start = sample_time(sampling, begin);
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
                              sample_time(sampling, floor + 1) - seconds <= same_time;
    return reaches_next ? floor + 1 : floor;
}

OgawaData AlembicArchive::sample_data(const AlembicProperty& property, std::uint64_t sample) const {
    if (property.kind == AlembicProperty::Kind::compound) fail(property, "it is a compound without values");
    if (property.sample_count == 0) fail(property, "it has no samples");
    const std::uint64_t slot = slot_of(property, sample);
    const bool array = property.kind == AlembicProperty::Kind::array;
    const std::uint64_t child = array ? 2 * slot : slot;
    if (slot > property.group.size || child >= property.group.size)
        fail(property, fmt::format("sample {} is missing from the file", sample));
    OgawaData data = ogawa_.data(property.group, child);
    if (data.bytes.empty() && array) return data;
    if (data.bytes.size() < digest_bytes)
        fail(property, fmt::format("sample {} has {} bytes, too few", sample, data.bytes.size()));
    data.bytes = data.bytes.subspan(digest_bytes);
    if (const std::size_t value = width_of(property.type); value != 0 && !array) {
        if (data.bytes.size() != property.extent * value) {
            fail(property, fmt::format("sample {} has {} bytes, expected {}", sample, data.bytes.size(),
                                       property.extent * value));
        }
    }
    return data;
}

std::uint64_t AlembicArchive::storage(const AlembicProperty& property, std::uint64_t sample) const {
    return sample_data(property, sample).offset;
}

std::vector<std::uint64_t> AlembicArchive::dimensions(const AlembicProperty& property, std::uint64_t sample) const {
    const OgawaData data = sample_data(property, sample);
    if (property.kind != AlembicProperty::Kind::array) return {1};
    std::vector<std::uint64_t> sizes;
    const OgawaData table = ogawa_.data(property.group, 2 * slot_of(property, sample) + 1);
    if (table.bytes.size() / 8 > max_rank)
        fail(property, fmt::format("an array of {} dimensions", table.bytes.size() / 8));
    OgawaCursor cursor(table.bytes, file(), printable(property.name) + ": dimensions");
    while (!cursor.at_end()) sizes.push_back(cursor.take_unsigned(8));

    // Text needs what the table says: its values have no fixed size. For numbers the data decides.
    std::uint64_t product = 1;
    bool fits = !sizes.empty();
    const std::uint64_t most = data.bytes.size();  // each value takes a byte at least
    for (const std::uint64_t size : sizes) {
        if (size != 0 && product > most / size) fits = false;
        product = fits ? product * size : 0;
    }
    if (is_text(property.type)) {
        if (!fits && !sizes.empty())
            fail(property, fmt::format("sample {} claims more text than it has bytes", sample));
        return sizes.empty() ? std::vector<std::uint64_t>{0} : sizes;
    }
    const std::uint64_t stored = data.bytes.size() / (width_of(property.type) * property.extent);
    return fits && product == stored ? sizes : std::vector<std::uint64_t>{stored};
}

template <class T>
std::vector<T> AlembicArchive::numbers(const AlembicProperty& property, std::uint64_t sample) const {
    if (is_text(property.type)) fail(property, "it holds text, expected numbers");
    if (std::is_integral_v<T> && is_real(property.type)) fail(property, "expected whole numbers");
    const OgawaData data = sample_data(property, sample);
    const std::size_t width = width_of(property.type);
    const std::size_t elements = data.bytes.size() / (width * property.extent);  // whole ones
    const std::size_t count = elements * property.extent;
    budget_.charge(count, sizeof(T));
    std::vector<T> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        values.push_back(decode_number<T>(property.type, data.bytes.data() + i * width));
    return values;
}

template std::vector<float> AlembicArchive::numbers(const AlembicProperty&, std::uint64_t) const;
template std::vector<double> AlembicArchive::numbers(const AlembicProperty&, std::uint64_t) const;
template std::vector<int> AlembicArchive::numbers(const AlembicProperty&, std::uint64_t) const;

std::vector<std::string> AlembicArchive::texts(const AlembicProperty& property, std::uint64_t sample) const {
    if (property.type != PlainType::text) fail(property, "it does not hold text of single bytes");
    const OgawaData data = sample_data(property, sample);
    std::uint64_t count = property.extent;
    for (const std::uint64_t size : dimensions(property, sample)) count *= size;
    if (count > data.bytes.size())  // each ends with a zero
        fail(property, fmt::format("sample {} claims {} texts in {} bytes", sample, count, data.bytes.size()));
    budget_.charge(count, sizeof(std::string));
    budget_.charge(data.bytes.size());
    std::vector<std::string> texts;
    texts.reserve(count);
    auto position = data.bytes.begin();
    while (texts.size() < count) {
        const auto end = std::find(position, data.bytes.end(), 0);
        if (end == data.bytes.end()) fail(property, fmt::format("sample {}: a text does not end", sample));
        texts.emplace_back(position, end);
        position = end + 1;
    }
    return texts;
}

}  // namespace aleph
