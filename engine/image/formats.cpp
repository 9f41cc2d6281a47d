// Checks before decoding: format, size, the header of EXR files, and the parts of PNG and JPEG files that a decoder may
// read.

#include <OpenEXR/ImfAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfVersion.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/image/exr_stream.h"

namespace aleph {

namespace {

bool starts_with(ByteView bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char m, std::uint8_t b) { return static_cast<std::uint8_t>(m) == b; });
}

std::uint32_t big_endian(ByteView bytes, std::size_t at, int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
    return value;
}

constexpr std::string_view png_magic("\x89PNG\r\n\x1a\n", 8);

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

std::optional<ImageFormat> detect_format(ByteView bytes) {
    if (starts_with(bytes, "\x76\x2f\x31\x01")) return ImageFormat::exr;
    if (starts_with(bytes, png_magic)) return ImageFormat::png;
    if (starts_with(bytes, "\xff\xd8\xff")) return ImageFormat::jpeg;
    if (starts_with(bytes, "#?RADIANCE") || starts_with(bytes, "#?RGBE")) return ImageFormat::hdr;
    return std::nullopt;
}

void check_size(std::int64_t width, std::int64_t height, const std::string& name) {
    if (width <= 0 || height <= 0) {
        throw InputError(name, "", fmt::format("the picture is empty ({}x{})", width, height));
    }
    if (static_cast<std::uint64_t>(width) > max_pixels / static_cast<std::uint64_t>(height)) {
        throw InputError(name, "",
                         fmt::format("the picture is too large ({}x{}; at most {} pixels)", width, height, max_pixels));
    }
}

std::vector<std::uint8_t> strip_png(ByteView bytes, const std::string& name) {
    // Chunks (PNG 1.2, section 3.2): length, type, data, CRC. An upper-case first letter marks those needed for pixels;
    // tRNS is the one other chunk that changes them.
    std::vector<std::uint8_t> kept(bytes.begin(), bytes.begin() + png_magic.size());
    kept.reserve(bytes.size());
    bool has_pixels = false;
    for (std::size_t at = png_magic.size(); at < bytes.size();) {
        if (bytes.size() - at < 12) throw InputError(name, "", "the PNG ends inside a chunk");
        const std::size_t length = big_endian(bytes, at, 4);
        if (length > bytes.size() - at - 12) throw InputError(name, "", "the PNG ends inside a chunk");
        const std::string_view type(reinterpret_cast<const char*>(bytes.data()) + at + 4, 4);
        if (at == png_magic.size()) {
            if (type != "IHDR" || length != 13) throw InputError(name, "", "the PNG does not start with its header");
            check_size(big_endian(bytes, at + 8, 4), big_endian(bytes, at + 12, 4), name);
        }
        const auto chunk = bytes.subspan(at, length + 12);
        if ((type[0] >= 'A' && type[0] <= 'Z') || type == "tRNS") {
            // libpng would print this fault.
            const auto checksum = crc32(0, chunk.data() + 4, static_cast<uInt>(length + 4));
            if (checksum != big_endian(chunk, length + 8, 4)) {
                throw InputError(name, "", fmt::format("the PNG is damaged (wrong checksum in {})", printable(type)));
            }
            kept.insert(kept.end(), chunk.begin(), chunk.end());
        }
        at += chunk.size();
        has_pixels = has_pixels || type == "IDAT";
        if (type == "IEND" && !has_pixels) throw InputError(name, "", "the PNG holds no pixels");
        if (type == "IEND") return kept;
    }
    throw InputError(name, "", "the PNG has no end: the file is cut");
}

std::optional<std::string> find_png_text(ByteView bytes, const std::string& key) {
    strip_png(bytes, "");  // the file is whole
    for (std::size_t at = png_magic.size(); at < bytes.size();) {
        const std::size_t length = big_endian(bytes, at, 4);
        const std::string_view chunk(reinterpret_cast<const char*>(bytes.data()) + at + 4, length + 4);
        if (chunk == "IEND") break;
        if (chunk.starts_with("tEXt" + key + '\0')) return std::string(chunk.substr(4 + key.size() + 1));
        at += length + 12;
    }
    return std::nullopt;
}

std::vector<std::uint8_t> strip_jpeg(ByteView bytes, const std::string& name) {
    // Segments (ITU-T T.81, annex B): 0xff, marker, length of two bytes that counts itself, data.
    std::vector<std::uint8_t> kept(bytes.begin(), bytes.begin() + 2);
    kept.reserve(bytes.size());
    bool has_size = false;
    for (std::size_t at = 2; bytes.size() - at >= 4;) {
        if (bytes[at] != 0xff) break;
        const std::uint8_t marker = bytes[at + 1];
        if (marker == 0xff) {  // fill byte
            ++at;
            continue;
        }
        const std::size_t length = big_endian(bytes, at + 2, 2);
        if (length < 2 || length > bytes.size() - at - 2) break;
        const bool starts_frame =
            marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (starts_frame) {
            if (length < 8) break;
            check_size(big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2), name);
            has_size = true;
        }
        if (marker == 0xda) {  // start of scan: pixels follow
            if (!has_size) break;
            kept.insert(kept.end(), bytes.begin() + at, bytes.end());
            return kept;
        }
        // Application data other than APP0 (JFIF) and APP14 (Adobe: the colour transform) is dropped, and comments.
        const bool application = marker >= 0xe1 && marker <= 0xef && marker != 0xee;
        const auto segment = bytes.subspan(at, length + 2);
        if (!application && marker != 0xfe) kept.insert(kept.end(), segment.begin(), segment.end());
        at += segment.size();
    }
    throw InputError(name, "", "the JPEG is damaged before its first pixel");
}

void check_hdr_order(ByteView bytes, const std::string& name) {
    // An empty line ends the header. The next one names the axes, the slower first, and the signs of their directions:
    // -Y is down.
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t empty = text.find("\n\n");
    if (empty == std::string_view::npos) return;  // the decoder refuses it
    const std::string_view rest = text.substr(empty + 2), line = rest.substr(0, rest.find('\n'));
    if (line.starts_with("-Y ") && line.find(" +X ") != std::string_view::npos) return;
    throw InputError(name, "",
                     fmt::format("its pixels are in the order \"{}\"; rows from the top left (-Y, +X) can be read",
                                 printable(std::string(line), 40)));
}

std::array<double, 3> read_hdr_factors(ByteView bytes) {
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    text = text.substr(0, text.find("\n\n"));
    std::array<double, 3> factors{1.0, 1.0, 1.0};
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        const bool is_exposure = line.starts_with("EXPOSURE=");
        if (!is_exposure && !line.starts_with("COLORCORR=")) continue;
        std::array<double, 3> found{};
        const char *at = line.data() + line.find('=') + 1, *const end = line.data() + line.size();
        for (double& number : found) {
            at = std::find_if(at, end, [](char c) { return c != ' ' && c != '\t'; });
            at = std::from_chars(at, end, number).ptr;
        }
        if (is_exposure) found[1] = found[2] = found[0];
        if (!std::ranges::all_of(found, [](double f) { return f > 0.0 && std::isfinite(f); })) continue;
        for (std::size_t c = 0; c < 3; ++c) factors[c] *= found[c];
    }
    return factors;
}

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
