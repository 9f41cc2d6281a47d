#include "engine/image/image_file.h"

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "engine/base/parallel.h"
#include "engine/image/codec.h"

namespace aleph {

namespace {

constexpr std::uint64_t max_image_file_bytes = std::uint64_t{1} << 32;

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

Bytes read_bytes(const std::filesystem::path& path) {
    const ReadFiles apart;  // pictures are noted by those who read them for a scene
    return read_regular_file(path, display_name(path), "", max_image_file_bytes);
}

}  // namespace

const Image<float>* ChannelImage::find(const std::string& name) const {
    const auto found = std::ranges::find(channels, name, &Channel::name);
    return found == channels.end() ? nullptr : &found->values;
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

std::optional<std::string> read_picture_text(const std::filesystem::path& path, const std::string& key) {
    try {
        if (lower_extension(path) == ".exr") return find_exr_text(path, key);
        const Bytes bytes = read_bytes(path);
        if (detect_format(bytes) == ImageFormat::png) return find_png_text(bytes, key);
    } catch (const InputError&) {  // not whole
    }
    return std::nullopt;
}

ChannelImage read_image(const std::filesystem::path& path) {
    return decode_image(read_bytes(path), display_name(path));
}

bool can_read_image(const std::filesystem::path& path) {
    try {
        read_image(path);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

}  // namespace aleph
