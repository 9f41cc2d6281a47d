#include <OpenEXR/ImfAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "engine/base/errors.h"
#include "engine/image/exr_stream.h"

namespace aleph {

namespace {

/// Takes the next bytes off the front.
ByteView take(ByteView& left, std::size_t count) {
    if (count > left.size()) throw std::runtime_error("the file is cut");
    const ByteView taken = left.first(count);
    left = left.subspan(count);
    return taken;
}

std::string take_text(ByteView& left) {
    const auto end = std::find(left.begin(), left.end(), std::uint8_t{0});
    const ByteView text = take(left, static_cast<std::size_t>(end - left.begin()));
    take(left, 1);
    return {text.begin(), text.end()};
}

/// The value's bytes, of an attribute of any type.
ByteView take_value(ByteView& left) {
    std::int32_t size = 0;
    std::memcpy(&size, take(left, sizeof size).data(), sizeof size);
    if (size < 0 || static_cast<std::size_t>(size) > left.size()) throw std::runtime_error("is longer than the file");
    return take(left, static_cast<std::size_t>(size));
}

/// Types that OpenEXR does not know are bytes, as many as the size says.
void check_value(const std::string& type, ByteView value) {
    if (!Imf::Attribute::knownType(type.c_str())) return;
    const std::unique_ptr<Imf::Attribute> attribute(Imf::Attribute::newAttribute(type.c_str()));
    MemoryInput stream(value);
    attribute->readValueFrom(stream, static_cast<int>(value.size()), Imf::EXR_VERSION);
    if (stream.tellg() != value.size()) throw std::runtime_error(fmt::format("is longer than its {}", printable(type)));
}

}  // namespace

void check_exr_header(ByteView bytes, const std::string& name) {
    Imf::staticInitialize();
    std::string place;
    try {
        take(bytes, 8);  // magic number and version
        for (std::string attribute = take_text(bytes); !attribute.empty(); attribute = take_text(bytes)) {
            const std::string type = take_text(bytes);
            place = fmt::format("attribute '{}'", printable(attribute));
            check_value(type, take_value(bytes));
            place.clear();
        }
    } catch (const std::exception& e) {
        throw InputError(name, place, printable(e.what(), 400));
    }
}

}  // namespace aleph
