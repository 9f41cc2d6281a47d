#include "engine/image/image_file.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/parallel.h"
#include "engine/image/codec.h"

namespace aleph {

namespace {

/// Largest file that is read, bytes.
constexpr std::uintmax_t max_image_file_bytes = std::uintmax_t{1} << 32;

std::string display_name(const std::filesystem::path& path) {
    return printable(path.string(), 4096);
}

/// Turns an encoder's InputError into an OutputError that names the file.
template <class Encode>
std::string encode_for(const std::filesystem::path& path, const Encode& encode) {
    try {
        return encode();
    } catch (const InputError& e) {
        throw OutputError(display_name(path), e.what());
    }
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
    const std::string name = display_name(path);
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError(name, "", "there is no such file");
    if (!std::filesystem::is_regular_file(status)) throw InputError(name, "", "this is not a file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw InputError(name, "", error.message());
    if (size > max_image_file_bytes) throw InputError(name, "", "the file is larger than 4 GiB");
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(name, "", "cannot open the file");
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (file.gcount() != static_cast<std::streamsize>(size)) throw InputError(name, "", "cannot read the whole file");
    return bytes;
}

}  // namespace

const Image<float>* ChannelImage::find(const std::string& name) const {
    for (const Channel& channel : channels) {
        if (channel.name == name) return &channel.values;
    }
    return nullptr;
}

void write_exr(const std::filesystem::path& path, const ChannelImage& image) {
    write_file(path, encode_for(path, [&] { return encode_exr(image, thread_count()); }));
}

void write_png(const std::filesystem::path& path, const Image<Rgb>& linear, const PictureTexts& texts) {
    write_file(path, encode_for(path, [&] { return encode_png(linear, texts); }));
}

void write_jpeg(const std::filesystem::path& path, const Image<Rgb>& linear, int quality) {
    write_file(path, encode_for(path, [&] { return encode_jpeg(linear, quality); }));
}

std::size_t write_hdr(const std::filesystem::path& path, const Image<Rgb>& linear, const PictureTexts& texts) {
    std::size_t changed = 0;
    write_file(path, encode_for(path, [&] { return encode_hdr(linear, changed, texts); }));
    return changed;
}

std::optional<std::string> read_picture_text(const std::filesystem::path& path, const std::string& key) {
    try {
        if (lower_extension(path) == ".exr") return find_exr_text(path, key);
        const std::vector<std::uint8_t> bytes = read_bytes(path);
        const std::optional<ImageFormat> format = detect_format(bytes);
        if (format == ImageFormat::png) return find_png_text(bytes, key);
        if (format == ImageFormat::hdr) return find_hdr_text(bytes, key);
    } catch (const InputError&) {  // not whole
    }
    return std::nullopt;
}

ChannelImage read_image(const std::filesystem::path& path) {
    return decode_image(read_bytes(path), display_name(path));
}

}  // namespace aleph
