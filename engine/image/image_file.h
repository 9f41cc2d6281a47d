#pragma once
// Pictures in files: named channels and metadata, written whole or not at all.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/atomic_file.h"
#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph {

struct Channel {
    std::string name;  ///< "R", "forward.u", "aleph.Y"
    Image<float> values;
};

/// Text, a number, or a fraction (numerator, denominator) such as framesPerSecond.
using MetadataValue = std::variant<std::string, double, std::array<int, 2>>;

struct ChannelImage {
    std::vector<Channel> channels;  ///< all of one size
    std::map<std::string, MetadataValue> metadata;

    const Image<float>* find(const std::string& name) const;  ///< null if there is none
};

/// Writes 32-bit float channels, ZIP, one part, Rec.709 chromaticities, no date, no host: equal data gives equal bytes.
/// Goes to a hidden temporary name beside the target, is read back in size, then renamed.
/// @throws OutputError naming the file
void write_exr(const std::filesystem::path& path, const ChannelImage& image);

/// Writes 8-bit sRGB: clamped to [0,1], NaN as 0, rounded (HARD_CASES OU-04). Written whole or not at all.
void write_png(const std::filesystem::path& path, const Image<Rgb>& linear);

/// Reads every channel of a picture as float; 8-bit colour channels stay encoded as they are (0..1). Formats by an
/// allow-list (EXR, PNG, JPEG, HDR) checked against the file's first bytes, size checked before decoding; multi-part
/// and deep EXR are refused.
/// @throws InputError
ChannelImage read_image(const std::filesystem::path& path);

/// A texture from memory or from a file. One of the two images of the pair is filled: 8 bits for PNG and JPEG, float
/// else.
struct DecodedTexture {
    Image<std::array<std::uint8_t, 4>> bytes;
    Image<std::array<float, 4>> floats;
};

/// @param name  what messages call it
/// @throws InputError (file = name) if the bytes are not one of the allowed formats or do not decode
DecodedTexture decode_texture(const std::vector<std::uint8_t>& encoded, const std::string& name);

}  // namespace aleph
