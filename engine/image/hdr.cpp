// Radiance pictures (.hdr): RGBE, three mantissas of 8 bits with one exponent (Ward 1991, "Real Pixels", Graphics Gems
// II).

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/image/codec.h"

namespace aleph {

namespace {

constexpr float too_large = 0x1p127f;  // the exponent has a byte, with 128 for 1
constexpr float largest = 0xffp119f;

/// @param changed  increased by the values that the format cannot hold
Rgb replace_unfit(const Rgb& given, std::size_t& changed) {
    Rgb fit = given;
    for (int c = 0; c < 3; ++c) {
        if (given[c] >= 0.0f && given[c] < too_large) continue;
        fit[c] = given[c] > 0.0f ? largest : 0.0f;  // NaN gives 0
        ++changed;
    }
    return fit;
}

/// The nearest that the format holds; encoders cut the rest off.
Rgb round_to_rgbe(const Rgb& color) {
    const float brightest = std::max({color.x, color.y, color.z});
    if (brightest < 0x1p-120f) return Rgb(0.0f);
    int exponent = 0;
    std::frexp(brightest, &exponent);
    const auto round = [&](float v) {
        return std::min(std::ldexp(std::nearbyint(std::ldexp(v, 8 - exponent)), exponent - 8), largest);
    };
    return {round(color.x), round(color.y), round(color.z)};
}

}  // namespace

std::string encode_hdr(const Image<Rgb>& linear, std::size_t& changed) {
    check_size(linear.width, linear.height, "");
    changed = 0;
    Image<Rgb> encoded(linear.width, linear.height);
    for (std::size_t i = 0; i < linear.size(); ++i)
        encoded.pixels[i] = round_to_rgbe(replace_unfit(linear.pixels[i], changed));
    const auto output = OIIO::ImageOutput::create("hdr");
    if (!output) throw InputError("", "", "this OpenImageIO cannot write HDR: " + OIIO::geterror());
    const OIIO::ImageSpec spec(linear.width, linear.height, 3, OIIO::TypeDesc::FLOAT);
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const bool done = output->set_ioproxy(&memory) && output->open("memory.hdr", spec) &&
                      output->write_image(OIIO::TypeDesc::FLOAT, encoded.pixels.data()) && output->close();
    const std::string error = output->geterror();
    if (!done || !error.empty()) throw InputError("", "", printable(error.empty() ? "HDR: failed" : error, 400));
    return {bytes.begin(), bytes.end()};
}

}  // namespace aleph
