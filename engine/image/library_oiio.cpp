#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>

#include "engine/image/library.h"

namespace aleph {

namespace {

constexpr const char* font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

OIIO::TypeDesc type_of(PixelType type) {
    return type == PixelType::floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
}

std::string decode(ByteView bytes, const std::string& format, PixelType type, const PixelPlace& place) {
    const auto input = OIIO::ImageInput::create(format);
    if (!input) return "this OpenImageIO has no reader for " + format;
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    OIIO::ImageSpec spec, config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // colours as encoded, not multiplied by alpha
    const auto fault = [&] {
        const std::string error = input->geterror();
        return error.empty() ? std::string("the picture does not decode") : error;
    };
    if (!input->set_ioproxy(&memory) || !input->open("memory." + format, spec, config)) return fault();
    void* const pixels = place(spec.width, spec.height, spec.nchannels);
    const bool read = input->read_image(0, 0, 0, spec.nchannels, type_of(type), pixels);
    // For cut and damaged JPEG data the library returns true, with an error text.
    if (!read || input->has_error()) return fault();
    input->close();
    return "";
}

std::string encode(const EncodedPicture& picture, std::string& bytes) {
    const auto output = OIIO::ImageOutput::create(picture.format);
    if (!output) return "OpenImageIO cannot write " + picture.format + ": " + OIIO::geterror();
    OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, OIIO::TypeDesc::UINT8);
    if (picture.channels == 4) spec.attribute("oiio:UnassociatedAlpha", 1);  // else colours are divided by alpha
    for (const auto& [key, text] : picture.attributes) spec.attribute(key, text);
    std::vector<unsigned char> written;
    OIIO::Filesystem::IOVecOutput memory(written);
    // Some failures are reported by geterror() only.
    const bool done = output->set_ioproxy(&memory) && output->open("memory." + picture.format, spec) &&
                      output->write_image(spec.format, picture.pixels) && output->close();
    const std::string error = output->geterror();
    if (!done || !error.empty()) return error.empty() ? picture.format + ": failed" : error;
    bytes.assign(written.begin(), written.end());
    return "";
}

OIIO::ImageSpec color_spec(int width, int height) {
    return {width, height, 3, OIIO::TypeDesc::FLOAT};
}

/// Uses the picture's own memory.
OIIO::ImageBuf wrap(Image<Rgb>& picture) {
    return {color_spec(picture.width, picture.height), picture.pixels.data()};
}

Image<Rgb> resize(const Image<Rgb>& picture, int width, int height) {
    Image<Rgb> given = picture, resized(width, height);
    OIIO::ImageBuf to = wrap(resized);
    OIIO::ImageBufAlgo::resize(to, wrap(given), "triangle");
    return resized;
}

Image<Rgb> color_scale(const Image<float>& positions) {
    OIIO::ImageBuf given(OIIO::ImageSpec(positions.width, positions.height, 1, OIIO::TypeDesc::FLOAT));
    given.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, positions.pixels.data());
    Image<Rgb> colors(positions.width, positions.height);
    OIIO::ImageBuf to = wrap(colors);
    OIIO::ImageBufAlgo::color_map(to, given, 0, "inferno");
    // OpenImageIO gives linear values, in which the scale would be darker and not uniform.
    for (Rgb& color : colors.pixels)
        for (int c = 0; c < 3; ++c) color[c] = linear_to_srgb(std::clamp(color[c], 0.0f, 1.0f));
    return colors;
}

int text_width(const std::string& text, int size) {
    const OIIO::ROI room = OIIO::ImageBufAlgo::text_size(text, size, font);
    return room.defined() ? room.width() : 0;
}

void draw_text(Image<Rgb>& picture, int x, int y, bool x_is_right, const std::string& text, int size) {
    using Align = OIIO::ImageBufAlgo::TextAlignX;
    OIIO::ImageBuf to = wrap(picture);
    OIIO::ImageBufAlgo::render_text(to, x, y, text, size, font, {0.92f, 0.92f, 0.90f},
                                    x_is_right ? Align::Right : Align::Left);
    static_cast<void>(to.geterror());
}

}  // namespace

}  // namespace aleph

extern "C" __attribute__((visibility("default"))) const aleph::ImageLibrary* aleph_image_library() {
    static const aleph::ImageLibrary table{aleph::decode,      aleph::encode,     aleph::resize,
                                           aleph::color_scale, aleph::text_width, aleph::draw_text};
    return &table;
}
