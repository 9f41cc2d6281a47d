// 8-bit PNG and JPEG files.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/image/library.h"

namespace aleph {

namespace {

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
