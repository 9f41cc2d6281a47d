#include "render/study/pages/report_layers.h"

#include <Imath/half.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>

namespace aleph {

namespace {

static_assert(std::endian::native == std::endian::little);

std::uint32_t bits_of(float value, LayerType type) {
    if (type == LayerType::f32) return std::bit_cast<std::uint32_t>(value);
    constexpr float largest = 65504.0f;
    return Imath::half(std::clamp(value, -largest, largest)).bits();
}

std::string compress(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    const int code = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
    if (code != Z_OK) throw std::runtime_error("zlib failed");
    out.resize(size);
    return out;
}

}  // namespace

std::string encode_layer(const std::vector<const Image<float>*>& channels, LayerType type) {
    const std::size_t width = type == LayerType::f16 ? 2 : 4, count = channels.front()->size() * channels.size();
    std::string bytes(width * count, '\0');
    std::size_t at = 0;
    for (const Image<float>* channel : channels) {
        for (const float value : channel->pixels) {
            const std::uint32_t bits = bits_of(value, type);
            for (std::size_t b = 0; b < width; ++b) bytes[b * count + at] = static_cast<char>(bits >> (8 * b));
            ++at;
        }
    }
    return OIIO::Strutil::base64_encode(compress(bytes));
}

nlohmann::ordered_json ReportLayers::add(const std::vector<const Image<float>*>& channels, LayerType type) {
    const std::string text = encode_layer(channels, type);
    if (text.size() > left_) {
        ++left_out_;
        return nullptr;
    }
    left_ -= text.size();
    const std::string name = fmt::format("layer-{}", count_++);
    elements_ += fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", name, text);
    return {{"element", name},
            {"width", channels.front()->width},
            {"height", channels.front()->height},
            {"channels", channels.size()},
            {"type", type == LayerType::f16 ? "f16" : "f32"}};
}

}  // namespace aleph
