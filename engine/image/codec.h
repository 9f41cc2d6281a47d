#pragma once
// Encoders and decoders of image files, from and to bytes in memory. Files are written by engine/base/atomic_file.h,
// since the libraries lose write errors; files and embedded textures pass the same checks.

#include <array>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/image/image_file.h"

namespace aleph {

using ByteView = std::span<const std::uint8_t>;

enum class ImageFormat { exr, png, jpeg, hdr };

/// Most pixels of an image; checked in its header, before decoding.
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 28;

/// Format by the first bytes; nothing if it is another one.
std::optional<ImageFormat> detect_format(ByteView bytes);

// Check structure and size, and return the file without the parts that hold no pixels (colour profiles, EXIF, text):
// their parsers have known faults (a broken ICC profile in a JPEG crashes OpenImageIO 2.4).
// @throws InputError (file = name)
std::vector<std::uint8_t> strip_png(ByteView bytes, const std::string& name);
std::vector<std::uint8_t> strip_jpeg(ByteView bytes, const std::string& name);

/// @throws InputError if the resolution line of an HDR file has its pixels in another order than from the top left, row
/// by row: OpenImageIO reads them as if they were
void check_hdr_order(ByteView bytes, const std::string& name);

/// The factors that the radiances of an HDR file were multiplied by, of red, green and blue: the product of all lines
/// EXPOSURE= and COLORCORR= of its header (Ward, Radiance File Formats). Lines of anything but numbers above 0 tell
/// nothing: some programs write EXPOSURE=0.
std::array<double, 3> read_hdr_factors(ByteView bytes);

/// Reads each attribute of an EXR file's header alone: it has to lie within the file, and to end where its size says.
/// Imf::InputFile takes the memory that an attribute names before it reads it, and goes on where a value ends, whatever
/// its size: a file of 4 KB could ask for 2 GB.
/// @throws InputError
void check_exr_header(ByteView bytes, const std::string& name);

/// @throws InputError (file = name) if the image is empty or has more than max_pixels
void check_size(std::int64_t width, std::int64_t height, const std::string& name);

/// @param threads  compressing threads; the bytes are the same for any number
/// @throws InputError (file empty) with the fault of the image
std::string encode_exr(const ChannelImage& image, int threads);

/// Channels in the order of the file (by name), half and unsigned as float; text, number and fraction attributes.
/// @throws InputError (file = name)
ChannelImage decode_exr(ByteView bytes, const std::string& name);

/// Returns the text attribute `key` of a file whose last rows can be read.
/// @throws InputError
std::optional<std::string> find_exr_text(const std::filesystem::path& path, const std::string& key);

/// The text of a whole file; see read_picture_text.
/// @throws InputError
std::optional<std::string> find_png_text(ByteView bytes, const std::string& key);

/// read_image on bytes. PNG and JPEG carry the metadata `encoding` = "sRGB".
/// @throws InputError (file = name)
ChannelImage decode_image(ByteView bytes, const std::string& name);

/// @throws InputError (file empty)
std::string encode_png(const Image<Rgb>& linear, const PictureTexts& texts = {});

/// @throws InputError (file empty)
std::string encode_jpeg(const Image<Rgb>& linear, int quality);

/// The bytes as they are, without alpha where all of it is 255.
/// @throws InputError (file empty)
std::string encode_png(const Image<glm::u8vec4>& bytes);

}  // namespace aleph
