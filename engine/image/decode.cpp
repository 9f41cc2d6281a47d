// Decoding: EXR with exr.cpp; PNG, JPEG and HDR with OpenImageIO, after the checks of formats.cpp.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/image/codec.h"

namespace aleph {

namespace {

/// Interleaved pixels of OpenImageIO: 1 (grey), 2 (grey, alpha), 3 or 4 channels.
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
    std::vector<std::uint8_t> stripped;
    const char* plugin = "hdr";
    if (format == ImageFormat::png) {
        plugin = "png";
        stripped = strip_png(bytes, name);
        bytes = stripped;
    } else if (format == ImageFormat::jpeg) {
        plugin = "jpeg";
        stripped = strip_jpeg(bytes, name);
        bytes = stripped;
    }
    const auto input = OIIO::ImageInput::create(plugin);
    if (!input) throw InputError(name, "", fmt::format("this OpenImageIO has no reader for {}", plugin));
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours as encoded, not multiplied by alpha
    const auto fail = [&] {
        const std::string error = input->geterror();
        throw InputError(name, "", error.empty() ? "the picture does not decode" : printable(error, 400));
    };
    if (!input->set_ioproxy(&memory) || !input->open(std::string("memory.") + plugin, spec, config)) fail();
    check_size(spec.width, spec.height, name);
    if (spec.nchannels < 1 || spec.nchannels > 4) {
        throw InputError(name, "", fmt::format("{} channels are not a colour", spec.nchannels));
    }
    Interleaved<T> pixels{spec.width, spec.height, spec.nchannels, {}};
    pixels.values.resize(spec.image_pixels() * spec.nchannels);
    const bool read = input->read_image(0, 0, 0, spec.nchannels, OIIO::BaseTypeFromC<T>::value, pixels.values.data());
    // For cut and damaged JPEG data the library returns true, with an error text.
    if (!read || input->has_error()) fail();
    input->close();
    return pixels;
}

Image<std::array<float, 4>> colors_of(const ChannelImage& image, const std::string& name) {
    std::array<const Image<float>*, 4> sources{image.find("R"), image.find("G"), image.find("B"), image.find("A")};
    if (const Image<float>* grey = image.find("Y"); grey && !sources[0] && !sources[1] && !sources[2]) {
        sources[0] = sources[1] = sources[2] = grey;
    }
    if (!sources[0] || !sources[1] || !sources[2]) throw InputError(name, "", "the EXR has no channels R, G, B (or Y)");
    Image<std::array<float, 4>> colours(sources[0]->width, sources[0]->height, {0.0f, 0.0f, 0.0f, 1.0f});
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            if (sources[c]) colours.pixels[i][c] = sources[c]->pixels[i];
        }
    }
    return colours;
}

template <class T>
Image<std::array<T, 4>> colors_of(const Interleaved<T>& pixels, T opaque) {
    Image<std::array<T, 4>> colours(pixels.width, pixels.height);
    for (std::size_t i = 0; i < colours.size(); ++i) {
        for (int c = 0; c < 4; ++c) colours.pixels[i][c] = pixels.value(i, c, opaque);
    }
    return colours;
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

}  // namespace aleph
