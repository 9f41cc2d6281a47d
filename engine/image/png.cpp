// 8-bit PNG files.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/image/codec.h"

namespace aleph {

namespace {

/// sRGB of [0,1] in 0 .. 255, rounded. Values outside are clamped; NaN gives 0.
std::uint8_t encode_srgb8(float linear) {
    if (!(linear > 0.0f)) return 0;  // NaN too
    if (linear >= 1.0f) return 255;
    return static_cast<std::uint8_t>(std::lround(255.0f * linear_to_srgb(linear)));
}

}  // namespace

std::string encode_png(const Image<Rgb>& linear) {
    check_size(linear.width, linear.height, "");
    Image<std::array<std::uint8_t, 3>> encoded(linear.width, linear.height);
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const Rgb& c = linear.pixels[i];
        encoded.pixels[i] = {encode_srgb8(c.x), encode_srgb8(c.y), encode_srgb8(c.z)};
    }
    const auto output = OIIO::ImageOutput::create("png");
    if (!output) throw InputError("", "", "this OpenImageIO cannot write PNG: " + OIIO::geterror());
    OIIO::ImageSpec spec(linear.width, linear.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    // Some failures are reported by geterror() only.
    const bool done = output->set_ioproxy(&memory) && output->open("memory.png", spec) &&
                      output->write_image(OIIO::TypeDesc::UINT8, encoded.pixels.data()) && output->close();
    const std::string error = output->geterror();
    if (!done || !error.empty()) throw InputError("", "", printable(error.empty() ? "PNG: failed" : error, 400));
    return {bytes.begin(), bytes.end()};
}

}  // namespace aleph
