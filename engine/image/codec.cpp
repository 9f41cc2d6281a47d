// Bytes to pixels: EXR with exr.cpp; PNG, JPEG and HDR with OpenImageIO, after the checks of formats.cpp. Pixels to
// 8-bit PNG and JPEG.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/image/library.h"

namespace aleph {

namespace {

/// Interleaved pixels: 1 (grey), 2 (grey, alpha), 3 or 4 channels.
template <class T>
struct Interleaved {
    int width = 0, height = 0, channels = 0;
    std::vector<T> values;

    bool grey() const { return channels < 3; }
    bool has_alpha() const { return channels == 2 || channels == 4; }
    /// Red, green, blue or alpha (0..3) of pixel i.
    T value(std::size_t i, int component, T opaque) const {
        if (component == 3) return has_alpha() ? values[i * channels + channels - 1] : opaque;
        return values[i * channels + (grey() ? 0 : component)];
    }
};

ImageFormat require_format(ByteView bytes, const std::string& name) {
    const auto format = detect_format(bytes);
    if (!format) {
        throw InputError(name, "", bytes.empty() ? "the file is empty" : "this is not a PNG, JPEG, EXR or HDR picture");
    }
    return *format;
}

template <class T>
Interleaved<T> decode_with_library(ByteView bytes, ImageFormat format, const std::string& name) {
    const char* const plugin = format == ImageFormat::png ? "png" : format == ImageFormat::jpeg ? "jpeg" : "hdr";
    std::vector<std::uint8_t> stripped;
    if (format == ImageFormat::png) stripped = strip_png(bytes, name);
    if (format == ImageFormat::jpeg) stripped = strip_jpeg(bytes, name);
    if (format == ImageFormat::hdr) check_hdr_order(bytes, name);
    if (!stripped.empty()) bytes = stripped;
    Interleaved<T> pixels;
    const auto place = [&](int width, int height, int channels) -> void* {
        check_size(width, height, name);
        if (channels < 1 || channels > 4)
            throw InputError(name, "", fmt::format("{} channels are not a colour", channels));
        pixels = {width, height, channels, {}};
        pixels.values.resize(std::size_t(width) * height * channels);
        return pixels.values.data();
    };
    const PixelType type = std::is_same_v<T, float> ? PixelType::floats : PixelType::bytes;
    const std::string fault = image_library().decode(bytes, plugin, type, place);
    if (!fault.empty()) throw InputError(name, "", printable(fault, 400));
    if (format == ImageFormat::hdr) {
        const std::array<double, 3> factors = read_hdr_factors(bytes);
        for (std::size_t i = 0; i < pixels.values.size(); ++i)
            pixels.values[i] = static_cast<T>(pixels.values[i] / factors[i % 3]);
    }
    return pixels;
}

/// The whole picture. What the file has no pixels for is black, and not there where the file has alpha.
Image<glm::vec4> colors_of(const ChannelImage& image, const std::string& name) {
    std::array<const Image<float>*, 4> sources{image.find("R"), image.find("G"), image.find("B"), image.find("A")};
    if (const Image<float>* grey = image.find("Y"); grey && !sources[0] && !sources[1] && !sources[2]) {
        sources[0] = sources[1] = sources[2] = grey;
    }
    if (!sources[0] || !sources[1] || !sources[2]) throw InputError(name, "", "the EXR has no channels R, G, B (or Y)");
    const int width = sources[0]->width, height = sources[0]->height;
    const PictureArea whole = image.whole.value_or(PictureArea{0, 0, width, height});
    check_size(whole.width, whole.height, name);
    Image<glm::vec4> colours(whole.width, whole.height, {0.0f, 0.0f, 0.0f, sources[3] ? 0.0f : 1.0f});
    for (int y = 0; y < whole.height; ++y) {
        for (int x = 0; x < whole.width; ++x) {
            if (!lies_within({whole.x + x, whole.y + y, 1, 1}, width, height)) continue;
            for (int c = 0; c < 4; ++c)
                if (sources[c]) colours(x, y)[c] = (*sources[c])(whole.x + x, whole.y + y);
        }
    }
    return colours;
}

template <class T>
Image<glm::vec<4, T>> colors_of(const Interleaved<T>& pixels, T opaque) {
    Image<glm::vec<4, T>> colours(pixels.width, pixels.height);
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (int c = 0; c < 4; ++c) colours.pixels[i][c] = pixels.value(i, c, opaque);
    }
    return colours;
}

/// sRGB of [0,1] in 0 .. 255, rounded. Values outside are clamped; NaN gives 0.
std::uint8_t encode_srgb8(float linear) {
    if (!(linear > 0.0f)) return 0;  // NaN too
    if (linear >= 1.0f) return 255;
    return static_cast<std::uint8_t>(std::lround(255.0f * linear_to_srgb(linear)));
}

std::string encode(const EncodedPicture& picture) {
    std::string bytes;
    const std::string fault = image_library().encode(picture, bytes);
    if (!fault.empty()) throw InputError("", "", printable(fault, 400));
    return bytes;
}

std::string encode_srgb(const Image<Rgb>& linear, const std::string& format, PictureTexts attributes) {
    check_size(linear.width, linear.height, "");
    Image<std::array<std::uint8_t, 3>> encoded(linear.width, linear.height);
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const Rgb& c = linear.pixels[i];
        encoded.pixels[i] = {encode_srgb8(c.x), encode_srgb8(c.y), encode_srgb8(c.z)};
    }
    attributes["oiio:ColorSpace"] = "sRGB";
    return encode({format, linear.width, linear.height, 3, encoded.pixels.data(), attributes});
}

}  // namespace

ChannelImage decode_image(ByteView bytes, const std::string& name) {
    const ImageFormat format = require_format(bytes, name);
    if (format == ImageFormat::exr) return decode_exr(bytes, name);
    const auto pixels = decode_with_library<float>(bytes, format, name);
    ChannelImage image;
    for (int c = 0; c < (pixels.has_alpha() ? 4 : 3); ++c) {
        Channel channel{std::string(1, "RGBA"[c]), Image<float>(pixels.width, pixels.height)};
        for (std::size_t i = 0; i < channel.values.size(); ++i) channel.values.pixels[i] = pixels.value(i, c, 1.0f);
        image.channels.push_back(std::move(channel));
    }
    if (format != ImageFormat::hdr) image.metadata["encoding"] = std::string("sRGB");
    return image;
}

DecodedTexture decode_texture(const std::vector<std::uint8_t>& encoded, const std::string& name) {
    DecodedTexture texture;
    switch (const ImageFormat format = require_format(encoded, name)) {
        case ImageFormat::exr:
            texture.floats = colors_of(decode_exr(encoded, name), name);
            break;
        case ImageFormat::hdr:
            texture.floats = colors_of(decode_with_library<float>(encoded, format, name), 1.0f);
            break;
        case ImageFormat::png:
        case ImageFormat::jpeg:
            texture.bytes = colors_of(decode_with_library<std::uint8_t>(encoded, format, name), std::uint8_t{255});
            break;
    }
    return texture;
}

std::string encode_png(const Image<Rgb>& linear, const PictureTexts& texts) {
    return encode_srgb(linear, "png", texts);
}

std::string encode_jpeg(const Image<Rgb>& linear, int quality) {
    return encode_srgb(linear, "jpg", {{"Compression", fmt::format("jpeg:{}", quality)}});
}

std::string encode_png(const Image<glm::u8vec4>& bytes) {
    check_size(bytes.width, bytes.height, "");
    const bool is_opaque = std::ranges::all_of(bytes.pixels, [](const glm::u8vec4& texel) { return texel.w == 255; });
    const int channels = is_opaque ? 3 : 4;
    std::vector<std::uint8_t> packed;
    packed.reserve(bytes.size() * static_cast<std::size_t>(channels));
    for (const glm::u8vec4& texel : bytes.pixels)
        for (int c = 0; c < channels; ++c) packed.push_back(texel[c]);
    return encode({"png", bytes.width, bytes.height, channels, packed.data(), {}});
}

}  // namespace aleph
