#pragma once
// Image files: named channels and metadata. Files are written whole or not at all.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/gtc/type_precision.hpp>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/atomic_file.h"
#include "engine/base/color.h"
#include "engine/base/picture_area.h"

namespace aleph {

struct Channel {
    std::string name;  ///< "R", "forward.u", "aleph.Y"
    Image<float> values;
};

/// Row by row, for row vectors, as OpenEXR stores it (m44f).
using Matrix44f = std::array<float, 16>;

/// Text, a number, a fraction (numerator, denominator) such as framesPerSecond, or a matrix.
using MetadataValue = std::variant<std::string, double, std::array<int, 2>, Matrix44f>;

struct ChannelImage {
    std::vector<Channel> channels;  ///< all of one size
    std::map<std::string, MetadataValue> metadata;
    /// The whole picture that this is a part of, relative to the first pixel (EXR: display and data window); nothing:
    /// this is all of it.
    std::optional<PictureArea> whole{};

    const Image<float>* find(const std::string& name) const;  ///< null if there is none
};

/// Writes 32-bit float channels, ZIP, one part, Rec.709 chromaticities; no date and no host, so that equal data gives
/// equal bytes.
/// @throws OutputError naming the file
void write_exr(const std::filesystem::path& path, const ChannelImage& image);

/// Text beside the pixels of PNG files, by key: ASCII, one line each, keys of at most 79 bytes.
using PictureTexts = std::map<std::string, std::string>;

/// Writes 8-bit sRGB: clamped to [0,1], NaN as 0, rounded.
/// @param texts  tEXt chunks
/// @throws OutputError naming the file
void write_png(const std::filesystem::path& path, const Image<Rgb>& linear, const PictureTexts& texts = {});

/// Writes 8-bit sRGB, as write_png does. @param quality  1 to 100
/// @throws OutputError naming the file
void write_jpeg(const std::filesystem::path& path, const Image<Rgb>& linear, int quality);

/// Returns the text with this key of an EXR file (an attribute) or PNG file. Nothing where there is no such file,
/// no such text, or where the file is cut; decodes no more of an EXR file than its last rows.
std::optional<std::string> read_picture_text(const std::filesystem::path& path, const std::string& key);

/// Reads every channel as float; 8-bit channels are divided by 255 and stay sRGB encoded. EXR, PNG, JPEG and HDR are
/// recognized by the file's first bytes. The size is checked before decoding. Multi-part and deep EXR are refused.
/// @throws InputError
ChannelImage read_image(const std::filesystem::path& path);

/// Returns whether read_image reads the file: no part of it is damaged.
bool can_read_image(const std::filesystem::path& path);

/// One of the two images is filled: `bytes` for PNG and JPEG, else `floats`. R, G, B, A; colours of an EXR are times A.
struct DecodedTexture {
    Image<glm::u8vec4> bytes;
    Image<glm::vec4> floats;
};

/// @param name  of the texture in messages
/// @throws InputError (file = name) if the bytes are of another format or do not decode
DecodedTexture decode_texture(const std::vector<std::uint8_t>& encoded, const std::string& name);

}  // namespace aleph
