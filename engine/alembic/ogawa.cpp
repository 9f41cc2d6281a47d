#include "engine/alembic/ogawa.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "engine/base/errors.h"

namespace aleph {
namespace {

constexpr std::uint64_t data_bit = std::uint64_t{1} << 63;
constexpr std::size_t header_size = 16;

}  // namespace

std::uint64_t decode_little_endian(std::span<const std::uint8_t> bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | bytes[i];
    return value;
}

void ReadBudget::charge(std::uint64_t count, std::uint64_t size) {
    if (size != 0 && count > left_ / size) {
        throw InputError(file_, "",
                         fmt::format("its content takes more than {} MiB of memory: too much for a file of its size, "
                                     "which is damaged or repeats the same data very often",
                                     limit_ >> 20));
    }
    left_ -= count * size;
}

OgawaFile::OgawaFile(std::vector<std::uint8_t> bytes, std::string file)
    : bytes_(std::move(bytes)), file_(std::move(file)) {
    const auto starts_with = [&](const char* magic, std::size_t length) {
        return bytes_.size() >= length && std::memcmp(bytes_.data(), magic, length) == 0;
    };
    if (starts_with("\x89HDF", 4)) {
        throw InputError(file_, "",
                         "this is an older Alembic archive in an HDF5 container, which is not read; write it again as "
                         "an Ogawa archive, the default since Alembic 1.5 (abcconvert -toOgawa)");
    }
    if (!starts_with("Ogawa", 5))
        throw InputError(file_, "", "this is not an Alembic archive: it does not begin with \"Ogawa\"");
    if (bytes_.size() < header_size) throw InputError(file_, "header", "the file ends inside its header");
    if (bytes_[5] != 0xff) {
        throw InputError(file_, "header", "the archive was never finished: its writer stopped before closing it");
    }
    if (const int version = bytes_[6] * 256 + bytes_[7]; version != 1) {  // the only field with its high byte first
        throw InputError(file_, "header", fmt::format("Ogawa version {} is not supported, only 1", version));
    }
    root_ = group_at(word(8));
}

void OgawaFile::fail(std::uint64_t offset, const std::string& reason) const {
    throw InputError(file_, fmt::format("byte {}", offset), reason);
}

std::uint64_t OgawaFile::word(std::uint64_t offset) const {
    if (offset > bytes_.size() || bytes_.size() - offset < 8) fail(offset, "lies outside the file");
    return decode_little_endian({bytes_.data() + offset, 8});
}

OgawaGroup OgawaFile::group_at(std::uint64_t offset) const {
    if (offset == 0) return {};
    if (offset & data_bit) fail(offset & ~data_bit, "a data block stands where a group is expected");
    const std::uint64_t size = word(offset);
    if (const std::uint64_t room = (bytes_.size() - offset - 8) / 8; size > room)
        fail(offset, fmt::format("a group claims {} children, the file has room for {}", size, room));
    return {offset, size};
}

std::uint64_t OgawaFile::child_word(const OgawaGroup& parent, std::uint64_t child) const {
    if (child >= parent.size)
        fail(parent.offset, fmt::format("child {} is missing: the group has {}", child, parent.size));
    return word(parent.offset + 8 + 8 * child);
}

bool OgawaFile::is_data(const OgawaGroup& parent, std::uint64_t child) const {
    return (child_word(parent, child) & data_bit) != 0;
}

OgawaGroup OgawaFile::group(const OgawaGroup& parent, std::uint64_t child) const {
    return group_at(child_word(parent, child));
}

OgawaData OgawaFile::data(const OgawaGroup& parent, std::uint64_t child) const {
    const std::uint64_t found = child_word(parent, child);
    const std::uint64_t offset = found & ~data_bit;
    if ((found & data_bit) == 0) fail(offset, "a group stands where a data block is expected");
    if (offset == 0) return {};
    const std::uint64_t size = word(offset);
    if (const std::uint64_t room = bytes_.size() - offset - 8; size > room)
        fail(offset, fmt::format("a data block claims {} bytes, the file has {} more", size, room));
    return {offset, {bytes_.data() + offset + 8, static_cast<std::size_t>(size)}};
}

std::span<const std::uint8_t> OgawaCursor::take(std::uint64_t length) {
    if (length > left()) fail(fmt::format("it ends inside a record: {} bytes claimed, {} left", length, left()));
    const auto taken = bytes_.subspan(position_, static_cast<std::size_t>(length));
    position_ += taken.size();
    return taken;
}

std::uint64_t OgawaCursor::take_unsigned(std::size_t width) {
    return decode_little_endian(take(width));
}

double OgawaCursor::take_double() {
    return std::bit_cast<double>(take_unsigned(8));
}

std::string OgawaCursor::take_text(std::uint64_t length) {
    const auto bytes = take(length);
    return {bytes.begin(), bytes.end()};
}

void OgawaCursor::fail(const std::string& reason) const {
    throw InputError(file_, what_, reason);
}

}  // namespace aleph
