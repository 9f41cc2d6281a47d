#pragma once
// Pictures as bytes in memory: what the readers and writers of image_io are made of. Working in memory keeps every
// write to the disk in our own hands (HARD_CASES OU-05: libraries lose errors), and lets one check guard files and
// embedded textures alike.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image_file.h"

namespace aleph {

using ByteView = std::span<const std::uint8_t>;

enum class ImageFormat { exr, png, jpeg, hdr };

/// Pixels a picture may have; checked from its header, before anything is decoded.
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 28;

/// By the first bytes; nothing if the format is not one of ours.
std::optional<ImageFormat> detect_format(ByteView bytes);

/// Checks format and size from the header; PNG and JPEG come back without the parts that hold no pixels (colour
/// profiles, EXIF, text), whose parsers have known faults (a broken ICC profile in a JPEG ends this OpenImageIO).
/// @throws InputError (file = name)
std::vector<std::uint8_t> strip_png(ByteView bytes, const std::string& name);
std::vector<std::uint8_t> strip_jpeg(ByteView bytes, const std::string& name);

/// @throws InputError (file = name) if a picture of this size is refused
void check_size(std::int64_t width, std::int64_t height, const std::string& name);

/// @param threads  compressing threads; the bytes are the same for any number
/// @throws InputError (file empty) naming what is wrong with the picture
std::string encode_exr(const ChannelImage& image, int threads);

/// Channels in the file's order (by name), half and unsigned widened to float; text, number and fraction attributes.
/// @throws InputError (file = name)
ChannelImage decode_exr(ByteView bytes, const std::string& name);

/// What read_image does, on bytes. PNG and JPEG carry the metadata `encoding` = "sRGB".
/// @throws InputError (file = name)
ChannelImage decode_image(ByteView bytes, const std::string& name);

/// @throws InputError (file empty)
std::string encode_png(const Image<Rgb>& linear);

}  // namespace aleph
