#include "engine/alembic/archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr std::uint64_t hash_bytes = 32;        // hashes at the end of object headers
constexpr std::uint64_t inline_metadata = 255;  // the string stands in the header
constexpr double acyclic_period = 1e300;        // periods above it say that there is none
constexpr std::uint64_t min_budget = std::uint64_t{128} << 20;
constexpr std::uint64_t budget_per_byte = 32;

std::uint64_t budget_of(std::uint64_t file_size) {
    return std::max(min_budget, file_size * budget_per_byte);
}

std::string_view as_text(const OgawaData& data) {
    return {reinterpret_cast<const char*>(data.bytes.data()), data.bytes.size()};
}

AlembicMetadata parse_metadata(std::string_view text) {
    AlembicMetadata metadata;
    while (!text.empty()) {
        const std::string_view piece = text.substr(0, text.find(';'));
        text.remove_prefix(std::min(text.size(), piece.size() + 1));
        const std::size_t equals = piece.find('=');
        if (equals == std::string_view::npos) break;
        metadata.try_emplace(std::string(piece.substr(0, equals)), piece.substr(equals + 1));
    }
    return metadata;
}

}  // namespace

const std::string& metadata_value(const AlembicMetadata& metadata, std::string_view key) {
    static const std::string none;
    const auto found = metadata.find(key);
    return found == metadata.end() ? none : found->second;
}

const AlembicProperty* AlembicCompound::find(std::string_view name) const {
    const auto found = std::ranges::find(properties, name, &AlembicProperty::name);
    return found == properties.end() ? nullptr : &*found;
}

const AlembicProperty* AlembicCompound::find_sampled(std::string_view name) const {
    const AlembicProperty* found = find(name);
    return found != nullptr && found->sample_count > 0 ? found : nullptr;
}

std::string AlembicObject::schema() const {
    const std::string& title = metadata_value(metadata, "schemaObjTitle");
    const std::string& schema = metadata_value(metadata, "schema");
    const std::string& full = schema.empty() ? title : schema;
    return full.substr(0, full.find(':'));
}

AlembicArchive::AlembicArchive(std::vector<std::uint8_t> bytes, const std::string& file)
    : ogawa_(std::move(bytes), file), budget_(budget_of(ogawa_.size()), file) {
    const OgawaGroup root = ogawa_.root();
    if (root.size < 6)
        ogawa_.fail(root.offset, fmt::format("the root has {} children, an Alembic archive has 6", root.size));
    OgawaCursor layout(ogawa_.data(root, 0).bytes, file, "layout version");
    if (const std::uint64_t version = layout.take_unsigned(4); version != 0)
        layout.fail(fmt::format("version {} is not supported, only 0", version));
    OgawaCursor(ogawa_.data(root, 1).bytes, file, "library version").take_unsigned(4);
    const OgawaData text = ogawa_.data(root, 3), times = ogawa_.data(root, 4), table = ogawa_.data(root, 5);
    budget_.charge(text.bytes.size() + times.bytes.size() + table.bytes.size(), 4);
    metadata_ = parse_metadata(as_text(text));
    read_time_samplings(times);
    read_indexed_metadata(table);
    read_objects();
}

void AlembicArchive::fail(int object, const std::string& reason) const {
    throw InputError(file(), printable(path(object), 200), reason);
}

void AlembicArchive::fail(const AlembicProperty& property, const std::string& reason) const {
    throw InputError(file(), printable(property.name), reason);
}

void AlembicArchive::read_time_samplings(const OgawaData& table) {
    OgawaCursor cursor(table.bytes, file(), "time samplings");
    while (!cursor.at_end()) {
        const std::size_t number = time_samplings_.size();
        sample_maxima_.push_back(cursor.take_unsigned(4));
        TimeSampling sampling;
        sampling.period = cursor.take_double();
        const std::uint64_t count = cursor.take_unsigned(4);
        if (count == 0 || count > cursor.left() / 8)
            cursor.fail(fmt::format("sampling {} claims {} times, {} bytes are left", number, count, cursor.left()));
        for (std::uint64_t i = 0; i < count; ++i) sampling.times.push_back(cursor.take_double());
        for (std::size_t i = 0; i < count; ++i) {
            if (!std::isfinite(sampling.times[i]) || (i > 0 && !(sampling.times[i] > sampling.times[i - 1])))
                cursor.fail(fmt::format("sampling {}: time {} is {} s; times must be finite and increase", number, i,
                                        sampling.times[i]));
        }
        if (!(sampling.period > 0.0))
            cursor.fail(fmt::format("sampling {} has a period of {} s; it must be positive", number, sampling.period));
        if (sampling.period > acyclic_period) {
            sampling.kind = TimeSampling::Kind::acyclic;
            sampling.period = 1.0;
        } else if (count == 1) {
            sampling.start = sampling.times[0];
            sampling.times.clear();
        } else {
            sampling.kind = TimeSampling::Kind::cyclic;
            // Rounding may take a shutter of one whole frame a little beyond the frame.
            if (sampling.times.back() - sampling.times.front() > sampling.period * (1.0 + 1e-6))
                cursor.fail(
                    fmt::format("sampling {}: its times span more than the cycle of {} s", number, sampling.period));
        }
        time_samplings_.push_back(std::move(sampling));
    }
    if (time_samplings_.empty()) {
        time_samplings_.emplace_back();
        sample_maxima_.push_back(1);
    }
}

void AlembicArchive::read_indexed_metadata(const OgawaData& table) {
    indexed_metadata_.emplace_back();  // number 0 is not stored
    OgawaCursor cursor(table.bytes, file(), "metadata table");
    while (!cursor.at_end()) indexed_metadata_.push_back(parse_metadata(cursor.take_text(cursor.take_unsigned(1))));
}

AlembicMetadata AlembicArchive::take_metadata(OgawaCursor& cursor, std::uint64_t number, std::size_t width) const {
    if (number == inline_metadata) return parse_metadata(cursor.take_text(cursor.take_unsigned(width)));
    if (number >= indexed_metadata_.size())
        cursor.fail(fmt::format("metadata number {} is beyond the table's {}", number, indexed_metadata_.size() - 1));
    return indexed_metadata_[number];
}

std::string AlembicArchive::path(int object) const {
    std::vector<int> way;
    for (int i = object; i > 0; i = objects_[i].parent) way.push_back(i);
    std::string text;
    for (auto i = way.rbegin(); i != way.rend(); ++i) text += "/" + objects_[*i].name;
    return text.empty() ? "/" : text;
}

void AlembicArchive::read_objects() {
    AlembicObject root;
    root.group = ogawa_.group(ogawa_.root(), 2);
    objects_.push_back(std::move(root));

    // Depth first without recursion: objects whose children are still to be read, the next one last.
    struct Pending {
        int object;
        std::size_t depth;
    };
    std::vector<Pending> pending{{0, 0}};
    while (!pending.empty()) {
        const auto [parent, depth] = pending.back();
        pending.pop_back();
        const OgawaGroup group = objects_[parent].group;
        if (group.size == 0 || !ogawa_.is_data(group, group.size - 1)) continue;
        const OgawaData headers = ogawa_.data(group, group.size - 1);
        if (headers.bytes.size() <= hash_bytes) continue;
        if (depth >= max_alembic_depth) {
            fail(parent, fmt::format("objects are nested deeper than {}: the archive is damaged or refers to itself",
                                     max_alembic_depth));
        }
        budget_.charge(headers.bytes.size());
        OgawaCursor cursor(headers.bytes.first(headers.bytes.size() - hash_bytes), file(),
                           printable(path(parent), 200) + ": headers of its children");
        std::vector<int> children;
        while (!cursor.at_end()) {
            AlembicObject object;
            object.parent = parent;
            object.name = cursor.take_text(cursor.take_unsigned(4));
            if (object.name.empty()) cursor.fail("a child has no name");
            object.metadata = take_metadata(cursor, cursor.take_unsigned(1), 4);
            object.group = ogawa_.group(group, children.size() + 1);
            for (int i = parent; i >= 0; i = objects_[i].parent) {
                if (object.group.offset != 0 && objects_[i].group == object.group)
                    fail(parent, "an object contains itself");
            }
            if (objects_.size() >= max_alembic_objects)
                fail(parent, fmt::format("there are more than {} objects", max_alembic_objects));
            budget_.charge(1, sizeof(AlembicObject) + 64 * object.metadata.size());
            children.push_back(static_cast<int>(objects_.size()));
            objects_.push_back(std::move(object));
        }
        for (auto child = children.rbegin(); child != children.rend(); ++child) pending.push_back({*child, depth + 1});
        objects_[parent].children = std::move(children);
    }
}

AlembicCompound AlembicArchive::properties(int object) const {
    const OgawaGroup group = objects_[object].group;
    if (group.size == 0) return {};
    try {
        return read_properties(ogawa_.group(group, 0));
    } catch (const InputError& error) {
        fail(object, error.place().empty() ? error.reason() : error.place() + ": " + error.reason());
    }
}

AlembicCompound AlembicArchive::properties(const AlembicProperty& compound) const {
    if (compound.kind != AlembicProperty::Kind::compound) fail(compound, "it is one property, expected a compound");
    return read_properties(compound.group);
}

AlembicCompound AlembicArchive::properties(const AlembicCompound& compound, std::string_view name) const {
    const AlembicProperty* member = compound.find(name);
    return member == nullptr ? AlembicCompound{} : properties(*member);
}

AlembicCompound AlembicArchive::read_properties(const OgawaGroup& group) const {
    AlembicCompound compound;
    if (group.size == 0) return compound;
    const OgawaData headers = ogawa_.data(group, group.size - 1);
    budget_.charge(headers.bytes.size());
    OgawaCursor cursor(headers.bytes, file(), "property headers");
    while (!cursor.at_end()) {
        const std::uint64_t info = cursor.take_unsigned(4);
        const std::uint64_t kind = info & 3, hint = info >> 2 & 3, type = info >> 4 & 15;
        if (hint == 3) cursor.fail("a record has the size hint 3");
        const std::size_t width = std::size_t{1} << hint;
        AlembicProperty property;
        if (kind != 0) {
            property.kind = kind == 1 ? AlembicProperty::Kind::scalar : AlembicProperty::Kind::array;
            if (type > static_cast<std::uint64_t>(PlainType::wide_text))
                cursor.fail(fmt::format("a property has the unknown type {}", type));
            property.type = static_cast<PlainType>(type);
            property.extent = static_cast<std::uint32_t>(info >> 12 & 255);
            if (property.extent == 0) cursor.fail("a property has the extent 0");
            property.sample_count = cursor.take_unsigned(width);
            if (info & 0x200) {
                property.first_changed = cursor.take_unsigned(width);
                property.last_changed = cursor.take_unsigned(width);
            } else if (!(info & 0x800) && property.sample_count > 1) {
                property.first_changed = 1;
                property.last_changed = property.sample_count - 1;
            }
            if (property.first_changed > property.last_changed ||
                (property.first_changed == 0 && property.last_changed != 0) ||
                (property.last_changed != 0 && property.last_changed >= property.sample_count)) {
                cursor.fail(fmt::format("samples {} to {} of {} are said to change", property.first_changed,
                                        property.last_changed, property.sample_count));
            }
            if (info & 0x100) property.time_sampling = static_cast<std::size_t>(cursor.take_unsigned(width));
            if (property.time_sampling >= time_samplings_.size()) {
                cursor.fail(fmt::format("time sampling {} is asked for, there are {}", property.time_sampling,
                                        time_samplings_.size()));
            }
        }
        property.name = cursor.take_text(cursor.take_unsigned(width));
        if (property.name.empty()) cursor.fail("a property has no name");
        property.metadata = take_metadata(cursor, info >> 20 & 255, width);
        property.group = ogawa_.group(group, compound.properties.size());
        budget_.charge(1, sizeof(AlembicProperty) + 64 * property.metadata.size());
        compound.properties.push_back(std::move(property));
    }
    return compound;
}

}  // namespace aleph
